//! What rectangles and disks share: a centre and two vectors that span a plane.

use glam::{Affine3A, DVec3, Vec2, Vec3};

use super::ray::{Crossing, Probe, Side, sum_abs};
use super::{GeometryError, check};

const EPSILON: f32 = f32::EPSILON;

/// The points centre + a u + b v; the front is where cross(u, v) points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flat {
    pub center: Vec3,
    pub u: Vec3,
    pub v: Vec3,
    pub normal: Vec3,
    /// |cross(u, v)|.
    pub jacobian: f32,
    /// a = (p − centre)·dual_u, b = (p − centre)·dual_v.
    dual_u: Vec3,
    dual_v: Vec3,
    /// Sums of the components' absolute values of both.
    sums: [f32; 2],
}

/// A crossing of the plane, with its coordinates there and how far they may be off.
pub(super) struct PlaneCrossing {
    pub crossing: Crossing,
    pub a: f32,
    pub b: f32,
    pub margin_a: f32,
    pub margin_b: f32,
}

impl Flat {
    pub fn new(what: &'static str, center: Vec3, u: Vec3, v: Vec3) -> Result<Self, GeometryError> {
        check::point(what, center)?;
        check::point(what, u)?;
        check::point(what, v)?;
        let (du, dv) = (u.as_dvec3(), v.as_dvec3());
        let cross = du.cross(dv);
        let jacobian = cross.length();
        // Edges closer to parallel than single precision can tell have no plane.
        if jacobian <= 4.0 * EPSILON as f64 * du.length() * dv.length() {
            return Err(GeometryError::NoArea { what });
        }
        check::length(what, du.length())?;
        check::length(what, dv.length())?;
        let normal = cross / jacobian;
        let (dual_u, dual_v) = ((dv.cross(normal) / jacobian).as_vec3(), (normal.cross(du) / jacobian).as_vec3());
        Ok(Self {
            center,
            u,
            v,
            normal: normal.as_vec3(),
            jacobian: jacobian as f32,
            dual_u,
            dual_v,
            sums: [sum_abs(dual_u), sum_abs(dual_v)],
        })
    }

    /// Under any affine map that keeps an area. The front follows the matter: a mirror turns u round, so that
    /// cross(u, v) points where the image of the front is.
    pub fn transformed(&self, what: &'static str, affine: &Affine3A) -> Result<Self, GeometryError> {
        let transform = check::Transform::new(affine)?;
        let map = |v: Vec3| -> DVec3 { transform.vector(v.as_dvec3()) };
        let (mut u, v) = (map(self.u), map(self.v));
        if transform.determinant() < 0.0 {
            u = -u;
        }
        Self::new(what, transform.point(self.center.as_dvec3()).as_vec3(), u.as_vec3(), v.as_vec3())
    }

    /// Where a ray from elsewhere crosses the plane.
    ///
    /// An origin that lies on the plane to within rounding belongs to a surface that touches it. A ray that comes to the
    /// front from there has yet to cross (t = 0), or it would fall through where a solid stands on a table or two walls
    /// meet; so has one that leaves the outside of a solid. One that moves off to the front has not crossed.
    #[inline]
    pub fn meet(&self, probe: &Probe) -> Option<PlaneCrossing> {
        let f = probe.ray.origin - self.center;
        let cosine = self.normal.dot(probe.ray.direction);
        let height = self.normal.dot(f);
        let mut t = -height / cosine;
        let reach = sum_abs(f);
        let error = probe.origin_error + 4.0 * EPSILON * reach;
        let slack = error / cosine.abs() + 2.0 * EPSILON * t.abs();
        let front = cosine < 0.0;
        if front || probe.leaves_solid {
            if !(t >= -slack) {
                return None;
            }
            t = t.max(0.0);
        } else if !(t > slack) {
            return None;
        }
        let w = f + probe.ray.direction * t;
        // Neighbours that share an edge must leave no crack: coordinates count as within when they may be.
        let margin = 2.0 * EPSILON * (reach + t);
        let side = if front { Side::Outside } else { Side::Inside };
        Some(PlaneCrossing {
            crossing: Crossing { t, slack, side, facet: 0, place: 0 },
            a: w.dot(self.dual_u),
            b: w.dot(self.dual_v),
            margin_a: margin * self.sums[0],
            margin_b: margin * self.sums[1],
        })
    }

    /// −1…1 along both vectors as 0…1.
    pub fn uv(&self, point: Vec3) -> Vec2 {
        let (_, a, b) = self.project(point);
        Vec2::new(a, b) * 0.5 + 0.5
    }

    /// A point near the plane put onto it, and its two coordinates.
    pub fn project(&self, near: Vec3) -> (Vec3, f32, f32) {
        let w = near - self.center;
        (near - self.normal * self.normal.dot(w), w.dot(self.dual_u), w.dot(self.dual_v))
    }
}
