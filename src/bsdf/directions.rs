//! One direction per wavelength, as a structure of arrays: after a dispersive refraction every lane goes its own way.

use crate::spectrum::Lanes;
use glam::Vec3;

/// N unit vectors, component by component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Directions<const N: usize> {
    pub x: [f32; N],
    pub y: [f32; N],
    pub z: [f32; N],
}

impl<const N: usize> Directions<N> {
    /// The same direction for all lanes.
    #[inline]
    pub fn splat(direction: Vec3) -> Self {
        Self { x: [direction.x; N], y: [direction.y; N], z: [direction.z; N] }
    }

    #[inline]
    pub fn from_fn(f: impl Fn(usize) -> Vec3) -> Self {
        let mut directions = Self::splat(Vec3::ZERO);
        for lane in 0..N {
            directions.set(lane, f(lane));
        }
        directions
    }

    #[inline]
    pub fn get(&self, lane: usize) -> Vec3 {
        Vec3::new(self.x[lane], self.y[lane], self.z[lane])
    }

    #[inline]
    pub fn set(&mut self, lane: usize, direction: Vec3) {
        self.x[lane] = direction.x;
        self.y[lane] = direction.y;
        self.z[lane] = direction.z;
    }

    /// Scalar product, lane by lane.
    #[inline]
    pub fn dot(&self, other: &Self) -> Lanes<N> {
        let mut dot = Lanes::ZERO;
        for lane in 0..N {
            dot[lane] = self.x[lane] * other.x[lane] + self.y[lane] * other.y[lane] + self.z[lane] * other.z[lane];
        }
        dot
    }
}
