//! Planes and rays side by side, as vector instructions take them.

use glam::Vec3;

/// Points or directions of several rays, by component so that loops over rays become vector instructions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Points<const N: usize> {
    pub x: [f32; N],
    pub y: [f32; N],
    pub z: [f32; N],
}

impl<const N: usize> Points<N> {
    pub fn splat(p: Vec3) -> Self {
        Self { x: [p.x; N], y: [p.y; N], z: [p.z; N] }
    }

    pub fn from_fn(f: impl Fn(usize) -> Vec3) -> Self {
        let mut points = Self::splat(Vec3::ZERO);
        for lane in 0..N {
            points.set(lane, f(lane));
        }
        points
    }

    /// Lane `lane`; lanes beyond N are NaN.
    #[inline]
    pub fn get(&self, lane: usize) -> Vec3 {
        if lane < N { Vec3::new(self.x[lane], self.y[lane], self.z[lane]) } else { Vec3::NAN }
    }

    /// Sets lane `lane`; lanes beyond N are ignored.
    #[inline]
    pub fn set(&mut self, lane: usize, p: Vec3) {
        if lane < N {
            self.x[lane] = p.x;
            self.y[lane] = p.y;
            self.z[lane] = p.z;
        }
    }
}

/// The least room in front of a plane. An origin on the plane or, by rounding, beyond it is this far from it: as good as
/// nothing beside the smallest solid there is (1e-15), and among several such planes the one that the ray heads for most wins.
pub(super) const TOUCHING: f32 = 1e-30;

/// Width of the vectors of the processors that we build for.
pub(super) const VECTOR: usize = 8;

/// A plane with each of its numbers eight times over, to meet a vector of rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spread {
    pub x: [f32; VECTOR],
    pub y: [f32; VECTOR],
    pub z: [f32; VECTOR],
    pub offset: [f32; VECTOR],
}

impl Spread {
    pub fn new(normal: Vec3, offset: f32) -> Self {
        Self { x: [normal.x; VECTOR], y: [normal.y; VECTOR], z: [normal.z; VECTOR], offset: [offset; VECTOR] }
    }
}

/// Planes side by side, for one ray: `BLOCK` of them make a block.
pub(super) const BLOCK: usize = 8;

/// Half-spaces n·(p − centre) ≤ offset. A block that is not full ends with n = 0, offset = ∞: never an exit, never in front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Block {
    pub x: [f32; BLOCK],
    pub y: [f32; BLOCK],
    pub z: [f32; BLOCK],
    pub offset: [f32; BLOCK],
}

impl Block {
    pub const EMPTY: Self = Self { x: [0.0; BLOCK], y: [0.0; BLOCK], z: [0.0; BLOCK], offset: [f32::INFINITY; BLOCK] };
}

/// Planes met before the first look whether the rest can be left out, and between one look and the next: a look costs as
/// much as three planes.
pub(super) const FIRST_CHECK: u32 = 48;
pub(super) const CHECK_EVERY: u32 = 16;
