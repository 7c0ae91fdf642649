//! A mesh at a place in the world.

use std::sync::Arc;

use glam::{Affine3A, DVec3, Vec2, Vec3};

use super::query::{First, NONE, Query};
use super::{Mesh, Spot};
use crate::geometry::ray::{Crossing, Met, Probe, Ray, Surface};
use crate::geometry::shape::Leaving;
use crate::geometry::{Bounds, GeometryError, Side, check};

/// A mesh under an affine map. Copies share the mesh; a copy of its own costs 370 bytes.
#[derive(Clone, Debug)]
pub struct Placed {
    mesh: Arc<Mesh>,
    /// None where the mesh already is in the world's space.
    frame: Option<Box<Frame>>,
    bounds: Bounds,
    /// Largest coordinate of a corner.
    extent: f32,
}

#[derive(Clone, Debug)]
struct Frame {
    to_world: check::Transform,
    to_mesh: check::Transform,
    /// From the mesh to the world.
    normals: check::Transform,
    /// At most so many times longer becomes a vector on its way from the world to the mesh.
    stretch: f64,
}

impl Placed {
    /// A mesh where it is.
    pub fn new(mesh: Arc<Mesh>) -> Self {
        let bounds = mesh.bounds();
        Self { mesh, frame: None, extent: extent(&bounds), bounds }
    }

    pub fn mesh(&self) -> &Arc<Mesh> {
        &self.mesh
    }

    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Moved by any affine map that keeps a volume; the outside stays outside under mirrors.
    pub fn transformed(&self, affine: &Affine3A) -> Result<Self, GeometryError> {
        let mut to_world = check::Transform::new(affine)?;
        if let Some(frame) = &self.frame {
            to_world = to_world.after(&frame.to_world);
        }
        let to_mesh = to_world.inverse().ok_or(GeometryError::Singular)?;
        let stretch = to_mesh.stretch();
        let corners = self.mesh.bounds().corners().map(|corner| to_world.point(corner.as_dvec3()).as_vec3());
        let bounds = Bounds::of(corners);
        check::point("a corner of the mesh, where it is placed,", bounds.min)?;
        check::point("a corner of the mesh, where it is placed,", bounds.max)?;
        let frame = Some(Box::new(Frame { to_world, to_mesh, normals: to_world.of_normals(), stretch }));
        Ok(Self { mesh: self.mesh.clone(), frame, bounds, extent: extent(&bounds) })
    }

    pub fn is_closed(&self) -> bool {
        self.mesh.is_closed()
    }

    pub(in crate::geometry) fn extent(&self) -> f32 {
        self.extent
    }

    /// Scene units squared.
    pub fn area(&self) -> f32 {
        (0..self.mesh.triangles.indices.len() as u32).map(|triangle| self.area_of(triangle)).sum::<f64>() as f32
    }

    /// Scene units cubed; zero unless it is closed.
    pub fn volume(&self) -> f64 {
        let own = if self.is_closed() { self.mesh.surroundings().volume } else { 0.0 };
        own * self.frame.as_ref().map_or(1.0, |frame| frame.to_world.determinant().abs())
    }

    pub(in crate::geometry) fn area_of(&self, triangle: u32) -> f64 {
        let [a, b, c] = self.corners(triangle);
        0.5 * (b - a).cross(c - a).length()
    }

    /// Corners of a triangle in the world's space.
    pub(in crate::geometry) fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.mesh.corners(triangle).map(|corner| self.to_world(corner))
    }

    /// Some of its corners, spread over the file's order.
    pub fn some_corners(&self, count: usize) -> impl Iterator<Item = Vec3> {
        let positions = &self.mesh.triangles.positions;
        let step = positions.len().div_ceil(count.max(1)).max(1);
        positions.iter().step_by(step).map(|p| self.to_world(p.as_dvec3()).as_vec3())
    }

    /// Whether `test` holds for a triangle whose surroundings meet a box.
    pub(in crate::geometry) fn any_triangle_near(&self, bounds: &Bounds, test: impl Fn(&[DVec3; 3]) -> bool) -> bool {
        let near = Bounds::of(bounds.corners().map(|corner| self.to_mesh(corner).as_vec3())).padded();
        self.mesh.triangles_near(&near).any(|triangle| test(&self.corners(triangle)))
    }

    #[inline]
    fn to_world(&self, p: DVec3) -> DVec3 {
        self.frame.as_ref().map_or(p, |frame| frame.to_world.point(p))
    }

    #[inline]
    fn to_mesh(&self, p: Vec3) -> DVec3 {
        self.frame.as_ref().map_or(p.as_dvec3(), |frame| frame.to_mesh.point(p.as_dvec3()))
    }

    #[inline]
    fn direction(&self, d: Vec3) -> DVec3 {
        self.frame.as_ref().map_or(d.as_dvec3(), |frame| frame.to_mesh.vector(d.as_dvec3()))
    }

    /// Outwards, of unit length.
    #[inline(always)]
    fn normal(&self, n: DVec3) -> Vec3 {
        self.frame.as_ref().map_or(n, |frame| frame.normals.vector(n)).normalize().as_vec3()
    }

    /// A ray from elsewhere, in the space of the mesh.
    #[inline(always)]
    fn query(&self, probe: &Probe, but: Option<u32>) -> Query {
        let skip = [NONE, but.unwrap_or(NONE)];
        let comes = [true, probe.leaves_solid && !self.mesh.is_closed()];
        let &Probe { ray: &Ray { origin, direction, .. }, origin_error: error, .. } = probe;
        let Some(frame) = &self.frame else { return Query { origin, direction, error, comes, skip } };
        let origin = frame.to_mesh.point(origin.as_dvec3()).as_vec3();
        let direction = frame.to_mesh.vector(direction.as_dvec3()).as_vec3();
        let rounding = f32::EPSILON * origin.abs().max_element();
        Query { origin, direction, error: error * frame.stretch as f32 + rounding, comes, skip }
    }

    #[inline(always)]
    pub(in crate::geometry) fn meet(&self, probe: &Probe, limit: f32) -> Option<Crossing> {
        self.first(probe, limit).crossing()
    }

    #[inline(never)]
    fn first(&self, probe: &Probe, limit: f32) -> First {
        self.mesh.closest(&self.query(probe, None), limit)
    }

    /// Whether the mesh, but for one triangle, surely is in the way.
    #[inline(never)]
    pub(in crate::geometry) fn hides(&self, probe: &Probe, limit: f32, but: Option<u32>) -> bool {
        self.mesh.hides(&self.query(probe, but), limit)
    }

    /// A ray that leaves a triangle of the mesh, in its space.
    #[inline]
    fn leaving(&self, leaving: &Leaving, but: Option<u32>) -> Query {
        let &Leaving { ray, facet, side, place } = leaving;
        let corners = self.mesh.corners_of(facet, place);
        let skip = [facet, but.unwrap_or(NONE)];
        Query::leaving(self.to_mesh(ray.origin), self.direction(ray.direction), corners, side, skip)
    }

    /// What a ray meets of the mesh that it leaves.
    #[inline]
    pub(in crate::geometry) fn again(&self, leaving: &Leaving, limit: f32) -> Option<Crossing> {
        let query = self.leaving(leaving, None);
        self.mesh.bounded(&query, self.mesh.closest(&query, limit))
    }

    /// Whether the mesh that a ray leaves, but for one triangle, surely is in its own way.
    #[inline]
    pub(in crate::geometry) fn hides_again(&self, leaving: &Leaving, limit: f32, but: Option<u32>) -> bool {
        self.mesh.hides(&self.leaving(leaving, but), limit)
    }

    /// Strictly inside, told by what a line from the point meets first.
    pub(in crate::geometry) fn contains(&self, point: Vec3) -> bool {
        if !self.is_closed() || !self.bounds.contains(point) {
            return false;
        }
        let probe = Probe { ray: &Ray::free(point, Vec3::Z), origin_error: 0.0, leaves_solid: false };
        self.meet(&probe, f32::INFINITY).is_some_and(|crossing| crossing.side == Side::Inside)
    }

    /// Outwards, of unit length.
    pub(in crate::geometry) fn normal_of(&self, triangle: u32) -> Vec3 {
        let [a, b, c] = self.mesh.corners(triangle);
        self.normal((b - a).cross(c - a))
    }

    #[inline]
    pub(in crate::geometry) fn surface(&self, near: Vec3, met: &Met) -> Surface {
        let spot = Spot::nearest(self.to_mesh(near), self.mesh.corners_at(met.place));
        let (point, normal) = (self.to_world(spot.point).as_vec3(), self.normal(spot.normal));
        let smooth = if self.mesh.is_smooth() { self.mesh.smooth_normal(&spot, met.facet) } else { None };
        let shading = smooth.map_or(normal, |smooth| self.normal(smooth));
        Surface { point, normal, shading }
    }

    pub(in crate::geometry) fn uv(&self, point: Vec3, triangle: u32) -> Option<Vec2> {
        self.mesh.uv(self.to_mesh(point), triangle)
    }
}

/// Copies of one mesh are equal if they stand at the same place.
impl PartialEq for Placed {
    fn eq(&self, other: &Self) -> bool {
        let place = |p: &Self| p.frame.as_ref().map(|f| (f.to_world.matrix, f.to_world.translation));
        Arc::ptr_eq(&self.mesh, &other.mesh) && place(self) == place(other)
    }
}

fn extent(bounds: &Bounds) -> f32 {
    bounds.min.abs().max(bounds.max.abs()).max_element()
}
