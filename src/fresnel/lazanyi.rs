//! Schlick's approximation in RGB minus a fitted dip: the first correction of it for metals.
//!
//! ```text
//! F(θ) = S(θ) − a c (1 − c)^α,   S(θ) = F0 + (1 − F0)(1 − c)⁵,   c = cos θ
//! ```
//!
//! - Source: I. Lazányi & L. Szirmay-Kalos, "Fresnel term approximations for metals" (WSCG 2005); a and α are theirs to choose. Here they
//!   are least squares of each channel over 101 cosines: of a in closed form, of α downhill from 6, where the dip is at 82° as that of metals is.
//!   F0 the exact colour.
//! - Gold's blue has a second, deeper valley, α = 1 with a < 0: a bulge over all angles instead of a dip. It would bring the mean ΔE2000 from 0.35 to
//!   0.29 and the largest from 0.8 to 1.0.
//! - Error against `exact` (`tests/it/fresnel/errors.rs`; mean and largest ΔE2000 over the angles): silver 0.02 and 0.04, copper 0.07 and 0.13,
//!   aluminium 0.14 and 0.25, gold 0.35 and 0.82: the best of all in RGB but for gold's green.
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids): 92 ns for eight lanes at a hit, for its powers have no whole exponents.

use super::downhill::downhill;
use super::schlick_rgb::{curve, single};
use super::{Rgb, Target};
use crate::math::Lanes;

/// Where the exponent is looked for: from a dip at 0° to one beyond 88°.
const ALPHAS: [f64; 2] = [0.0, 40.0];
const START: f64 = 6.0;
const STEP: f64 = 0.25;

/// The curve of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lazanyi {
    pub f0: Lanes<3>,
    pub a: Lanes<3>,
    pub alpha: Lanes<3>,
}

impl Rgb for Lazanyi {
    fn fit(target: &Target) -> Self {
        let f0 = target.f0();
        let fits: [(f64, f64); 3] = std::array::from_fn(|channel| {
            let above: Vec<_> = target.channel(channel).map(|(cos, r)| (cos, curve(f0[channel], cos) - r)).collect();
            let alpha = downhill(|alpha| best(&above, alpha).1, START, STEP, ALPHAS);
            (best(&above, alpha).0, alpha)
        });
        Self { f0: single(f0), a: single(fits.map(|fit| fit.0)), alpha: single(fits.map(|fit| fit.1)) }
    }

    #[inline]
    fn reflectance(&self, cos_theta_i: f32) -> Lanes<3> {
        let x = 1.0 - cos_theta_i;
        let x2 = x * x;
        let rise = x2 * x2 * x;
        Lanes::from_fn(|i| {
            let dip = self.a[i] * cos_theta_i * libm::powf(x, self.alpha[i]);
            self.f0[i] + (1.0 - self.f0[i]) * rise - dip
        })
    }
}

/// The a of least squares for an exponent, and what is left of the squares.
fn best(above: &[(f64, f64)], alpha: f64) -> (f64, f64) {
    let (mut overlap, mut size, mut squares) = (0.0, 0.0, 0.0);
    for &(cos, value) in above {
        let shape = cos * libm::pow(1.0 - cos, alpha);
        overlap += shape * value;
        size += shape * shape;
        squares += value * value;
    }
    let a = overlap / size;
    (a, squares - a * overlap)
}
