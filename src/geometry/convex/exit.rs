//! The way out of a convex solid: of one ray, and of several at once.
//!
//! From inside only planes that the ray moves towards (n·d > 0) can be its exit, and the nearest of them is. The normals of
//! a closed solid surround it, so there is always one; an origin that rounding has put beyond a plane counts as on it, so the
//! ray leaves where it is. Nothing can leak, at edges and vertices or anywhere else, and no epsilon is needed: after a
//! reflection the ray moves away from its facet, n·d ≤ 0, which drops out by itself.

use super::Convex;
use super::bundle::Bundle;
use super::planes::{BLOCK, CHECK_EVERY, FIRST_CHECK, Flat, TOUCHING};
use crate::math::Vectors;
use glam::Vec3;

/// Where rays leave a solid: distances ≥ 0, and facets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exits<const N: usize> {
    pub t: [f32; N],
    pub facet: [u32; N],
}

/// Fewer rays than this are met one by one.
const FEW: usize = 4;

/// The exits of rays among the planes met so far.
#[derive(Clone, Copy)]
struct Nearest<const N: usize> {
    /// rate / room.
    nearness: [f32; N],
    /// A whole number in the bits of an f32, which vectors choose like the rest; integers were chosen lane by lane, at more than twice
    /// the instructions. (Normals chosen beside it took 1.5 times the time: more than the registers hold.)
    plane: [f32; N],
}

impl<const N: usize> Nearest<N> {
    #[inline(always)]
    fn meet(&mut self, number: u32, Flat { x, y, z, offset }: Flat, o: &Vectors<N>, d: &Vectors<N>) {
        let mut near = [0.0f32; N];
        for (lane, near) in near.iter_mut().enumerate() {
            let rate = x * d.x[lane] + y * d.y[lane] + z * d.z[lane];
            let room = offset - (x * o.x[lane] + y * o.y[lane] + z * o.z[lane]);
            *near = rate / if room > TOUCHING { room } else { TOUCHING };
        }
        let number = f32::from_bits(number);
        for (plane, (near, nearest)) in self.plane.iter_mut().zip(near.iter().zip(&self.nearness)) {
            *plane = if near > nearest { number } else { *plane };
        }
        for (nearest, near) in self.nearness.iter_mut().zip(near) {
            *nearest = if near > *nearest { near } else { *nearest };
        }
    }
}

impl Convex {
    /// Where rays that are inside the solid leave it; origins in world space, directions of unit length.
    ///
    /// Lanes do not influence each other, and each gets exactly what it would get alone. A lane whose numbers are not
    /// finite gets t = 0 and facet 0. Among facets at the same distance the first wins. Four rays and multiples of four
    /// are fastest.
    ///
    /// Rays beside each other meet only the planes that can be an exit of theirs ([`bundle`](super::bundle)): seven of eight times in a
    /// brilliant, with about two planes left over. Others meet the planes in the order of their distance from the centre. Once every
    /// ray has an exit nearer to the centre than all planes to come, none of these can cut it short: most never meet those of the girdle.
    ///
    /// The exit is the plane with the largest rate / room, which needs neither a test of the sign nor a division by zero
    /// to be minded. Measured on the loop over all planes: the least room / rate with a test that rate > 0 took 1.4 times as long, and
    /// cross-multiplied fractions without division 2.2 times (two values to carry instead of one). Planes stored eight times over take
    /// 0.88 times as long there, but the few that are left over of a bundle hide it: a sample of a diamond takes no more
    /// instructions without them, and a copy of a stone 128 bytes a plane less.
    pub fn exit_lanes<const N: usize>(&self, origins: &Vectors<N>, directions: &Vectors<N>) -> Exits<N> {
        let (d, mut o) = (directions, *origins);
        for lane in 0..N {
            o.x[lane] -= self.center.x;
            o.y[lane] -= self.center.y;
            o.z[lane] -= self.center.z;
        }
        let mut nearest = Nearest { nearness: [0.0; N], plane: [0.0; N] };
        match Bundle::new(&o, d, self.radius) {
            _ if N < FEW => {}
            Some(bundle) => self.possible_exits(&bundle, |number| {
                if let Some(plane) = self.plane(number) {
                    nearest.meet(number, plane, &o, d);
                }
            }),
            None => self.all_exits(&mut nearest, &o, d),
        }
        let Nearest { nearness, plane } = nearest;
        let mut t = nearness.map(distance);
        let mut facet = plane.map(|plane| self.facet_of(plane.to_bits()));
        for lane in N / FEW * FEW..N {
            (t[lane], facet[lane]) = self.exit_one(origins.get(lane), directions.get(lane));
        }
        Exits { t, facet }
    }

    /// Meets planes until no more can be exits.
    #[inline]
    fn all_exits<const N: usize>(&self, nearest: &mut Nearest<N>, o: &Vectors<N>, d: &Vectors<N>) {
        for (block, planes) in (0u32..).step_by(BLOCK).zip(&self.blocks) {
            let look = block >= FIRST_CHECK && block.is_multiple_of(CHECK_EVERY);
            if look && within(o, d, &nearest.nearness, planes.offset[0]) {
                break;
            }
            for k in 0..BLOCK {
                nearest.meet(block + k as u32, planes.plane(k), o, d);
            }
        }
    }

    #[inline]
    fn plane(&self, number: u32) -> Option<Flat> {
        let number = number as usize;
        self.blocks.get(number / BLOCK).map(|block| block.plane(number % BLOCK))
    }

    /// One ray, several planes at once; bit for bit what [`Convex::exit_lanes`] gives.
    pub(super) fn exit_one(&self, origin: Vec3, direction: Vec3) -> (f32, u32) {
        let (d, o) = (direction, origin - self.center);
        let mut nearness = [0.0f32; BLOCK];
        let mut blocks = [0.0f32; BLOCK];
        for (number, block) in (0u32..).zip(&self.blocks) {
            let planes = number * BLOCK as u32;
            if planes >= FIRST_CHECK && planes.is_multiple_of(CHECK_EVERY) {
                let nearest = nearness.iter().fold(0.0, |most: f32, &near| if near > most { near } else { most });
                if within(&Vectors::<1>::splat(o), &Vectors::splat(d), &[nearest], block.offset[0]) {
                    break;
                }
            }
            for k in 0..BLOCK {
                let rate = block.x[k] * d.x + block.y[k] * d.y + block.z[k] * d.z;
                let room = block.offset[k] - (block.x[k] * o.x + block.y[k] * o.y + block.z[k] * o.z);
                let near = rate / if room > TOUCHING { room } else { TOUCHING };
                blocks[k] = if near > nearness[k] { f32::from_bits(number) } else { blocks[k] };
                nearness[k] = if near > nearness[k] { near } else { nearness[k] };
            }
        }
        let mut best = (0.0, 0u32);
        for k in 0..BLOCK {
            let facet = blocks[k].to_bits() * BLOCK as u32 + k as u32;
            if nearness[k] > best.0 || (nearness[k] == best.0 && best.0 > 0.0 && facet < best.1) {
                best = (nearness[k], facet);
            }
        }
        (distance(best.0), self.facet_of(best.1))
    }

    /// The facet of a plane in the order of `blocks`.
    #[inline]
    fn facet_of(&self, plane: u32) -> u32 {
        self.order.get(plane as usize).copied().unwrap_or(0)
    }
}

/// Whether all rays have an exit nearer to the centre than `offset`, by more than rounding: origins are from the centre.
#[inline]
fn within<const N: usize>(o: &Vectors<N>, d: &Vectors<N>, nearness: &[f32; N], offset: f32) -> bool {
    let limit = offset * offset * (1.0 - 1e-5);
    nearness.iter().enumerate().fold(true, |all, (lane, near)| {
        let t = 1.0 / near;
        let (x, y, z) = (o.x[lane] + d.x[lane] * t, o.y[lane] + d.y[lane] * t, o.z[lane] + d.z[lane] * t);
        // Infinite or no number at all where there is no exit yet.
        all & (x * x + y * y + z * z < limit)
    })
}

/// From the largest rate / room back to a distance.
#[inline]
fn distance(nearness: f32) -> f32 {
    if nearness > 0.0 { 1.0 / nearness } else { 0.0 }
}
