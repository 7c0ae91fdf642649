//! Meshes: by area, over all triangles.
//!
//! Triangles that face away or hide behind others are drawn too; they give nothing.

use glam::Vec3;

use super::{Toward, area_pdf, by_area};
use crate::geometry::{Hit, Placed};

pub(super) fn sample(mesh: &Placed, reference: Vec3, u: [f32; 2]) -> Option<Toward> {
    let (triangle, share) = mesh.mesh().pick(u[0]);
    let [a, b, c] = mesh.corners(triangle);
    // Uniform in the triangle: (1 − √s) a + √s ((1 − v) b + v c).
    let (root, v) = (share.sqrt(), f64::from(u[1]));
    let point = (a + ((b - a) * (1.0 - v) + (c - a) * v) * root).as_vec3();
    by_area(reference, point, mesh.normal_of(triangle), triangle, stands_for(mesh, triangle))
}

pub(super) fn pdf(mesh: &Placed, reference: Vec3, direction: Vec3, hit: &Hit) -> f32 {
    area_pdf(reference, direction, hit.point, hit.normal, stands_for(mesh, hit.facet))
}

/// One over the density of points of a triangle by area: triangles are picked by their areas in the mesh, which a stretched copy
/// changes each by a factor of its own.
fn stands_for(mesh: &Placed, triangle: u32) -> f32 {
    (mesh.area_of(triangle) / mesh.mesh().probability(triangle)) as f32
}
