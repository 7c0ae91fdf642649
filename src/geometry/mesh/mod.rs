//! Triangle meshes: one set of triangles and its tree, shown at as many places as a scene likes.
//!
//! - [`Triangles`]: what a file says
//! - `closed`: whether they enclose a volume, and which way they face
//! - `block`: four triangles and a line, exact in what it crosses
//! - `query`: rays through the tree, and where they begin when they leave a triangle
//! - `smooth`: normals of meshes that have none
//! - `placed`: a mesh under a transform; a thousand copies share the triangles

mod block;
mod closed;
mod placed;
mod query;
mod smooth;

pub use closed::Surroundings;
pub use placed::Placed;

use std::sync::OnceLock;

use glam::{DVec3, Vec2, Vec3};

use super::tree::Tree;
use super::{Bounds, GeometryError, Triangles, check};
use block::{Block, WIDTH};

/// Triangles ready for rays. Memory, bytes a triangle of a large mesh: blocks 50, tree 15, what the file said 20–40.
#[derive(Clone, Debug)]
pub struct Mesh {
    triangles: Triangles,
    blocks: Vec<Block>,
    tree: Tree,
    bounds: Bounds,
    surroundings: Surroundings,
    inside_out: bool,
    /// Shares of the area up to and with each triangle; worked out when light is first sampled.
    shares: OnceLock<Vec<f64>>,
}

/// A point of a triangle.
#[derive(Clone, Copy, Debug)]
struct Spot {
    /// Of the three corners; not negative, their sum is one.
    weights: [f64; 3],
    point: DVec3,
    /// (b − a) × (c − a): outwards, twice the area long.
    normal: DVec3,
}

impl Mesh {
    /// A closed mesh that is inside out is turned round: its outside is where there is more room.
    pub fn new(mut triangles: Triangles) -> Result<Self, GeometryError> {
        if triangles.indices.is_empty() {
            return Err(GeometryError::NoTriangles);
        }
        let count = triangles.positions.len();
        if let Some(&index) = triangles.indices.iter().flatten().find(|&&index| index as usize >= count) {
            return Err(GeometryError::NoSuchCorner { index, count });
        }
        for &position in &triangles.positions {
            check::point("a corner of the mesh", position)?;
        }
        let mut surroundings = Surroundings::of(&triangles);
        let inside_out = surroundings.is_closed() && surroundings.volume < 0.0;
        if inside_out {
            turn_round(&mut triangles);
            surroundings.volume = -surroundings.volume;
        }
        let corners = |triangle: u32| triangles.indices[triangle as usize].map(|i| triangles.positions[i as usize]);
        let boxes: Vec<Bounds> = (0..triangles.indices.len() as u32).map(|t| Bounds::of(corners(t))).collect();
        let bounds = boxes.iter().fold(Bounds::EMPTY, |all, b| all.union(b));
        let mut blocks = Vec::new();
        let tree = Tree::grouped(&boxes, WIDTH as u32, |group| {
            blocks.push(Block::new(&group.iter().map(|&t| (corners(t), t)).collect::<Vec<_>>()));
        });
        Ok(Self { triangles, blocks, tree, bounds, surroundings, inside_out, shares: OnceLock::new() })
    }

    pub fn triangles(&self) -> &Triangles {
        &self.triangles
    }

    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    pub fn surroundings(&self) -> &Surroundings {
        &self.surroundings
    }

    /// Whether its triangles faced inwards, before they were turned round.
    pub fn was_inside_out(&self) -> bool {
        self.inside_out
    }

    pub fn is_closed(&self) -> bool {
        self.surroundings.is_closed()
    }

    pub fn has_uv(&self) -> bool {
        !self.triangles.uvs.is_empty()
    }

    /// Triangles of all blocks that meet a box.
    fn triangles_near(&self, bounds: &Bounds) -> impl Iterator<Item = u32> {
        self.tree.near(bounds).into_iter().flat_map(|leaf| self.blocks[leaf as usize].triangle)
    }

    /// Corners of a triangle; of the first one if there is no such.
    fn corners(&self, triangle: u32) -> [DVec3; 3] {
        let indices = self.triangles.indices.get(triangle as usize).unwrap_or(&self.triangles.indices[0]);
        indices.map(|index| self.triangles.positions[index as usize].as_dvec3())
    }

    fn shares(&self) -> &[f64] {
        self.shares.get_or_init(|| {
            let area = |triangle| {
                let [a, b, c] = self.corners(triangle);
                (b - a).cross(c - a).length()
            };
            let mut sum = 0.0;
            let sums = (0..self.triangles.indices.len() as u32).map(|triangle| {
                sum += area(triangle);
                sum
            });
            let sums: Vec<f64> = sums.collect();
            sums.iter().map(|share| share / sum).collect()
        })
    }

    /// The triangle in which a number in [0, 1) falls by area, and how far into it, 0…1.
    pub(super) fn pick(&self, u: f32) -> (u32, f64) {
        let u = f64::from(u);
        let triangle = self.shares().partition_point(|&share| share <= u).min(self.shares().len() - 1) as u32;
        let before = self.shares()[triangle as usize] - self.probability(triangle);
        (triangle, ((u - before) / self.probability(triangle)).clamp(0.0, 1.0))
    }

    /// The share of a triangle in the area.
    pub(super) fn probability(&self, triangle: u32) -> f64 {
        let at = triangle as usize;
        let before = if at == 0 { 0.0 } else { self.shares().get(at - 1).copied().unwrap_or(0.0) };
        self.shares().get(at).map_or(0.0, |share| share - before)
    }

    /// The point of a triangle nearest to one that lies on it but for rounding: put onto its plane, then between its edges, and
    /// at least `margin` away from each where there is room.
    fn spot(&self, near: DVec3, triangle: u32, margin: f64) -> Spot {
        let [a, b, c] = self.corners(triangle);
        let (ab, ac, ap) = (b - a, c - a, near - a);
        let normal = ab.cross(ac);
        let area2 = normal.length_squared();
        let v = ap.cross(ac).dot(normal) / area2;
        let w = ab.cross(ap).dot(normal) / area2;
        let mut weights = [1.0 - v - w, v, w];
        // A weight is a distance from an edge over the height above it, and the height is twice the area over the edge.
        let least = [(c - b), ac, ab].map(|edge| margin * edge.length() / area2.sqrt());
        let room = 1.0 - least.iter().sum::<f64>();
        if !(room > 0.0) || weights.iter().any(|x| !x.is_finite()) {
            weights = [1.0 / 3.0; 3];
        } else if weights.iter().zip(least).any(|(&x, least)| x < least) {
            // What is above the least is shrunk, so that the sum stays one.
            let above = [0, 1, 2].map(|i| (weights[i] - least[i]).max(0.0));
            let sum: f64 = above.iter().sum();
            weights = [0, 1, 2].map(|i| least[i] + above[i] * (room / sum));
        }
        Spot { weights, point: a * weights[0] + b * weights[1] + c * weights[2], normal }
    }

    /// The normal of the surface that the triangles stand for, outwards, any length; the triangle's own without normals.
    fn smooth_normal(&self, spot: &Spot, triangle: u32) -> DVec3 {
        let (normals, indices) = (&self.triangles.normals, &self.triangles.indices);
        let Some(corners) = indices.get(triangle as usize).filter(|_| !normals.is_empty()) else { return spot.normal };
        let sum: DVec3 = corners
            .iter()
            .zip(spot.weights)
            .filter_map(|(&corner, weight)| Some(normals.get(corner as usize)?.as_dvec3().try_normalize()? * weight))
            .sum();
        if sum.dot(spot.normal) > 0.0 { sum } else { spot.normal }
    }

    /// Texture coordinates at a point of a triangle, if the mesh has some.
    fn uv(&self, near: DVec3, triangle: u32) -> Option<Vec2> {
        let corners = self.triangles.indices.get(triangle as usize)?;
        let weights = self.spot(near, triangle, 0.0).weights;
        let [a, b, c] = corners.map(|corner| self.triangles.uvs.get(corner as usize).copied());
        let [a, b, c] = [a?, b?, c?].map(|uv| uv.as_dvec2());
        Some((a * weights[0] + b * weights[1] + c * weights[2]).as_vec2())
    }
}

fn turn_round(triangles: &mut Triangles) {
    triangles.indices.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    triangles.normals.iter_mut().for_each(|normal: &mut Vec3| *normal = -*normal);
}
