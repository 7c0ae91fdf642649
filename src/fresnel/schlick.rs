//! Schlick's approximation: the reflectance at normal incidence, raised to 1 at grazing by a fifth power.
//!
//! ```text
//! F(θ) = F0 + (1 − F0)(1 − cos θ)⁵,   F0 = ((n2 − n1)² + k2²)/((n2 + n1)² + k2²)
//! ```
//!
//! - Source: C. Schlick, "An inexpensive BRDF model for physically-based rendering" (1994), eq. 15; F0 exact.
//! - For a lossless interface left from its denser side, θ is the angle of refraction, and F = 1 beyond the critical angle.
//! - Error against `exact` (`tests/it/fresnel/kernels.rs`): R up to 0.017 too high for gold, 0.09 aluminium, 0.18 iron, 0.20 chromium, all
//!   near 83°, for it has no pseudo-Brewster dip; averaged over the hemisphere up to 0.030.
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids): 3.5 ns for eight lanes, F0 and dispatch included.

use super::Model;
use crate::math::Lanes;

/// Schlick's curve of one hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schlick<const N: usize> {
    pub f0: Lanes<N>,
}

impl<const N: usize> Model<N> for Schlick<N> {
    #[inline]
    fn new(n1: &Lanes<N>, n2: &Lanes<N>, k2: &Lanes<N>) -> Self {
        Self { f0: normal_incidence(n1, n2, k2) }
    }

    #[inline]
    fn reflectance(&self, cos_theta: &Lanes<N>) -> Lanes<N> {
        self.f0.zip(*cos_theta, curve)
    }
}

/// F0 of N = n2 + i k2 seen from n1: exact, both polarisations agree there.
#[inline]
pub fn normal_incidence<const N: usize>(n1: &Lanes<N>, n2: &Lanes<N>, k2: &Lanes<N>) -> Lanes<N> {
    let mut f0 = Lanes::ZERO;
    for lane in 0..N {
        let (difference, sum, loss) = (n2[lane] - n1[lane], n2[lane] + n1[lane], k2[lane] * k2[lane]);
        f0[lane] = (difference * difference + loss) / (sum * sum + loss);
    }
    f0
}

#[inline(always)]
fn curve(f0: f32, cos: f32) -> f32 {
    let x = 1.0 - cos;
    let x2 = x * x;
    f0 + (1.0 - f0) * (x2 * x2 * x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::exact;

    #[test]
    fn exact_at_both_ends() {
        let gold = Schlick::new(&Lanes([1.33]), &Lanes([0.235]), &Lanes([2.97]));
        let f0 = exact::reflect(1.33, 0.235, 2.97, 1.0).r as f32;
        assert!((gold.reflectance(&Lanes::ONE)[0] - f0).abs() < 2e-7);
        assert_eq!(gold.reflectance(&Lanes::ZERO)[0], 1.0);
    }

    #[test]
    fn both_sides_of_a_glass_surface_agree() {
        let (air, glass) = (Lanes([1.0]), Lanes([1.5]));
        let entering = Schlick::dielectric(&air, &glass, &Lanes([0.6]));
        let leaving = Schlick::dielectric(&glass, &air, &entering.cos_theta_t);
        assert!((entering.r[0] - leaving.r[0]).abs() < 1e-6);
        assert_eq!(Schlick::dielectric(&glass, &air, &Lanes([0.5])).r[0], 1.0);
    }
}
