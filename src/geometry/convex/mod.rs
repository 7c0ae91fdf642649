//! Convex solids as the half-spaces they are made of.
//!
//! A gem is one primitive and not a mesh: a ray inside meets exactly one exit facet, found without epsilon or leak, and the
//! same planes serve eight rays at once. Planes are kept relative to a centre, so that a small stone far from the origin
//! loses nothing but the rounding of the ray's own origin.

mod bundle;
mod crowd;
mod exit;
mod meet;
mod polyhedron;

use glam::{Affine3A, DVec3, Vec3};

pub use exit::{Exits, Points};
pub use polyhedron::Plane;

use super::ray::Surface;
use super::{Bounds, GeometryError, check};
use exit::{BLOCK, Block, Spread};
use polyhedron::Polyhedron;

/// A facet of a convex solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Facet {
    /// Outward unit normal.
    pub normal: Vec3,
    /// The facet's plane: normal·(p − centre of the solid) = offset.
    pub offset: f32,
    /// Scene units squared.
    pub area: f32,
    /// Corners as indices into [`Convex::vertices`], against the clock seen from outside.
    pub corners: Vec<u32>,
    /// Which of the planes given to [`Convex::from_planes`] bears it.
    pub source: u32,
}

/// A bounded convex solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Convex {
    center: Vec3,
    /// Largest distance of a vertex from the centre.
    radius: f32,
    /// The facets' planes twice over, as one ray and as several like them, the nearest to the centre first.
    blocks: Vec<Block>,
    spread: Vec<Spread>,
    /// The facet of each plane of `blocks` and `spread`.
    order: Vec<u32>,
    facets: Vec<Facet>,
    vertices: Vec<Vec3>,
    edges: Vec<[u32; 2]>,
    bounds: Bounds,
    area: f32,
    exact: Polyhedron,
}

impl Convex {
    /// The solid behind all planes. Planes that touch nothing are dropped; normals may have any length.
    pub fn from_planes(planes: &[Plane]) -> Result<Self, GeometryError> {
        Self::from_polyhedron(Polyhedron::new(planes)?)
    }

    /// A box, edges along the axes.
    pub fn cuboid(center: Vec3, half: Vec3) -> Result<Self, GeometryError> {
        check::point("the centre of the box", center)?;
        for extent in half.to_array() {
            check::length("a half edge of the box", extent as f64)?;
        }
        let (c, h) = (center.as_dvec3(), half.as_dvec3());
        let planes: Vec<Plane> = [DVec3::X, DVec3::Y, DVec3::Z]
            .into_iter()
            .flat_map(|axis| [-axis, axis].map(|normal| Plane::new(normal, normal.dot(c) + axis.dot(h))))
            .collect();
        Self::from_planes(&planes)
    }

    fn from_polyhedron(exact: Polyhedron) -> Result<Self, GeometryError> {
        let mean = exact.vertices.iter().sum::<DVec3>() / exact.vertices.len() as f64;
        let center = mean.as_vec3();
        check::point("the centre of the convex solid", center)?;
        // Offsets are from the rounded centre: it is the one that rays are measured from.
        let origin = center.as_dvec3();
        let radius = exact.vertices.iter().map(|v| (*v - origin).length()).fold(0.0, f64::max);
        check::length("the size of the convex solid", radius)?;
        let vertices: Vec<Vec3> = exact.vertices.iter().map(|v| v.as_vec3()).collect();
        let facets: Vec<Facet> = exact
            .faces
            .iter()
            .map(|face| {
                let plane = &exact.planes[face.plane];
                Facet {
                    normal: plane.normal.as_vec3(),
                    offset: (plane.offset - plane.normal.dot(origin)) as f32,
                    area: polyhedron::area(&exact.vertices, &face.corners) as f32,
                    corners: face.corners.iter().map(|&c| c as u32).collect(),
                    source: exact.sources[face.plane],
                }
            })
            .collect();
        let mut order: Vec<u32> = (0..facets.len() as u32).collect();
        order.sort_by(|&a, &b| facets[a as usize].offset.total_cmp(&facets[b as usize].offset));
        let sorted = || order.iter().map(|&facet| &facets[facet as usize]);
        let mut blocks = vec![Block::EMPTY; facets.len().div_ceil(BLOCK)];
        for (i, facet) in sorted().enumerate() {
            let (block, k) = (&mut blocks[i / BLOCK], i % BLOCK);
            (block.x[k], block.y[k], block.z[k], block.offset[k]) =
                (facet.normal.x, facet.normal.y, facet.normal.z, facet.offset);
        }
        let mut edges: Vec<[u32; 2]> = facets
            .iter()
            .flat_map(|f| (0..f.corners.len()).map(|k| [f.corners[k], f.corners[(k + 1) % f.corners.len()]]))
            .filter(|[a, b]| a < b)
            .collect();
        edges.sort_unstable();
        edges.dedup();
        Ok(Self {
            center,
            radius: radius as f32,
            blocks,
            spread: sorted().map(|f| Spread::new(f.normal, f.offset)).collect(),
            order,
            bounds: Bounds::of(vertices.iter().copied()),
            area: facets.iter().map(|f| f.area as f64).sum::<f64>() as f32,
            facets,
            vertices,
            edges,
            exact,
        })
    }

    /// Under any affine map with an inverse.
    pub fn transformed(&self, affine: &Affine3A) -> Result<Self, GeometryError> {
        let transform = check::Transform::new(affine)?;
        if transform.determinant() == 0.0 {
            return Err(GeometryError::Singular);
        }
        let normals = transform.of_normals();
        let corner = |face: usize| self.exact.vertices[self.exact.faces[face].corners[0]];
        let planes: Vec<Plane> = (0..self.exact.faces.len())
            .map(|i| Plane::through(transform.point(corner(i)), normals.vector(self.exact.planes[i].normal)))
            .collect();
        let mut solid = Polyhedron::new(&planes).map_err(|error| match error {
            GeometryError::BadPlane { .. } => GeometryError::Singular,
            other => other,
        })?;
        for source in &mut solid.sources {
            *source = self.exact.sources[*source as usize];
        }
        Self::from_polyhedron(solid)
    }

    /// In the order of the planes they lie on.
    pub fn facets(&self) -> &[Facet] {
        &self.facets
    }

    /// World space.
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// Pairs of vertices.
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    /// The point that facets' offsets are measured from: the mean of the vertices.
    pub fn center(&self) -> Vec3 {
        self.center
    }

    /// Largest distance of a vertex from the centre.
    pub fn radius(&self) -> f32 {
        self.radius
    }

    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    pub fn area(&self) -> f32 {
        self.area
    }

    /// Scene units cubed.
    pub fn volume(&self) -> f32 {
        let cones = self.facets.iter().map(|f| f.offset as f64 * f.area as f64);
        (cones.sum::<f64>() / 3.0) as f32
    }

    /// Strictly inside.
    pub fn contains(&self, point: Vec3) -> bool {
        let o = point - self.center;
        self.facets.iter().all(|f| f.normal.dot(o) < f.offset)
    }

    /// Outward unit normal of a facet; zero if there is no such facet.
    #[inline]
    pub fn normal(&self, facet: u32) -> Vec3 {
        self.facets.get(facet as usize).map_or(Vec3::ZERO, |f| f.normal)
    }

    /// A point near a facet put onto its plane, which takes away the rounding of the distance travelled.
    #[inline]
    pub fn project(&self, near: Vec3, facet: u32) -> Vec3 {
        let Some(f) = self.facets.get(facet as usize) else { return near };
        near - f.normal * (f.normal.dot(near - self.center) - f.offset)
    }

    /// Coordinates: scene units along two axes in the facet, from the foot of the solid's centre.
    pub(super) fn surface(&self, near: Vec3, facet: u32) -> Surface {
        Surface::plain(self.project(near, facet), self.normal(facet))
    }
}
