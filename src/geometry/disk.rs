//! A disk, or any ellipse.

use glam::{Affine3A, Vec3};

use super::flat::Flat;
use super::ray::{Crossing, Probe, Surface};
use super::{Bounds, GeometryError};

/// An ellipse about its centre: centre + a u + b v with a² + b² ≤ 1; cross(u, v) points to the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disk {
    pub(super) flat: Flat,
}

impl Disk {
    /// `u` and `v` go from the centre to the rim (a circle: equally long and perpendicular), in scene units.
    pub fn new(center: Vec3, u: Vec3, v: Vec3) -> Result<Self, GeometryError> {
        Ok(Self { flat: Flat::new("disk", center, u, v)? })
    }

    /// A circle that faces `normal` (of any length).
    pub fn facing(center: Vec3, normal: Vec3, radius: f32) -> Result<Self, GeometryError> {
        super::check::length("the radius of the disk", radius as f64)?;
        if !normal.is_finite() {
            return Err(GeometryError::NotFinite { what: "the normal of the disk" });
        }
        let normal = normal
            .as_dvec3()
            .try_normalize()
            .ok_or(GeometryError::NotPositive { what: "the length of the disk's normal", value: 0.0 })?;
        let (u, v) = super::sampling::basis(normal.as_vec3());
        Self::new(center, u * radius, v * radius)
    }

    pub fn center(&self) -> Vec3 {
        self.flat.center
    }

    /// The two axes, from the centre to the rim.
    pub fn axes(&self) -> [Vec3; 2] {
        [self.flat.u, self.flat.v]
    }

    /// Unit normal of the front.
    pub fn normal(&self) -> Vec3 {
        self.flat.normal
    }

    pub fn bounds(&self) -> Bounds {
        let half = (self.flat.u.abs() * self.flat.u.abs() + self.flat.v.abs() * self.flat.v.abs()).map(f32::sqrt);
        Bounds { min: self.flat.center - half, max: self.flat.center + half }
    }

    pub fn area(&self) -> f32 {
        std::f32::consts::PI * self.flat.jacobian
    }

    pub fn transformed(&self, affine: &Affine3A) -> Result<Self, GeometryError> {
        Ok(Self { flat: self.flat.transformed("disk", affine)? })
    }

    #[inline]
    pub(super) fn meet(&self, probe: &Probe) -> Option<Crossing> {
        let plane = self.flat.meet(probe)?;
        let within = plane.a * plane.a + plane.b * plane.b <= 1.0;
        within.then_some(plane.crossing)
    }

    /// The coordinates are those of the parallelogram around the ellipse.
    pub(super) fn surface(&self, near: Vec3) -> Surface {
        let (point, _, _) = self.flat.project(near);
        Surface::plain(point, self.flat.normal)
    }
}
