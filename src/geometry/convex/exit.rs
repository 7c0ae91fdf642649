//! The way out of a convex solid: of one ray, and of several at once.
//!
//! From inside only planes that the ray moves towards (n·d > 0) can be its exit, and the nearest of them is. The normals of
//! a closed solid surround it, so there is always one; a distance that rounding has made negative counts as zero, so the ray
//! leaves where it is. Nothing can leak, at edges and vertices or anywhere else, and no epsilon is needed: after a
//! reflection the ray moves away from its facet, n·d ≤ 0, which drops out by itself.

use super::Convex;
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

/// Where rays leave a solid: distances ≥ 0, and facets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exits<const N: usize> {
    pub t: [f32; N],
    pub facet: [u32; N],
}

/// Planes side by side: `BLOCK` of them make a block.
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

impl Convex {
    /// Where rays that are inside the solid leave it; origins in world space, directions of unit length.
    ///
    /// Lanes do not influence each other, and each gets exactly what it would get alone. A lane whose numbers are not
    /// finite gets t = 0 and facet 0. Among facets at the same distance the first wins.
    pub fn exit_lanes<const N: usize>(&self, origins: &Points<N>, directions: &Points<N>) -> Exits<N> {
        let mut o = *origins;
        for lane in 0..N {
            o.x[lane] -= self.center.x;
            o.y[lane] -= self.center.y;
            o.z[lane] -= self.center.z;
        }
        let d = directions;
        let mut t = [f32::INFINITY; N];
        let mut facet = [0u32; N];
        let mut number = 0u32;
        for block in &self.blocks {
            for k in 0..BLOCK {
                let (nx, ny, nz, offset) = (block.x[k], block.y[k], block.z[k], block.offset[k]);
                for lane in 0..N {
                    let rate = nx * d.x[lane] + ny * d.y[lane] + nz * d.z[lane];
                    let room = offset - (nx * o.x[lane] + ny * o.y[lane] + nz * o.z[lane]);
                    let distance = room / rate;
                    let nearer = (rate > 0.0) & (distance < t[lane]);
                    t[lane] = if nearer { distance } else { t[lane] };
                    facet[lane] = if nearer { number } else { facet[lane] };
                }
                number += 1;
            }
        }
        for distance in &mut t {
            *distance = if *distance > 0.0 && *distance < f32::INFINITY { *distance } else { 0.0 };
        }
        Exits { t, facet }
    }

    /// One ray, several planes at once.
    pub(super) fn exit_one(&self, origin: Vec3, direction: Vec3) -> (f32, u32) {
        let o = origin - self.center;
        let mut t = [f32::INFINITY; BLOCK];
        let mut blocks = [0u32; BLOCK];
        for (number, block) in self.blocks.iter().enumerate() {
            for k in 0..BLOCK {
                let rate = block.x[k] * direction.x + block.y[k] * direction.y + block.z[k] * direction.z;
                let room = block.offset[k] - (block.x[k] * o.x + block.y[k] * o.y + block.z[k] * o.z);
                let distance = room / rate;
                let nearer = (rate > 0.0) & (distance < t[k]);
                t[k] = if nearer { distance } else { t[k] };
                blocks[k] = if nearer { number as u32 } else { blocks[k] };
            }
        }
        let mut best = (f32::INFINITY, 0u32);
        for k in 0..BLOCK {
            let facet = blocks[k] * BLOCK as u32 + k as u32;
            if t[k] < best.0 || (t[k] == best.0 && t[k] < f32::INFINITY && facet < best.1) {
                best = (t[k], facet);
            }
        }
        if best.0 > 0.0 && best.0 < f32::INFINITY { best } else { (0.0, best.1) }
    }
}
