//! Schlick's approximation in RGB with the dip before grazing: exact colours at normal incidence, at cos θ = 1/7 (81.79°) and at 90°.
//!
//! ```text
//! F(θ) = S(θ) − b c (1 − c)⁶,   S(θ) = F0 + (1 − F0)(1 − c)⁵,   c = cos θ
//! b = (S(1/7) − F(1/7)) / ((1/7)(6/7)⁶);   F0 and F(1/7) exact colours, not clipped
//! ```
//!
//! - Source: N. Hoffman, "Fresnel Equations Considered Harmful", MAM 2019; c (1 − c)⁶ is largest at c = 1/7, 81.8°.
//! - Error against `exact` (`tests/it/fresnel/errors.rs`; mean and largest ΔE2000 over the angles): silver 0.03 and 0.06, aluminium 0.20 and 0.54,
//!   copper 0.24 and 0.51, gold 0.44 and 0.94; diamond 1.2 and 2.8, no better than Schlick's.
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids): 11 ns for eight lanes at a hit.

use super::schlick_rgb::{curve, single};
use super::target::COS_82;
use super::{Rgb, Target};
use crate::math::Lanes;

/// The curve of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct F82 {
    pub f0: Lanes<3>,
    pub b: Lanes<3>,
}

impl Rgb for F82 {
    fn fit(target: &Target) -> Self {
        Self::through(target.f0(), target.f82())
    }

    #[inline]
    fn reflectance(&self, cos_theta_i: f32) -> Lanes<3> {
        let x = 1.0 - cos_theta_i;
        let x2 = x * x;
        let (rise, dip) = (x2 * x2 * x, cos_theta_i * x2 * x2 * x2);
        Lanes::from_fn(|i| self.f0[i] + (1.0 - self.f0[i]) * rise - self.b[i] * dip)
    }
}

impl F82 {
    /// The curve through two colours: at normal incidence and at c = 1/7.
    pub fn through(f0: [f64; 3], f82: [f64; 3]) -> Self {
        let x = 1.0 - COS_82;
        let dip = COS_82 * (x * x * x) * (x * x * x);
        let b = std::array::from_fn(|i| (curve(f0[i], COS_82) - f82[i]) / dip);
        Self { f0: single(f0), b: single(b) }
    }
}
