//! A few triangles and a line: which of them it crosses, and from which side.
//!
//! Source: S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013. A shear that takes the
//! ray's direction to +z is applied to each corner alone, so triangles that share a corner see it at the same place; what
//! remains is whether the origin lies within a triangle of the plane. There, the sign of an edge function is exact: it is
//! computed in single precision, and again in double, where products of two floats are exact, if rounding could have changed
//! it. A line through an edge or a corner is moved aside by an infinitesimal (ε, ε²), the same for all triangles (H.
//! Edelsbrunner, E. P. Mücke, "Simulation of Simplicity", ACM TOG 9(1), 1990). So neighbours never disagree, a line meets one of
//! two triangles at an edge and one of a fan at a corner, and it enters a closed mesh just as often as it leaves it.
//!
//! Not Plücker's test, d · (a × b) with corners seen from the origin, though neighbours can share an edge's too: its sign is that of a sum of
//! products of three factors, which do not fit into double precision, so where it is in doubt it stays so. Here products have two.
//!
//! The barycentric weights, which are at hand here, were tried for the point of the surface in place of putting it onto the plane anew: it
//! cost no less, as what is handed on grows by them.
//!
//! A random ray waits for memory most of the time. So triangles share corners: up to six that have up to eight between them fill two lines
//! of a cache, where four with three corners each took three. On a ball of 1.03 M triangles 4.3 are in a block; of triangles that share no
//! corner at most two. Each corner is sheared once, and by three bits for each corner a triangle has, `vpermps` brings it where it is wanted.
//! Random rays take 0.85 of the time, the others 0.96 to 0.99.

use glam::Vec3;

use super::eight::{self, Choice, Eight};
use crate::geometry::{Bounds, Side};

/// Triangles a block holds at most.
pub(super) const WIDTH: usize = 6;

/// Corners that they have at most.
const CORNERS: usize = eight::WIDTH;

/// Bits that tell one of them.
const BITS: u32 = CORNERS.ilog2();

/// Triangles, each three of a few corners that they share; unused lanes repeat a triangle. Two lines of a cache.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(128))]
pub(super) struct Block {
    /// By axis.
    corners: [[f32; CORNERS]; 3],
    /// Which of them are the triangles', as [`Choice::new`] wants it.
    choice: u64,
    pub triangle: [u32; WIDTH],
}

/// Corners that triangles share, told apart by where they are.
#[derive(Default)]
struct Shared {
    corners: [Vec3; CORNERS],
    count: usize,
}

impl Shared {
    /// The number of a corner; none if there is no room for it.
    fn number(&mut self, corner: Vec3) -> Option<usize> {
        let known = self.corners[..self.count].iter().position(|&other| other == corner);
        known.or_else(|| {
            *self.corners.get_mut(self.count)? = corner;
            self.count += 1;
            Some(self.count - 1)
        })
    }
}

/// A ray in the frame where it goes along +z from the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    /// The axes that become x, y and z.
    axes: [usize; 3],
    /// Its coordinates along these.
    origin: [f32; 3],
    shear: [f32; 3],
}

/// A triangle that a line crosses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossed {
    pub t: f32,
    /// The side that the line comes from.
    pub side: Side,
    pub lane: usize,
}

impl Line {
    #[inline]
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        let d = direction.to_array();
        let z = if d[0].abs() >= d[1].abs() && d[0].abs() >= d[2].abs() {
            0
        } else if d[1].abs() >= d[2].abs() {
            1
        } else {
            2
        };
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        // Swapped where z is turned round, so that what is counter-clockwise stays so.
        let axes = if d[z] < 0.0 { [y, x, z] } else { [x, y, z] };
        let scale = 1.0 / d[z];
        let origin = axes.map(|axis| origin[axis]);
        Self { axes, origin, shear: [d[axes[0]] * scale, d[axes[1]] * scale, scale] }
    }
}

impl Block {
    /// Whether a block has room for triangles.
    pub fn fit(triangles: impl ExactSizeIterator<Item = [Vec3; 3]>) -> bool {
        let mut shared = Shared::default();
        triangles.len() <= WIDTH && triangles.flatten().all(|corner| shared.number(corner).is_some())
    }

    /// Triangles that [`Block::fit`], with their numbers.
    pub fn new(triangles: impl ExactSizeIterator<Item = ([Vec3; 3], u32)> + Clone) -> Self {
        debug_assert!(Self::fit(triangles.clone().map(|(corners, _)| corners)), "too many corners");
        let (mut shared, mut choice, mut triangle) = (Shared::default(), 0, [0; WIDTH]);
        for (lane, (corners, number)) in (0..WIDTH).zip(triangles.cycle()) {
            triangle[lane] = number;
            for (k, corner) in corners.into_iter().enumerate() {
                choice |= (shared.number(corner).unwrap_or(0) as u64) << place(lane, k);
            }
        }
        // Where there is no corner, zeros.
        let corners = [0, 1, 2].map(|axis| shared.corners.map(|corner| corner[axis]));
        Self { corners, choice, triangle }
    }

    pub fn bounds(&self) -> Bounds {
        Bounds::of((0..WIDTH).flat_map(|lane| self.corners(lane)))
    }

    /// Which of the corners is `k` of a triangle.
    #[inline]
    fn number(&self, lane: usize, k: usize) -> usize {
        (self.choice >> place(lane, k)) as usize & (CORNERS - 1)
    }

    #[inline]
    pub fn corners(&self, lane: usize) -> [Vec3; 3] {
        [0, 1, 2].map(|k| {
            let (number, [x, y, z]) = (self.number(lane, k), &self.corners);
            Vec3::new(x[number], y[number], z[number])
        })
    }

    /// Shows `each` the triangles that the whole line crosses, before and after its origin.
    #[inline]
    pub fn cross(&self, line: &Line, mut each: impl FnMut(Crossed)) {
        let seen = shear(&self.corners, line);
        let choice = Choice::new(self.choice);
        let picked = |choice: Choice| seen.map(|axis| axis.pick(choice));
        let (a, b, c) = (picked(choice), picked(choice.next()), picked(choice.next().next()));
        let (u, v, w) = (edge(&c, &b), edge(&a, &c), edge(&b, &a));
        let zero = Eight::splat(0.0);
        let some_negative = zero.above(u.value.min(v.value).min(w.value));
        let some_positive = u.value.max(v.value).max(w.value).above(zero);
        let sure = u.sure & v.sure & w.sure;
        let mut maybe = !(sure & some_negative & some_positive) & ((1 << WIDTH) - 1);
        if maybe == 0 {
            return;
        }
        let t = distance([a[2], b[2], c[2]], [u.value, v.value, w.value]);
        while maybe != 0 {
            let lane = maybe.trailing_zeros() as usize;
            maybe &= maybe - 1;
            let front = if sure >> lane & 1 == 1 {
                some_positive >> lane & 1 == 1
            } else {
                match self.exactly(line, lane) {
                    Some(front) => front,
                    None => continue,
                }
            };
            let side = if front { Side::Outside } else { Side::Inside };
            each(Crossed { t: t.lane(lane), side, lane });
        }
    }

    /// The exact answer for one triangle: `Some(true)` if the line comes to its front, `None` if it passes by.
    #[cold]
    #[inline(never)]
    fn exactly(&self, line: &Line, lane: usize) -> Option<bool> {
        let [x, y, _] = shear(&self.corners, line);
        let seen = |k| [x, y].map(|axis| f64::from(axis.lane(self.number(lane, k))));
        let [a, b, c] = [0, 1, 2].map(seen);
        let [u, v, w] = [sign(c, b)?, sign(a, c)?, sign(b, a)?];
        (u == v && v == w).then_some(u)
    }
}

/// Where among the bits of a block's choice is that of a triangle's corner `k`.
#[inline]
fn place(lane: usize, k: usize) -> u32 {
    32 * (lane as u32 & 1) + 3 * BITS * (lane as u32 >> 1) + BITS * k as u32
}

/// Corners in the frame of a line.
#[inline(always)]
fn shear(corners: &[[f32; CORNERS]; 3], line: &Line) -> [Eight; 3] {
    let [x, y, z] = line.axes.map(|axis| Eight::new(&corners[axis]));
    let ([ox, oy, oz], [sx, sy, sz]) = (line.origin.map(Eight::splat), line.shear.map(Eight::splat));
    let height = z - oz;
    [(x - ox) - sx * height, (y - oy) - sy * height, sz * height]
}

/// An edge function of each triangle.
struct Edge {
    value: Eight,
    /// A bit for each whose sign is beyond doubt.
    sure: u32,
}

/// The edge functions p × q.
///
/// Each product and the difference are off by at most ε/2 of themselves; if they cancel, both products are alike.
#[inline(always)]
fn edge(p: &[Eight; 3], q: &[Eight; 3]) -> Edge {
    const TINY: f32 = 1e-36;
    let product = p[0] * q[1];
    let value = product - p[1] * q[0];
    let doubt = Eight::splat(2.0 * f32::EPSILON) * product.abs() + Eight::splat(TINY);
    Edge { value, sure: value.abs().above(doubt) }
}

/// Whether p × q > 0, seen from (ε, ε²); `None` for an edge that is a point.
fn sign(p: [f64; 2], q: [f64; 2]) -> Option<bool> {
    // Exact: each product of two floats fits, and the difference is rounded without changing its sign.
    let value = p[0] * q[1] - p[1] * q[0];
    // (p − e) × (q − e) = p × q − e × (q − p), with e = (ε, ε²).
    let [first, second] = [-(q[1] - p[1]), q[0] - p[0]];
    [value, first, second].into_iter().find(|x| *x != 0.0).map(|x| x > 0.0)
}

/// Where along the ray, from weights that all have one sign; between the corners' distances, whatever rounding does.
#[inline(always)]
fn distance(z: [Eight; 3], edges: [Eight; 3]) -> Eight {
    let [u, v, w] = edges.map(Eight::abs);
    let t = (u * z[0] + v * z[1] + w * z[2]) / (u + v + w);
    let (near, far) = (z[0].min(z[1]).min(z[2]), z[0].max(z[1]).max(z[2]));
    // Seen exactly edge-on the weights are all zero: t is NaN, and any distance on it is as good.
    t.max(near).min(far)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles of a strip, each sharing an edge with the one before.
    fn strip(count: usize) -> Vec<[Vec3; 3]> {
        let corner = |k: usize| Vec3::new((k / 2) as f32, (k % 2) as f32, 0.1 * k as f32);
        (0..count).map(|k| [corner(k), corner(k + 1), corner(k + 2)]).collect()
    }

    #[test]
    fn six_triangles_fit_if_they_have_eight_corners() {
        assert!(Block::fit(strip(6).into_iter()));
        assert!(!Block::fit(strip(7).into_iter()));
        let apart = [0.0, 10.0, 20.0].map(|x| strip(1)[0].map(|corner| corner + x));
        assert!(Block::fit(apart[..2].iter().copied()));
        assert!(!Block::fit(apart.into_iter()));
    }

    #[test]
    fn a_block_gives_back_its_triangles_and_repeats_them() {
        for count in 1..=WIDTH {
            let triangles: Vec<_> = strip(count).into_iter().zip(70..).collect();
            let block = Block::new(triangles.iter().copied());
            for lane in 0..WIDTH {
                let (corners, number) = triangles[lane % count];
                assert_eq!(
                    (block.corners(lane), block.triangle[lane]),
                    (corners, number),
                    "{count} triangles, lane {lane}"
                );
            }
        }
    }
}
