//! Four triangles and a line: which of them it crosses, and from which side.
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
//! Vectors of four by name: of loops over lanes the compiler made a mixture of vectors and single numbers. With boxes and triangles
//! both so, rays took 1.3 to 1.4 times as long.

use glam::{BVec4A, Vec3, Vec4};

use crate::geometry::{Bounds, Side};

/// Triangles a block holds.
pub(super) const WIDTH: usize = 4;

/// Corners by axis and lane; unused lanes repeat a triangle.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(32))]
pub(super) struct Block {
    corners: [[Vec4; 3]; 3],
    pub triangle: [u32; WIDTH],
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
    /// Four triangles with their numbers; fewer are repeated.
    pub fn new(triangles: [([Vec3; 3], u32); WIDTH]) -> Self {
        let corners = [0, 1, 2]
            .map(|corner| [0, 1, 2].map(|axis| Vec4::from_array(triangles.map(|(corners, _)| corners[corner][axis]))));
        Self { corners, triangle: triangles.map(|(_, number)| number) }
    }

    pub fn bounds(&self) -> Bounds {
        Bounds::of((0..WIDTH).flat_map(|lane| self.corners(lane)))
    }

    #[inline]
    pub fn corners(&self, lane: usize) -> [Vec3; 3] {
        self.corners.map(|corner| Vec3::from_array(corner.map(|axis| axis[lane])))
    }

    /// Shows `each` the triangles that the whole line crosses, before and after its origin.
    #[inline]
    pub fn cross(&self, line: &Line, mut each: impl FnMut(Crossed)) {
        let [a, b, c] = &self.corners;
        let (a, b, c) = (shear(a, line), shear(b, line), shear(c, line));
        let (u, v, w) = (edge(&c, &b), edge(&a, &c), edge(&b, &a));
        let (some_negative, some_positive) = (
            u.value.cmplt(Vec4::ZERO) | v.value.cmplt(Vec4::ZERO) | w.value.cmplt(Vec4::ZERO),
            u.value.cmpgt(Vec4::ZERO) | v.value.cmpgt(Vec4::ZERO) | w.value.cmpgt(Vec4::ZERO),
        );
        let sure = u.sure & v.sure & w.sure;
        let mut maybe = !(sure & some_negative & some_positive).bitmask() & 0b1111;
        if maybe == 0 {
            return;
        }
        let (sure, front) = (sure.bitmask(), u.value.cmpgt(Vec4::ZERO).bitmask());
        let t = distance([a[2], b[2], c[2]], [u.value, v.value, w.value]).to_array();
        while maybe != 0 {
            let lane = maybe.trailing_zeros() as usize & (WIDTH - 1);
            maybe &= maybe - 1;
            let front = if sure >> lane & 1 == 1 {
                front >> lane & 1 == 1
            } else {
                match self.exactly(line, lane) {
                    Some(front) => front,
                    None => continue,
                }
            };
            let side = if front { Side::Outside } else { Side::Inside };
            each(Crossed { t: t[lane], side, lane });
        }
    }

    /// The exact answer for one triangle: `Some(true)` if the line comes to its front, `None` if it passes by.
    #[cold]
    #[inline(never)]
    fn exactly(&self, line: &Line, lane: usize) -> Option<bool> {
        let seen = |corner: &[Vec4; 3]| {
            let [x, y, _] = shear(corner, line);
            [x[lane], y[lane]].map(f64::from)
        };
        let [a, b, c] = self.corners.each_ref().map(seen);
        let [u, v, w] = [sign(c, b)?, sign(a, c)?, sign(b, a)?];
        (u == v && v == w).then_some(u)
    }
}

/// Four corners in the frame of a line.
#[inline(always)]
fn shear(corner: &[Vec4; 3], line: &Line) -> [Vec4; 3] {
    let [x, y, z] = line.axes.map(|axis| corner[axis]);
    let ([ox, oy, oz], [sx, sy, sz]) = (line.origin.map(Vec4::splat), line.shear.map(Vec4::splat));
    let height = z - oz;
    [(x - ox) - sx * height, (y - oy) - sy * height, sz * height]
}

/// Four edge functions.
struct Edge {
    value: Vec4,
    /// Whether its sign is beyond doubt.
    sure: BVec4A,
}

/// The edge functions p × q.
///
/// Each product and the difference are off by at most ε/2 of themselves; if they cancel, both products are alike.
#[inline(always)]
fn edge(p: &[Vec4; 3], q: &[Vec4; 3]) -> Edge {
    const TINY: f32 = 1e-36;
    let product = p[0] * q[1];
    let value = product - p[1] * q[0];
    Edge { value, sure: value.abs().cmpgt(2.0 * f32::EPSILON * product.abs() + TINY) }
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
fn distance(z: [Vec4; 3], edges: [Vec4; 3]) -> Vec4 {
    let [u, v, w] = edges.map(Vec4::abs);
    let t = (u * z[0] + v * z[1] + w * z[2]) / (u + v + w);
    let (near, far) = (z[0].min(z[1]).min(z[2]), z[0].max(z[1]).max(z[2]));
    // Seen exactly edge-on the weights are all zero: t is NaN, and any distance on it is as good.
    Vec4::select(t.cmpge(near), t.min(far), near)
}
