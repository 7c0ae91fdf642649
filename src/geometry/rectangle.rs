//! A rectangle, or any parallelogram.

use glam::{Affine3A, Vec3};

use super::flat::Flat;
use super::ray::{Crossing, Probe, Surface};
use super::{Bounds, GeometryError};

/// A parallelogram about its centre. The corners are centre ± u/2 ± v/2; cross(u, v) points to the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Spanned by the half edges.
    pub(super) flat: Flat,
}

impl Rectangle {
    /// `u` and `v` are whole edges, in scene units.
    pub fn new(center: Vec3, u: Vec3, v: Vec3) -> Result<Self, GeometryError> {
        Ok(Self { flat: Flat::new("rectangle", center, u * 0.5, v * 0.5)? })
    }

    pub fn center(&self) -> Vec3 {
        self.flat.center
    }

    /// The two edges.
    pub fn edges(&self) -> [Vec3; 2] {
        [self.flat.u * 2.0, self.flat.v * 2.0]
    }

    /// Unit normal of the front.
    pub fn normal(&self) -> Vec3 {
        self.flat.normal
    }

    /// In order around the front, against the clock.
    pub fn corners(&self) -> [Vec3; 4] {
        let Flat { center: c, u, v, .. } = self.flat;
        [c - u - v, c + u - v, c + u + v, c - u + v]
    }

    pub fn bounds(&self) -> Bounds {
        let half = self.flat.u.abs() + self.flat.v.abs();
        Bounds { min: self.flat.center - half, max: self.flat.center + half }
    }

    pub fn area(&self) -> f32 {
        4.0 * self.flat.jacobian
    }

    pub fn transformed(&self, affine: &Affine3A) -> Result<Self, GeometryError> {
        Ok(Self { flat: self.flat.transformed("rectangle", affine)? })
    }

    #[inline]
    pub(super) fn meet(&self, probe: &Probe) -> Option<Crossing> {
        let plane = self.flat.meet(probe)?;
        let within = plane.a.abs() <= 1.0 + plane.margin_a && plane.b.abs() <= 1.0 + plane.margin_b;
        within.then_some(plane.crossing)
    }

    pub(super) fn surface(&self, near: Vec3) -> Surface {
        let (point, _, _) = self.flat.project(near);
        Surface::plain(point, self.flat.normal)
    }
}
