//! Convex solids as the half-spaces they are made of.
//!
//! A gem is one primitive and not a mesh: a ray inside meets exactly one exit facet, found without epsilon or leak, and the
//! same planes serve eight rays at once. Planes are kept relative to a centre, so that a small stone far from the origin
//! loses nothing but the rounding of the ray's own origin.

mod bundle;
mod exit;
mod meet;
mod planes;
mod polyhedron;
mod topology;

use std::sync::Arc;

use glam::{Affine3A, DVec3, Vec3};

pub use exit::Exits;
pub use polyhedron::Plane;

use super::ray::Surface;
use super::{Bounds, GeometryError, check};
use planes::{BLOCK, Block};
use polyhedron::{Face, Polyhedron};
use topology::{Shared, Topology};

/// A facet of a convex solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet {
    /// Outward unit normal.
    pub normal: Vec3,
    /// The facet's plane: normal·(p − centre of the solid) = offset.
    pub offset: f32,
    /// Scene units squared.
    pub area: f32,
}

/// A bounded convex solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Convex {
    center: Vec3,
    /// Largest distance of a vertex from the centre.
    radius: f32,
    /// The facets' planes, the nearest to the centre first.
    blocks: Vec<Block>,
    /// The facet of each plane of `blocks`.
    order: Vec<u32>,
    facets: Vec<Facet>,
    vertices: Vec<Vec3>,
    bounds: Bounds,
    area: f32,
    /// The solid as it was cut.
    shared: Arc<Shared>,
    /// Where a copy of it stands.
    place: Option<Box<check::Transform>>,
}

/// Maps that stretch some directions so many times as much as others, by the bound that is 3 for those that stretch all alike, make
/// a solid anew: the copies of vertices that are told apart might not be.
const LOPSIDED: f64 = 30.0;

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
        Self::at(Arc::new(Shared::new(exact)), None)
    }

    /// A solid as it was cut, or a copy of it at a place.
    fn at(shared: Arc<Shared>, place: Option<check::Transform>) -> Result<Self, GeometryError> {
        let exact = &shared.exact;
        let moved: Vec<DVec3>;
        let points = match &place {
            Some(place) => {
                moved = exact.vertices.iter().map(|vertex| place.point(*vertex)).collect();
                &moved
            }
            None => &exact.vertices,
        };
        let mean = points.iter().sum::<DVec3>() / points.len() as f64;
        let center = mean.as_vec3();
        check::point("the centre of the convex solid", center)?;
        // Offsets are from the rounded centre: it is the one that rays are measured from.
        let origin = center.as_dvec3();
        let radius = points.iter().map(|v| (*v - origin).length()).fold(0.0, f64::max);
        check::length("the size of the convex solid", radius)?;
        let vertices: Vec<Vec3> = points.iter().map(|v| v.as_vec3()).collect();
        let normals = place.as_ref().map(check::Transform::of_normals);
        let facets: Vec<Facet> = exact
            .faces
            .iter()
            .map(|face| {
                let plane = match &normals {
                    Some(normals) => moved_plane(exact, face, points, normals)?,
                    None => exact.planes[face.plane],
                };
                Ok(Facet {
                    normal: plane.normal.as_vec3(),
                    offset: (plane.offset - plane.normal.dot(origin)) as f32,
                    area: polyhedron::area(points, &face.corners) as f32,
                })
            })
            .collect::<Result<_, GeometryError>>()?;
        let mut order: Vec<u32> = (0..facets.len() as u32).collect();
        order.sort_by(|&a, &b| facets[a as usize].offset.total_cmp(&facets[b as usize].offset));
        let mut blocks = vec![Block::EMPTY; facets.len().div_ceil(BLOCK)];
        for (i, facet) in order.iter().map(|&facet| &facets[facet as usize]).enumerate() {
            let (block, k) = (&mut blocks[i / BLOCK], i % BLOCK);
            (block.x[k], block.y[k], block.z[k], block.offset[k]) =
                (facet.normal.x, facet.normal.y, facet.normal.z, facet.offset);
        }
        Ok(Self {
            center,
            radius: radius as f32,
            blocks,
            order,
            bounds: Bounds::of(vertices.iter().copied()),
            area: facets.iter().map(|f| f.area as f64).sum::<f64>() as f32,
            facets,
            vertices,
            shared,
            place: place.map(Box::new),
        })
    }

    /// Under any affine map with an inverse, cut anew from the planes where they come to lie.
    pub fn transformed(&self, affine: &Affine3A) -> Result<Self, GeometryError> {
        let place = self.placed(affine)?;
        let exact = &self.shared.exact;
        let points: Vec<DVec3> = exact.vertices.iter().map(|vertex| place.point(*vertex)).collect();
        let normals = place.of_normals();
        let planes: Vec<Plane> = exact.faces.iter().map(|face| turned_plane(exact, face, &points, &normals)).collect();
        let mut solid = Polyhedron::new(&planes).map_err(|error| match error {
            GeometryError::BadPlane { .. } => GeometryError::Singular,
            other => other,
        })?;
        for source in &mut solid.sources {
            *source = exact.sources[*source as usize];
        }
        Self::from_polyhedron(solid)
    }

    /// The same as [`Convex::transformed`] to within rounding, but what no map changes is shared with this solid: a copy of a brilliant
    /// costs 7 kB and 10 µs. Maps that squash the solid cut it anew.
    pub fn copied(&self, affine: &Affine3A) -> Result<Self, GeometryError> {
        let place = self.placed(affine)?;
        let lopsided = place.inverse().is_none_or(|back| !(back.stretch() * place.stretch() < LOPSIDED));
        if lopsided { self.transformed(affine) } else { Self::at(self.shared.clone(), Some(place)) }
    }

    /// The map from the solid as it was cut to where a map brings this one.
    fn placed(&self, affine: &Affine3A) -> Result<check::Transform, GeometryError> {
        let transform = check::Transform::new(affine)?;
        let place = self.place.as_ref().map_or(transform, |place| transform.after(place));
        if place.determinant() == 0.0 { Err(GeometryError::Singular) } else { Ok(place) }
    }

    /// Whether both are copies of one solid, which is there only once.
    pub fn shares_with(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.shared, &other.shared)
    }

    /// How many bytes the solid takes besides what it shares with its copies.
    pub fn own_bytes(&self) -> usize {
        size_of::<Self>()
            + size_of_val(&*self.blocks)
            + size_of_val(&*self.order)
            + size_of_val(&*self.facets)
            + size_of_val(&*self.vertices)
            + self.place.as_ref().map_or(0, |place| size_of_val(&**place))
    }

    fn topology(&self) -> &Topology {
        self.shared.topology(self.place.as_ref().is_some_and(|place| place.determinant() < 0.0))
    }

    /// In the order of the planes they lie on.
    pub fn facets(&self) -> &[Facet] {
        &self.facets
    }

    /// The corners of a facet as indices into [`Convex::vertices`], against the clock seen from outside; none if there is no such facet.
    pub fn corners(&self, facet: u32) -> &[u32] {
        self.topology().corners(facet)
    }

    /// Which of the planes given to [`Convex::from_planes`] bears a facet.
    pub fn source(&self, facet: u32) -> Option<u32> {
        self.shared.exact.sources.get(facet as usize).copied()
    }

    /// World space.
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// Pairs of vertices.
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.topology().edges
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

/// The plane of a face where its normal is turned to and its first corner is moved to, of `points`.
fn turned_plane(exact: &Polyhedron, face: &Face, points: &[DVec3], normals: &check::Transform) -> Plane {
    Plane::through(points[face.corners[0]], normals.vector(exact.planes[face.plane].normal))
}

fn moved_plane(
    exact: &Polyhedron,
    face: &Face,
    points: &[DVec3],
    normals: &check::Transform,
) -> Result<Plane, GeometryError> {
    turned_plane(exact, face, points, normals).normalised().ok_or(GeometryError::Singular)
}
