//! Exact Fresnel reflectance of a conductor in f32, unpolarised: the kernel of rendering.
//!
//! ```text
//! d = N² − n1²    w² = d + n1²c²    w = a + i b    q = |w|²    S = n1²s²    C = n1 c
//! u = C²q + S²    v = 2 C S a       X = |C + w|² = C² + q + 2 C a
//! R_s = |d|²/X²   R_p = R_s (u − v)/(u + v)   R = R_s u/(u + v)   1 − R = (u T_s + v)/(u + v)   T_s = 1 − R_s = 4 C a/X
//! ```
//!
//! - Source: Born & Wolf, *Principles of Optics* (7th ed., 1999), 14.2; r_p/r_s = −(C w − S)/(C w + S) follows from Snell's law.
//! - The mean of both polarisations needs no difference at all, so R ≥ 0 even at index matching and 1 − R keeps its digits
//!   for n ≪ k. Forming n2/n1 first would cost 7e-6 in R; the usual form in cos 2θ returns R < 0 in 4 % of index-matched cases.
//! - Valid for n1 > 0, n2 ≥ 0, k2 ≥ 0, |N| up to 1e4, 0 ≤ c ≤ 1; k2 = 0 is allowed (a dielectric, total reflection included).
//!   Identical media give R = 0 at every angle.
//! - Error against `exact` at the same f32 inputs (`tests/it/fresnel/kernels.rs`, n 0.02–30, k 0.05–60, n1 1–2.4): R to 7.4e-7 absolute,
//!   1 − R to 6.6e-7 relative. Beside the critical angle of a nearly lossless medium the f32 input itself is ill-conditioned (5e-4).
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids): 8 ns for one lane, 14 ns for eight; with 1 − R 10 and 18 ns.
//!   A second division instead of scaling by g costs 8 % more. One form of Re w² instead of two saves 2 ns and costs 30 × in 1 − R
//!   of epsilon-near-zero metals. Not inlining the kernel costs 4 ns.

use super::{Dielectric, Model, dielectric};
use crate::math::Lanes;
use std::f32::consts::FRAC_1_SQRT_2;

/// The indices of one hit: n1 outside, N = n2 + i k2 inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor<const N: usize> {
    pub n1: Lanes<N>,
    pub n2: Lanes<N>,
    pub k2: Lanes<N>,
}

impl<const N: usize> Model<N> for Conductor<N> {
    #[inline]
    fn new(n1: &Lanes<N>, n2: &Lanes<N>, k2: &Lanes<N>) -> Self {
        Self { n1: *n1, n2: *n2, k2: *k2 }
    }

    #[inline]
    fn reflectance(&self, cos_theta_i: &Lanes<N>) -> Lanes<N> {
        reflectance(&self.n1, &self.n2, &self.k2, cos_theta_i)
    }

    #[inline]
    fn dielectric(n1: &Lanes<N>, n2: &Lanes<N>, cos_theta_i: &Lanes<N>) -> Dielectric<N> {
        dielectric::fresnel(n1, n2, cos_theta_i)
    }
}

/// Unpolarised reflectance R of N = n2 + i k2 seen from n1.
#[inline]
pub fn reflectance<const N: usize>(n1: &Lanes<N>, n2: &Lanes<N>, k2: &Lanes<N>, cos_theta_i: &Lanes<N>) -> Lanes<N> {
    let mut reflected = Lanes::ZERO;
    for lane in 0..N {
        reflected[lane] = Terms::new(n1[lane], n2[lane], k2[lane], cos_theta_i[lane]).reflected();
    }
    reflected
}

/// Unpolarised (R, 1 − R), each accurate relative to itself.
#[inline]
pub fn reflectance_and_loss<const N: usize>(
    n1: &Lanes<N>,
    n2: &Lanes<N>,
    k2: &Lanes<N>,
    cos_theta_i: &Lanes<N>,
) -> (Lanes<N>, Lanes<N>) {
    let (mut reflected, mut lost) = (Lanes::ZERO, Lanes::ZERO);
    for lane in 0..N {
        let terms = Terms::new(n1[lane], n2[lane], k2[lane], cos_theta_i[lane]);
        reflected[lane] = terms.reflected();
        lost[lane] = terms.lost();
    }
    (reflected, lost)
}

/// What the kernel makes of each polarisation, R and 1 − R apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polarised {
    pub rs: f32,
    pub rp: f32,
    pub one_minus_rs: f32,
    pub one_minus_rp: f32,
}

/// The polarisations of which [`reflectance`] is the mean, by the same terms: for tables, rendering needs only the mean.
pub fn polarised(n1: f32, n2: f32, k2: f32, cos_theta_i: f32) -> Polarised {
    Terms::new(n1, n2, k2, cos_theta_i).polarised()
}

/// The quantities of the file head for one lane, all times g, the larger of a and b: then a g is known without a division.
struct Terms {
    /// |d|².
    contrast: f32,
    g: f32,
    /// g X.
    sum_s: f32,
    /// 4 C a g.
    flux: f32,
    /// g u.
    u: f32,
    /// g v.
    v: f32,
}

impl Terms {
    #[inline(always)]
    fn new(n1: f32, n2: f32, k2: f32, cos: f32) -> Self {
        let k_squared = k2 * k2;
        let d = (n2 - n1) * (n2 + n1) - k_squared;
        let half_im = n2 * k2;
        let im_squared = 4.0 * (half_im * half_im);
        let normal = n1 * cos;
        let normal_squared = normal * normal;
        let tangential = (n1 * (1.0 - cos)) * (n1 * (1.0 + cos));
        // Re w² in two forms, of which the one that subtracts less is taken; both are formed first, so that no branch remains.
        let (steep, grazing) = (n2 * n2 - k_squared - tangential, d + normal_squared);
        let re = if cos > FRAC_1_SQRT_2 { steep } else { grazing };
        let q = (re * re + im_squared).sqrt();
        let g_squared = 0.5 * (q + re.abs());
        let g = g_squared.sqrt() + TINY;
        let product = normal * if re >= 0.0 { g_squared } else { half_im };
        Self {
            contrast: d * d + im_squared,
            g,
            sum_s: (normal_squared + q) * g + 2.0 * product,
            flux: 4.0 * product,
            u: (normal_squared * q + tangential * tangential) * g,
            v: 2.0 * tangential * product,
        }
    }

    #[inline(always)]
    fn reflected(&self) -> f32 {
        let both = self.sum_s * self.sum_s * (self.u + self.v) + f32::MIN_POSITIVE;
        let reflected = self.contrast * self.g * self.g * self.u / both;
        if reflected < 1.0 { reflected } else { 1.0 }
    }

    /// R_p = R_s (u − v)/(u + v), hence 1 − R_p = (u T_s + v (1 + R_s))/(u + v).
    fn polarised(&self) -> Polarised {
        if self.contrast == 0.0 {
            return Polarised { rs: 0.0, rp: 0.0, one_minus_rs: 1.0, one_minus_rp: 1.0 };
        }
        let ratio = self.g / self.sum_s;
        let rs = (self.contrast * ratio * ratio).min(1.0);
        let one_minus_rs = (self.flux / self.sum_s).min(1.0);
        let both = self.u + self.v + f32::MIN_POSITIVE;
        let one_minus_rp = ((self.u * one_minus_rs + self.v * (1.0 + rs)) / both).min(1.0);
        Polarised { rs, rp: rs * ((self.u - self.v) / both).max(0.0), one_minus_rs, one_minus_rp }
    }

    #[inline(always)]
    fn lost(&self) -> f32 {
        let both = self.sum_s * (self.u + self.v) + f32::MIN_POSITIVE;
        let lost = (self.u * self.flux + self.v * self.sum_s) / both;
        if self.contrast > 0.0 { lost } else { 1.0 }
    }
}

/// Keeps g from 0 at the critical angle itself, where g cancels; a difference of f32 indices leaves g above 1e-4.
const TINY: f32 = 1e-10;

#[cfg(test)]
mod tests {
    use super::*;

    fn one(n1: f32, n2: f32, k2: f32, cos: f32) -> f32 {
        reflectance(&Lanes([n1]), &Lanes([n2]), &Lanes([k2]), &Lanes([cos]))[0]
    }

    #[test]
    fn gold_at_normal_incidence() {
        let (n, k) = (0.235_f32, 2.97_f32);
        let f0 = ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k);
        assert!((one(1.0, n, k, 1.0) - f0).abs() < 2e-7);
    }

    #[test]
    fn identical_media_reflect_nothing_at_any_angle() {
        for cos in [0.0, 1e-6, 0.5, 1.0] {
            assert_eq!(one(1.5, 1.5, 0.0, cos), 0.0);
        }
    }

    #[test]
    fn grazing_light_is_reflected_entirely() {
        let (reflected, lost) =
            reflectance_and_loss(&Lanes::<2>::ONE, &Lanes([0.2, 1.5]), &Lanes([3.0, 0.0]), &Lanes::ZERO);
        assert!((0..2).all(|lane| (reflected[lane] - 1.0).abs() < 1e-6 && lost[lane] == 0.0));
    }

    #[test]
    fn lanes_do_not_depend_on_their_number() {
        let (n1, n2, k2) = (Lanes::<8>::ONE, Lanes([0.2, 0.3, 0.6, 1.0, 1.4, 1.5, 2.0, 3.0]), Lanes::<8>::splat(2.9));
        let eight = reflectance(&n1, &n2, &k2, &Lanes::splat(0.37));
        assert!((0..8).all(|lane| eight[lane] == one(1.0, n2[lane], 2.9, 0.37)));
    }
}
