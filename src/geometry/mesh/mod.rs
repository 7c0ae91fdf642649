//! Triangle meshes: one set of triangles and its tree, shown at as many places as a scene likes.
//!
//! - [`Triangles`]: what a file says
//! - `closed`: whether they enclose a volume, and which way they face
//! - `block`: a few triangles and a line, exact in what it crosses
//! - `eight`: eight numbers at once
//! - `query`: rays through the tree, and where they begin when they leave a triangle
//! - `smooth`: normals of meshes that have none
//! - `placed`: a mesh under a transform; a thousand copies share the triangles

mod block;
mod closed;
mod eight;
mod placed;
mod query;
mod smooth;

pub use closed::Surroundings;
pub(super) use closed::weld;
pub use placed::Placed;

use std::sync::OnceLock;

use glam::{DVec3, Vec2, Vec3};
use rayon::prelude::*;

use super::tree::{Groups, Tree};
use super::{Bounds, GeometryError, Triangles, check};
use block::{Block, WIDTH};

/// Triangles ready for rays. Memory, bytes a triangle of a large mesh: blocks 30, tree 12, what the file said 18–40; while it is built
/// 166 at most (`cargo bench --bench rays -- build 1582`).
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

/// Triangles and corners that a mesh can have: lanes of blocks are counted in 32 bits, and a block may hold a single triangle.
const MAX: usize = u32::MAX as usize / WIDTH;

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
        examine(&triangles)?;
        let (mut surroundings, (tree, groups)) = rayon::join(|| Surroundings::of(&triangles), || plant(&triangles));
        let inside_out = surroundings.is_closed() && surroundings.volume < 0.0;
        if inside_out {
            turn_round(&mut triangles);
            surroundings.volume = -surroundings.volume;
        }
        let block =
            |leaf| Block::new(groups.get(leaf).iter().map(|&triangle| (corners(&triangles, triangle), triangle)));
        let blocks: Vec<Block> = (0..groups.len()).into_par_iter().map(block).collect();
        let bounds = blocks.par_iter().map(Block::bounds).reduce(|| Bounds::EMPTY, |a, b| a.union(&b));
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

    /// Corners of a triangle where a ray has met it, beside the tree: nothing has to be fetched for them.
    #[inline]
    fn corners_at(&self, place: u32) -> [DVec3; 3] {
        let (block, lane) = (place as usize / WIDTH, place as usize % WIDTH);
        self.blocks[block].corners(lane).map(|corner| corner.as_dvec3())
    }

    /// Corners of a triangle that is kept at a place, as a hit says; looked up if it is not. Index and positions lie far apart in memory,
    /// and that ray after ray waited for them took 7 % of the time of a diffuse mesh of 1.3 M triangles.
    #[inline]
    fn corners_of(&self, triangle: u32, place: u32) -> [DVec3; 3] {
        let (block, lane) = (place as usize / WIDTH, place as usize % WIDTH);
        match self.blocks.get(block).filter(|block| block.triangle[lane] == triangle) {
            Some(block) => block.corners(lane).map(|corner| corner.as_dvec3()),
            None => self.corners(triangle),
        }
    }

    /// Whether its triangles stand for a smooth surface.
    #[inline]
    fn is_smooth(&self) -> bool {
        !self.triangles.normals.is_empty()
    }

    /// The normal of the surface that the triangles stand for, outwards, any length; none if it is the triangle's own.
    fn smooth_normal(&self, spot: &Spot, triangle: u32) -> Option<DVec3> {
        let (normals, indices) = (&self.triangles.normals, &self.triangles.indices);
        let corners = indices.get(triangle as usize).filter(|_| !normals.is_empty())?;
        let sum: DVec3 = corners
            .iter()
            .zip(spot.weights)
            .filter_map(|(&corner, weight)| Some(normals.get(corner as usize)?.as_dvec3().try_normalize()? * weight))
            .sum();
        (sum.dot(spot.normal) > 0.0).then_some(sum)
    }

    /// Texture coordinates at a point of a triangle, if the mesh has some.
    fn uv(&self, near: DVec3, triangle: u32) -> Option<Vec2> {
        let corners = self.triangles.indices.get(triangle as usize)?;
        let weights = Spot::nearest(near, self.corners(triangle)).weights;
        let [a, b, c] = corners.map(|corner| self.triangles.uvs.get(corner as usize).copied());
        let [a, b, c] = [a?, b?, c?].map(|uv| uv.as_dvec2());
        Some((a * weights[0] + b * weights[1] + c * weights[2]).as_vec2())
    }
}

impl Spot {
    /// The point of a triangle nearest to one that lies on it but for rounding: put onto its plane, then between its edges.
    #[inline]
    fn nearest(near: DVec3, corners: [DVec3; 3]) -> Self {
        Self::within(near, corners, |_, _| [0.0; 3])
    }

    /// The same, at least `margin` away from each edge where there is room. `size` bounds the edges' components at one corner.
    #[inline]
    fn away_from_edges(near: DVec3, corners: [DVec3; 3], margin: f64, size: f64) -> Self {
        let spot = Self::nearest(near, corners);
        // Without roots for most: a weight times twice the area is a distance from an edge times its length, squared at most 12 size². (Four
        // times that, so that rounding does not matter.)
        let least = spot.weights[0].min(spot.weights[1]).min(spot.weights[2]);
        let far = 2.0 * margin * size;
        if least * least * spot.normal.length_squared() > 12.0 * far * far {
            return spot;
        }
        Self::beside_edges(near, corners, margin)
    }

    #[cold]
    fn beside_edges(near: DVec3, corners: [DVec3; 3], margin: f64) -> Self {
        // A weight is a distance from an edge over the height above it, and the height is twice the area over the edge.
        Self::within(near, corners, |edges, area2| edges.map(|edge| margin * edge.length() / area2.sqrt()))
    }

    /// `least` gives the smallest weights allowed, from the edges opposite of the corners and four times the area, squared.
    #[inline(always)]
    fn within(near: DVec3, [a, b, c]: [DVec3; 3], least: impl FnOnce([DVec3; 3], f64) -> [f64; 3]) -> Self {
        let (ab, ac, ap) = (b - a, c - a, near - a);
        let normal = ab.cross(ac);
        let area2 = normal.length_squared();
        let v = ap.cross(ac).dot(normal) / area2;
        let w = ab.cross(ap).dot(normal) / area2;
        let mut weights = [1.0 - v - w, v, w];
        let least = least([c - b, ac, ab], area2);
        let room = 1.0 - least.iter().sum::<f64>();
        if !(room > 0.0) || weights.iter().any(|x| !x.is_finite()) {
            weights = [1.0 / 3.0; 3];
        } else if weights.iter().zip(least).any(|(&x, least)| x < least) {
            // What is above the least is shrunk, so that the sum stays one.
            let above = [0, 1, 2].map(|i| (weights[i] - least[i]).max(0.0));
            let sum: f64 = above.iter().sum();
            weights = [0, 1, 2].map(|i| least[i] + above[i] * (room / sum));
        }
        Self { weights, point: a * weights[0] + b * weights[1] + c * weights[2], normal }
    }
}

/// Whether there are triangles, not too many for 32 bits of number, edge and way, of corners that exist and are numbers.
fn examine(triangles: &Triangles) -> Result<(), GeometryError> {
    let Triangles { positions, indices, .. } = triangles;
    if indices.is_empty() {
        return Err(GeometryError::NoTriangles);
    }
    let count = indices.len().max(positions.len());
    if count > MAX {
        return Err(GeometryError::TooManyTriangles { count, max: MAX });
    }
    let count = positions.len();
    let stray = |triangle: &[u32; 3]| triangle.iter().copied().find(|&index| index as usize >= count);
    if let Some(index) = indices.par_iter().find_map_first(stray) {
        return Err(GeometryError::NoSuchCorner { index, count });
    }
    let wrong = |&position: &Vec3| check::point("a corner of the mesh", position).err();
    if let Some(error) = positions.par_iter().find_map_first(wrong) {
        return Err(error);
    }
    let has_area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|index| positions[index as usize].as_dvec3());
        (b - a).cross(c - a) != DVec3::ZERO
    };
    match indices.iter().any(has_area) {
        true => Ok(()),
        false => Err(GeometryError::NoTriangleWithArea { count: indices.len() }),
    }
}

fn plant(triangles: &Triangles) -> (Tree, Groups) {
    let bounds = |triangle: usize| Bounds::of(corners(triangles, triangle as u32));
    let fit = |group: &[u32]| Block::fit(group.iter().map(|&triangle| corners(triangles, triangle)));
    Tree::grouped(triangles.indices.len(), WIDTH as u32, bounds, fit)
}

fn corners(triangles: &Triangles, triangle: u32) -> [Vec3; 3] {
    triangles.indices[triangle as usize].map(|index| triangles.positions[index as usize])
}

fn turn_round(triangles: &mut Triangles) {
    triangles.indices.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    triangles.normals.iter_mut().for_each(|normal: &mut Vec3| *normal = -*normal);
}
