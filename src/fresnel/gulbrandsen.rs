//! Fresnel's equations with n and k made of two colours that an artist can pick: the reflectance r and an edge tint g.
//!
//! ```text
//! n = g (1 − r)/(1 + r) + (1 − g)(1 + √r)/(1 − √r),   k² = (r (n + 1)² − (n − 1)²)/(1 − r)
//! ```
//!
//! - Source: O. Gulbrandsen, "Artist Friendly Metallic Fresnel" (JCGT 2014), eqs. 10–12. r is the exact colour at normal incidence, clipped to
//!   0…`LARGEST_R`; g is what fits each channel best over 101 cosines, as far as it can be set: in steps of 1/400, the last one in hundredths.
//! - Every (r, g) has an n and a k ≥ 0, and the F0 of those is r.
//! - Error against `exact` (`tests/it/fresnel/errors.rs`; mean and largest ΔE2000 over the angles): silver 0.02 and 0.05, aluminium 0.06 and 0.20;
//!   where the clip cuts red, gold 0.79 and 1.4, copper 1.3 and 1.5. The steps of g are most of it for white metals: with all digits of g
//!   aluminium would have 0.007 and 0.03.
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids): 17 to 35 ns for eight lanes at a hit, as it is inlined.

use super::schlick_rgb::single;
use super::{Rgb, Target, conductor, exact};
use crate::math::Lanes;

/// At r = 1 the equations divide by 0.
const LARGEST_R: f64 = 0.9999;

/// How finely an edge tint is set: within the last step n falls from some tens to a few hundredths for a white metal, so that step is cut again.
const STEPS: u32 = 400;
const LAST_STEPS: u32 = 100;

/// The edge tints that can be set, 0…1.
fn settings() -> impl Iterator<Item = f64> {
    let last = (1..=LAST_STEPS).map(|i| f64::from((STEPS - 1) * LAST_STEPS + i) / f64::from(STEPS * LAST_STEPS));
    (0..STEPS).map(|i| f64::from(i) / f64::from(STEPS)).chain(last)
}

/// The curve of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gulbrandsen {
    /// The edge tint that fits, 0…1.
    pub g: [f64; 3],
    n: Lanes<3>,
    k: Lanes<3>,
}

impl Rgb for Gulbrandsen {
    fn fit(target: &Target) -> Self {
        let r = target.f0().map(|channel| channel.clamp(0.0, LARGEST_R));
        let g = std::array::from_fn(|channel| {
            let curve: Vec<_> = target.channel(channel).collect();
            let squares = |g: f64| {
                let (n, k) = index(r[channel], g);
                let off = |&(cos, value): &(f64, f64)| exact::reflect(1.0, n, k, cos).r - value;
                curve.iter().map(off).map(|off| off * off).sum::<f64>()
            };
            settings().map(|g| (squares(g), g)).fold((f64::INFINITY, 1.0), |a, b| if b.0 < a.0 { b } else { a }).1
        });
        let indices: [(f64, f64); 3] = std::array::from_fn(|channel| index(r[channel], g[channel]));
        Self { g, n: single(indices.map(|index| index.0)), k: single(indices.map(|index| index.1)) }
    }

    #[inline]
    fn reflectance(&self, cos_theta_i: f32) -> Lanes<3> {
        conductor::reflectance(&Lanes::ONE, &self.n, &self.k, &Lanes::splat(cos_theta_i))
    }
}

/// n and k relative to the medium outside, of a reflectance r and an edge tint g.
pub fn index(r: f64, g: f64) -> (f64, f64) {
    let root = r.sqrt();
    let n = g * (1.0 - r) / (1.0 + r) + (1.0 - g) * (1.0 + root) / (1.0 - root);
    let k_squared = (r * (n + 1.0) * (n + 1.0) - (n - 1.0) * (n - 1.0)) / (1.0 - r);
    (n, k_squared.max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pair_reflects_its_r_at_normal_incidence() {
        for r in [0.0, 0.02, 0.17, 0.5, 0.93, LARGEST_R] {
            for g in [0.0, 0.3, 1.0] {
                let (n, k) = index(r, g);
                assert!((exact::reflect(1.0, n, k, 1.0).r - r).abs() < 1e-12, "{r} {g}");
            }
        }
        // Without an edge tint a dielectric comes out: k = 0.
        let (n, k) = index(0.04, 0.0);
        assert!((n - 1.5).abs() < 1e-12 && k < 1e-7);
    }
}
