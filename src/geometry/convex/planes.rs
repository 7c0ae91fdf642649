//! Planes side by side, as vector instructions take them.

/// The least room in front of a plane. An origin on the plane or, by rounding, beyond it is this far from it: as good as
/// nothing beside the smallest solid there is (1e-15), and among several such planes the one that the ray heads for most wins.
pub(super) const TOUCHING: f32 = 1e-30;

/// The half-space n·(p − centre) ≤ offset, by its numbers.
#[derive(Clone, Copy)]
pub(super) struct Flat {
    pub x: f32,
    pub y: f32,
    pub z: f32,
    pub offset: f32,
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

    #[inline(always)]
    pub fn plane(&self, k: usize) -> Flat {
        Flat { x: self.x[k], y: self.y[k], z: self.z[k], offset: self.offset[k] }
    }
}

/// Planes met before the first look whether the rest can be left out, and between one look and the next: a look costs as
/// much as three planes.
pub(super) const FIRST_CHECK: u32 = 48;
pub(super) const CHECK_EVERY: u32 = 16;
