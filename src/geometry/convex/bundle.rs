//! Rays that run beside each other, and which planes can be the exit of any of them.
//!
//! The wavelengths of a path in a gem start in one point and drift apart slowly: one or two of its facets come into question for
//! all of them. One ray is met with eight planes at once; how far the others may stand beside it bounds what they meet:
//!
//! ```text
//! rate ∈ [n·d − δ, n·d + δ]     room ∈ [offset − n·o − ε, offset − n·o + ε]     |dᵢ − d| ≤ δ, |oᵢ − o| ≤ ε
//! ```
//!
//! Every ray's exit has at least the largest of all planes' least rate / room; a plane whose largest rate / room is below that
//! is nobody's exit. δ and ε hold what rounding may add to both, so that the planes left over give every ray its exit to the bit.

use super::Convex;
use super::planes::{BLOCK, Block, CHECK_EVERY, FIRST_CHECK, TOUCHING};
use crate::math::Vectors;
use glam::Vec3;

/// Vectors farther apart than this are met by all planes: too many would be left over.
const APART: f32 = 0.25;

/// One of several rays, and how far the others may be from it.
pub(super) struct Bundle {
    origin: Vec3,
    direction: Vec3,
    /// Of origins.
    beside: f32,
    /// Of directions.
    apart: f32,
}

impl Bundle {
    /// Rays by origins from the centre of a solid; none if they are far apart, infinite or no numbers.
    #[inline]
    pub fn new<const N: usize>(o: &Vectors<N>, d: &Vectors<N>, radius: f32) -> Option<Self> {
        let (origin, direction) = (o.get(N / 2), d.get(N / 2));
        let apart = farthest(d, direction);
        let near = apart < APART;
        if !near {
            return None;
        }
        let beside = farthest(o, origin);
        let size = radius + origin.length() + beside;
        // Sums of three products are right to 4 · 2⁻²⁴ of their terms, which add up to less than twice their lengths.
        let bundle = Self { origin, direction, beside: beside * 1.00001 + size * 2e-6, apart: apart * 1.00001 + 2e-6 };
        bundle.beside.is_finite().then_some(bundle)
    }

    /// The least and the largest nearness that the planes of a block can have for a ray. Where a plane turns away from all rays the
    /// largest is below zero.
    #[inline(always)]
    fn nearness(&self, block: &Block) -> [Nearness; 2] {
        let (o, d) = (self.origin, self.direction);
        let (mut least, mut most) = ([0.0f32; BLOCK], [0.0f32; BLOCK]);
        for k in 0..BLOCK {
            let rate = block.x[k] * d.x + block.y[k] * d.y + block.z[k] * d.z;
            let room = block.offset[k] - (block.x[k] * o.x + block.y[k] * o.y + block.z[k] * o.z);
            let (far, near) = (room + self.beside, room - self.beside);
            least[k] = (rate - self.apart) / if far > TOUCHING { far } else { TOUCHING };
            most[k] = (rate + self.apart) / if near > TOUCHING { near } else { TOUCHING };
        }
        [least, most]
    }
}

/// The largest distance of points from one; infinite if one is no number.
#[inline]
fn farthest<const N: usize>(points: &Vectors<N>, from: Vec3) -> f32 {
    let mut squared = [0.0f32; N];
    for (lane, squared) in squared.iter_mut().enumerate() {
        let (x, y, z) = (points.x[lane] - from.x, points.y[lane] - from.y, points.z[lane] - from.z);
        let sum = x * x + y * y + z * z;
        *squared = if sum < f32::INFINITY { sum } else { f32::INFINITY };
    }
    largest_of(squared).sqrt()
}

/// By halves: a fold from the first to the last is one chain of single numbers.
#[inline]
fn largest_of<const N: usize>(mut numbers: [f32; N]) -> f32 {
    let mut left = N;
    while left > 1 {
        let half = left.div_ceil(2);
        for k in 0..left - half {
            let (one, other) = (numbers[k], numbers[k + half]);
            numbers[k] = if one > other { one } else { other };
        }
        left = half;
    }
    numbers.first().copied().unwrap_or(0.0)
}

/// Blocks whose nearness is kept from the first look at them to the second, 128 planes: cuts have fewer.
const KEPT: usize = 16;

/// How near planes can be: rate / room.
type Nearness = [f32; BLOCK];

impl Convex {
    /// Calls `meet` with the planes that can be exits, in their order.
    #[inline]
    pub(super) fn possible_exits(&self, bundle: &Bundle, mut meet: impl FnMut(u32)) {
        let mut kept = [[0.0f32; BLOCK]; KEPT];
        let (least, blocks) = self.least_nearness(bundle, &mut kept);
        for (number, block) in self.blocks[..blocks].iter().enumerate() {
            let most = kept.get(number).copied().unwrap_or_else(|| bundle.nearness(block)[1]);
            if most.iter().fold(false, |any, &most| any | (most >= least)) {
                (0..BLOCK).filter(|&k| most[k] >= least).for_each(|k| meet((number * BLOCK + k) as u32));
            }
        }
    }

    /// A nearness that each ray's exit has at least, and how many blocks of planes come into question.
    #[inline]
    fn least_nearness(&self, bundle: &Bundle, kept: &mut [Nearness; KEPT]) -> (f32, usize) {
        let mut largest_least = [0.0f32; BLOCK];
        for (number, block) in self.blocks.iter().enumerate() {
            let planes = (number * BLOCK) as u32;
            if planes >= FIRST_CHECK && planes.is_multiple_of(CHECK_EVERY) {
                let least = largest(&largest_least);
                if bundle.is_within(1.0 / least, block.offset[0]) {
                    return (least, number);
                }
            }
            let [least, most] = bundle.nearness(block);
            for (largest, least) in largest_least.iter_mut().zip(least) {
                *largest = if least > *largest { least } else { *largest };
            }
            if let Some(kept) = kept.get_mut(number) {
                *kept = most;
            }
        }
        (largest(&largest_least), self.blocks.len())
    }
}

impl Bundle {
    /// Whether no plane as far from the centre as `offset` can cut rays short that end at `t`.
    #[inline]
    fn is_within(&self, t: f32, offset: f32) -> bool {
        let end = (self.origin + self.direction * t).length() + self.beside + self.apart * t;
        end < offset * (1.0 - 1e-5)
    }
}

/// Less by what rounding may have added.
#[inline]
fn largest(numbers: &[f32; BLOCK]) -> f32 {
    largest_of(*numbers) * (1.0 - 1e-6)
}
