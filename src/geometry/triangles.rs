//! Triangles as a file or a program gives them, before anything is built over them.

use glam::{Vec2, Vec3};

/// A triangle soup with shared vertices: one index serves position, normal and texture coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    pub positions: Vec<Vec3>,
    /// A direction for each position, any length, outwards; empty if the surface is faceted.
    pub normals: Vec<Vec3>,
    /// Texture coordinates for each position, v upwards (0 at the bottom row of a picture); empty if there are none.
    pub uvs: Vec<Vec2>,
    /// Counter-clockwise seen from outside.
    pub indices: Vec<[u32; 3]>,
}
