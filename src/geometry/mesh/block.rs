//! Four triangles and a line: which of them it crosses, and from which side.
//!
//! Source: S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013. A shear that takes the
//! ray's direction to +z is applied to each corner alone, so triangles that share a corner see it at the same place; what
//! remains is whether the origin lies within a triangle of the plane. There, the sign of an edge function is exact: it is
//! computed in single precision, and again in double, where products of two floats are exact, if rounding could have changed
//! it. A line through an edge or a corner is moved aside by an infinitesimal (ε, ε²), the same for all triangles (H.
//! Edelsbrunner, E. P. Mücke, "Simulation of Simplicity", ACM TOG 9(1), 1990). So neighbours never disagree, a line meets one of
//! two triangles at an edge and one of a fan at a corner, and it enters a closed mesh just as often as it leaves it.

use glam::Vec3;

use crate::geometry::Side;

/// Triangles a block holds.
pub(super) const WIDTH: usize = 4;

/// Corners by axis and lane; unused lanes repeat a triangle.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Block {
    corners: [[[f32; WIDTH]; 3]; 3],
    pub triangle: [u32; WIDTH],
}

/// A ray in the frame where it goes along +z from the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    origin: [f32; 3],
    /// The axes that become x, y and z.
    axes: [usize; 3],
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
        Self { origin: origin.to_array(), axes, shear: [d[axes[0]] * scale, d[axes[1]] * scale, scale] }
    }
}

/// Four triangles' corners in the frame of a line.
type Sheared = [[[f32; WIDTH]; 3]; 3];

impl Block {
    /// Up to four triangles with their numbers.
    pub fn new(triangles: &[([Vec3; 3], u32)]) -> Self {
        let lane = |k: usize| triangles[k.min(triangles.len() - 1)];
        let corners =
            [0, 1, 2].map(|corner| [0, 1, 2].map(|axis| std::array::from_fn(|k| lane(k).0[corner].to_array()[axis])));
        Self { corners, triangle: std::array::from_fn(|k| lane(k).1) }
    }

    pub fn corners(&self, lane: usize) -> [Vec3; 3] {
        self.corners.map(|corner| Vec3::from_array(corner.map(|axis| axis[lane])))
    }

    /// Shows `each` the triangles that the whole line crosses, before and after its origin.
    #[inline]
    pub fn cross(&self, line: &Line, mut each: impl FnMut(Crossed)) {
        let sheared = self.corners.map(|corner| shear(&corner, line));
        let [a, b, c] = &sheared;
        let (mut sure_in, mut sure_out) = ([false; WIDTH], [false; WIDTH]);
        let mut edges = [[0.0f32; WIDTH]; 3];
        for k in 0..WIDTH {
            let (u, u_sure) = edge(c, b, k);
            let (v, v_sure) = edge(a, c, k);
            let (w, w_sure) = edge(b, a, k);
            let mixed = ((u < 0.0) | (v < 0.0) | (w < 0.0)) & ((u > 0.0) | (v > 0.0) | (w > 0.0));
            let sure = u_sure & v_sure & w_sure;
            sure_in[k] = sure & !mixed;
            sure_out[k] = sure & mixed;
            edges[0][k] = u;
            edges[1][k] = v;
            edges[2][k] = w;
        }
        for k in 0..WIDTH {
            if sure_out[k] {
                continue;
            }
            let front = if sure_in[k] {
                edges[0][k] > 0.0
            } else {
                match exactly(&sheared, k) {
                    Some(front) => front,
                    None => continue,
                }
            };
            let side = if front { Side::Outside } else { Side::Inside };
            each(Crossed { t: distance(&sheared, edges.map(|edge| edge[k]), k), side, lane: k });
        }
    }
}

#[inline]
fn shear(corner: &[[f32; WIDTH]; 3], line: &Line) -> [[f32; WIDTH]; 3] {
    let [ax, ay, az] = line.axes;
    let [sx, sy, sz] = line.shear;
    let mut sheared = [[0.0; WIDTH]; 3];
    for k in 0..WIDTH {
        let z = corner[az][k] - line.origin[az];
        sheared[0][k] = (corner[ax][k] - line.origin[ax]) - sx * z;
        sheared[1][k] = (corner[ay][k] - line.origin[ay]) - sy * z;
        sheared[2][k] = sz * z;
    }
    sheared
}

/// An edge function p × q, and whether its sign is beyond doubt.
///
/// Each product and the difference are off by at most ε/2 of themselves; if they cancel, both products are alike.
#[inline]
fn edge(p: &[[f32; WIDTH]; 3], q: &[[f32; WIDTH]; 3], k: usize) -> (f32, bool) {
    const TINY: f32 = 1e-36;
    let product = p[0][k] * q[1][k];
    let value = product - p[1][k] * q[0][k];
    (value, value.abs() > 2.0 * f32::EPSILON * product.abs() + TINY)
}

/// The exact answer for one triangle: `Some(true)` if the line comes to its front, `None` if it passes by.
#[cold]
fn exactly(sheared: &Sheared, k: usize) -> Option<bool> {
    let [a, b, c] = sheared.map(|corner| [corner[0][k], corner[1][k]].map(f64::from));
    let [u, v, w] = [sign(c, b)?, sign(a, c)?, sign(b, a)?];
    (u == v && v == w).then_some(u)
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
fn distance(sheared: &Sheared, edges: [f32; 3], k: usize) -> f32 {
    let z = sheared.map(|corner| corner[2][k]);
    let [u, v, w] = edges.map(f32::abs);
    let t = (u * z[0] + v * z[1] + w * z[2]) / (u + v + w);
    let (near, far) = (z[0].min(z[1]).min(z[2]), z[0].max(z[1]).max(z[2]));
    // Seen exactly edge-on the weights are all zero: t is NaN, and any distance on it is as good.
    if t >= near { t.min(far) } else { near }
}
