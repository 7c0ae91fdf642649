//! Two numbers that sum up a reflectance curve: at normal incidence, and averaged over the cosine-weighted hemisphere.
//!
//! ```text
//! F_avg = 2 ∫₀¹ F(c) c dc
//! ```
//!
//! F_avg is what diffuse light sees, and what multiple scattering between facets attenuates by each time.
//! Integrated adaptively to 1e-12 in f64, kinks at the critical angle included.

use super::exact;
use crate::math::quadrature;

/// F_avg of any curve of cos θ_i.
pub fn average(mut curve: impl FnMut(f64) -> f64) -> f64 {
    quadrature::adaptive(&mut |cos| 2.0 * cos * curve(cos), 0.0, 1.0, 1e-12)
}

/// Exact reflectance of N = n2 + i k2 at normal incidence from n1.
pub fn f0(n1: f64, n2: f64, k2: f64) -> f64 {
    exact::reflect(n1, n2, k2, 1.0).r
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn schlick_averages_to_its_closed_form() {
        let f0 = 0.3;
        let averaged = average(|c| f0 + (1.0 - f0) * libm::pow(1.0 - c, 5.0));
        assert!((averaged - (f0 + (1.0 - f0) / 21.0)).abs() < 1e-13);
    }

    #[test]
    fn diffuse_light_obeys_the_n_squared_law() {
        // As much diffuse light crosses from within as from without: 1 − F_in = (1 − F_out)/n² (Stokes 1849; Judd 1942).
        let n = 1.5;
        let outside = average(|c| exact::reflect(1.0, n, 0.0, c).r);
        let inside = average(|c| exact::reflect(n, 1.0, 0.0, c).r);
        assert!((1.0 - inside - (1.0 - outside) / (n * n)).abs() < 1e-11, "{inside} {outside}");
        // Judd (1942), table 1: 0.0918 and 0.5963 for n = 1.5.
        assert!((outside - 0.0918).abs() < 5e-5 && (inside - 0.5963).abs() < 1e-4, "{inside} {outside}");
    }
}
