//! One vector per wavelength, as a structure of arrays, so that loops over rays become vector
//! instructions: after a dispersive refraction every lane goes its own way.

use super::Lanes;
use glam::Vec3;

/// N points or directions, component by component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vectors<const N: usize> {
    pub x: [f32; N],
    pub y: [f32; N],
    pub z: [f32; N],
}

impl<const N: usize> Vectors<N> {
    /// The same vector for all lanes.
    #[inline]
    pub fn splat(v: Vec3) -> Self {
        Self { x: [v.x; N], y: [v.y; N], z: [v.z; N] }
    }

    /// The vector that `f` gives for each lane.
    #[inline]
    pub fn from_fn(f: impl Fn(usize) -> Vec3) -> Self {
        let mut vectors = Self::splat(Vec3::ZERO);
        for lane in 0..N {
            vectors.set(lane, f(lane));
        }
        vectors
    }

    /// Returns the vector of a lane; that of lanes beyond N is NaN.
    #[inline]
    pub fn get(&self, lane: usize) -> Vec3 {
        if lane < N { Vec3::new(self.x[lane], self.y[lane], self.z[lane]) } else { Vec3::NAN }
    }

    /// Sets the vector of a lane; lanes beyond N are ignored.
    #[inline]
    pub fn set(&mut self, lane: usize, v: Vec3) {
        if lane < N {
            self.x[lane] = v.x;
            self.y[lane] = v.y;
            self.z[lane] = v.z;
        }
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
