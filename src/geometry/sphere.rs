//! A sphere.
//!
//! Source: E. Haines, J. Günther, T. Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems
//! (2019), ch. 7, after Hearn and Baker: the discriminant comes from the part of the origin perpendicular to the ray, which
//! keeps its digits when the sphere is far or large, and the nearer root from c / q.

use glam::{Affine3A, Vec2, Vec3};

use super::ray::{Crossing, Probe, Side, Surface};
use super::{Bounds, GeometryError, check};

const EPSILON: f32 = f32::EPSILON;

/// A ball; lengths in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    center: Vec3,
    radius: f32,
}

impl Sphere {
    pub fn new(center: Vec3, radius: f32) -> Result<Self, GeometryError> {
        check::point("the centre of the sphere", center)?;
        check::length("the radius of the sphere", radius as f64)?;
        Ok(Self { center, radius })
    }

    pub fn center(&self) -> Vec3 {
        self.center
    }

    pub fn radius(&self) -> f32 {
        self.radius
    }

    pub fn bounds(&self) -> Bounds {
        let r = Vec3::splat(self.radius);
        Bounds { min: self.center - r, max: self.center + r }
    }

    pub fn area(&self) -> f32 {
        4.0 * std::f32::consts::PI * self.radius * self.radius
    }

    /// Strictly inside.
    pub fn contains(&self, point: Vec3) -> bool {
        (point - self.center).length_squared() < self.radius * self.radius
    }

    /// Moved, turned, mirrored and scaled evenly; anything else is an ellipsoid and an error.
    pub fn transformed(&self, affine: &Affine3A) -> Result<Self, GeometryError> {
        let transform = check::Transform::new(affine)?;
        let [x, y, z] = [transform.matrix.x_axis, transform.matrix.y_axis, transform.matrix.z_axis];
        let scale = x.length();
        if scale == 0.0 || transform.determinant() == 0.0 {
            return Err(GeometryError::Singular);
        }
        // The matrix is given in single precision: an even scale is one to within its roundings.
        let tolerance = 8.0 * EPSILON as f64;
        let uneven = |other: f64| (other - scale).abs() > tolerance * scale;
        let oblique = |dot: f64| dot.abs() > tolerance * scale * scale;
        if uneven(y.length()) || uneven(z.length()) || oblique(x.dot(y)) || oblique(y.dot(z)) || oblique(z.dot(x)) {
            return Err(GeometryError::Ellipsoid);
        }
        Self::new(transform.point(self.center.as_dvec3()).as_vec3(), (self.radius as f64 * scale) as f32)
    }

    /// A ray that comes from elsewhere.
    #[inline]
    pub(super) fn meet(&self, probe: &Probe) -> Option<Crossing> {
        let r = self.radius;
        let f = probe.ray.origin - self.center;
        let along = -f.dot(probe.ray.direction);
        let perpendicular = f + probe.ray.direction * along;
        let c = f.length_squared() - r * r;
        // The origin may be off by `origin_error`; f is rounded once, its square and r² a few times more.
        let error = 2.0 * r * (probe.origin_error + 2.0 * EPSILON * r);
        let discriminant = r * r - perpendicular.length_squared();
        if c < -error {
            let root = discriminant.max(0.0).sqrt();
            // The larger of the two forms never subtracts equal numbers.
            let t = if along >= 0.0 { along + root } else { -c / (root - along) };
            return Some(Crossing { t, slack: slack(error, root, t), side: Side::Inside, facet: 0, place: 0 });
        }
        if !(along > 0.0 && discriminant >= 0.0) {
            return None;
        }
        let root = discriminant.sqrt();
        let t = (c / (along + root)).max(0.0);
        Some(Crossing { t, slack: slack(error, root, t), side: Side::Outside, facet: 0, place: 0 })
    }

    /// A ray that sets off from the surface inwards: the other end of its chord. With the origin on the sphere that is
    /// −2 f·d, without the cancellation of r² − |f|² that makes grazing rays stick.
    #[inline]
    pub(super) fn exit(&self, origin: Vec3, direction: Vec3) -> Crossing {
        let along = (-(origin - self.center).dot(direction)).max(0.0);
        let t = 2.0 * along;
        let error = 2.0 * self.radius * (4.0 * EPSILON * (super::ray::sum_abs(origin) + self.radius));
        Crossing { t, slack: slack(error, along, t), side: Side::Inside, facet: 0, place: 0 }
    }

    /// Azimuth from +x towards +y over a whole turn, and angle from −z over half of one, each 0…1.
    pub(super) fn uv(&self, point: Vec3) -> Vec2 {
        let d = point - self.center;
        let turn = libm::atan2f(d.y, d.x) / std::f32::consts::TAU;
        let height = libm::atan2f(libm::hypotf(d.x, d.y), -d.z) / std::f32::consts::PI;
        Vec2::new(if turn < 0.0 { turn + 1.0 } else { turn }, height)
    }

    /// Point and normal of a crossing.
    pub(super) fn surface(&self, near: Vec3) -> Surface {
        let normal = (near - self.center).try_normalize().unwrap_or(Vec3::Z);
        Surface::plain(self.center + normal * self.radius, normal)
    }
}

/// Error of t from an error of c = |f|² − r², where dc/dt = 2 root, and from the roundings of t itself.
#[inline]
fn slack(error: f32, root: f32, t: f32) -> f32 {
    error / (2.0 * root) + 4.0 * EPSILON * t
}
