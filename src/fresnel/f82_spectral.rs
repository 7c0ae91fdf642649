//! Schlick's approximation with the dip before grazing: exact at normal incidence, at cos θ = 1/7 (81.79°) and at 90°, for each wavelength.
//!
//! ```text
//! F(θ) = S(θ) − b c (1 − c)⁶,   S(θ) = F0 + (1 − F0)(1 − c)⁵,   c = cos θ
//! b = (S(1/7) − F(1/7)) / ((1/7)(6/7)⁶)
//! ```
//!
//! - Source: N. Hoffman, "Fresnel Equations Considered Harmful", MAM 2019, whose model in RGB this is per wavelength; c (1 − c)⁶ is largest at
//!   c = 1/7, 81.8°. F0 and F(1/7) exact, of n and k.
//! - A lossless interface is fitted on its rarer side, where angles reach 90°; beyond the critical angle F = 1.
//! - Where the indices nearly match, Schlick's curve is so far off at 82° that the correction leads below 0 elsewhere; a share of light is then
//!   taken as 0. Metals and stones in air stay within 0…1 by themselves.
//! - Error against `exact` (`tests/it/fresnel/models.rs`), largest over 380–780 nm and all angles: silver 0.002, copper 0.012, iron 0.019,
//!   gold 0.029, diamond 0.030, aluminium 0.033.
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids): 21 ns for eight lanes at a hit, against 14 of `exact`: b takes the exact model once,
//!   so this is no way to save time where n and k are at hand.

use super::schlick::{self, Schlick};
use super::{Model, conductor};
use crate::math::Lanes;

/// Where the correction is largest, and where it is fitted.
const COS_82: f32 = super::COS_82 as f32;

/// The corrected curve of one hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct F82Spectral<const N: usize> {
    pub schlick: Schlick<N>,
    pub b: Lanes<N>,
}

impl<const N: usize> Model<N> for F82Spectral<N> {
    #[inline]
    fn new(n1: &Lanes<N>, n2: &Lanes<N>, k2: &Lanes<N>) -> Self {
        let schlick = Schlick { f0: schlick::normal_incidence(n1, n2, k2) };
        // Seen from its denser side a lossless interface has no 82°.
        let denser = |lane: usize| k2[lane] == 0.0 && n1[lane] > n2[lane];
        let outer = Lanes::from_fn(|lane| if denser(lane) { n2[lane] } else { n1[lane] });
        let inner = Lanes::from_fn(|lane| if denser(lane) { n1[lane] } else { n2[lane] });
        let cos = Lanes::splat(COS_82);
        let exact = conductor::reflectance(&outer, &inner, k2, &cos);
        let b = (schlick.reflectance(&cos) + exact * -1.0) * (1.0 / bump(COS_82));
        Self { schlick, b }
    }

    #[inline]
    fn reflectance(&self, cos_theta: &Lanes<N>) -> Lanes<N> {
        let curve = self.schlick.reflectance(cos_theta) + self.b * cos_theta.map(|cos| -bump(cos));
        curve.map(|r| r.clamp(0.0, 1.0))
    }
}

/// c (1 − c)⁶.
#[inline(always)]
fn bump(cos: f32) -> f32 {
    let x = 1.0 - cos;
    let x2 = x * x;
    cos * x2 * x2 * x2
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::exact;

    #[test]
    fn exact_at_normal_incidence_at_82_degrees_and_at_grazing() {
        let (n, k) = (0.96_f32, 6.69_f32);
        let curve = F82Spectral::new(&Lanes([1.0]), &Lanes([n]), &Lanes([k]));
        for cos in [1.0f32, COS_82, 0.0] {
            let expected = exact::reflect(1.0, n.into(), k.into(), cos.into()).r as f32;
            assert!((curve.reflectance(&Lanes([cos]))[0] - expected).abs() < 1e-6, "{cos}");
        }
    }

    /// A negative share could be no probability.
    #[test]
    fn nearly_matched_indices_reflect_no_less_than_nothing() {
        let matched = F82Spectral::new(&Lanes([1.5]), &Lanes([1.51]), &Lanes([0.0]));
        let unbounded = |cos: f32| matched.schlick.reflectance(&Lanes([cos]))[0] - matched.b[0] * bump(cos);
        assert!(unbounded(0.3) < -0.05, "the case is not met");
        for i in 0..=100 {
            let r = matched.reflectance(&Lanes([i as f32 * 0.01]))[0];
            assert!((0.0..=1.0).contains(&r), "{i}: {r}");
        }
    }

    #[test]
    fn both_sides_of_a_glass_surface_agree() {
        let (air, glass) = (Lanes([1.0]), Lanes([1.5]));
        let entering = F82Spectral::dielectric(&air, &glass, &Lanes([0.3]));
        let leaving = F82Spectral::dielectric(&glass, &air, &entering.cos_theta_t);
        assert!((entering.r[0] - leaving.r[0]).abs() < 1e-6);
        assert_eq!(F82Spectral::dielectric(&glass, &air, &Lanes([0.5])).r[0], 1.0);
    }
}
