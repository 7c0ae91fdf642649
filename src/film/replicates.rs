//! How uncertain a pixel is: the spread of independent replicates of it.
//!
//! The samples of a pixel lie in a net, so that their spread says nothing about the error of their mean: it is far smaller than
//! that of as many independent samples. What is honest is to render a pixel [`REPLICATES`] times, each time with a net of
//! its own, and look how far the means mᵣ (of nᵣ samples, n in all, wᵣ = nᵣ/n) lie apart:
//!
//! Var(m̄) ≈ Σᵣ aᵣ (mᵣ − m̄)² / (1 + Σᵣ aᵣ), aᵣ = wᵣ² / (1 − 2 wᵣ),
//!
//! for equal nᵣ the usual Σᵣ (mᵣ − m̄)² / ((R − 1) R) (A. B. Owen, *Practical Quasi-Monte Carlo Integration*, 2023, on replicated
//! randomised nets).
//! Its own relative standard deviation is √(2/(R − 1)) = 53 % in one pixel, for means that are about normal.
//! The price: eight nets are together less even than one net of all samples.

use super::fixed::{sum_to_f64, sum_units};
use crate::spectrum::{Matrix3, Xyz};

/// Independent replicates of a pixel; sample i belongs to replicate i mod this.
pub const REPLICATES: usize = 8;

/// Exact sums of XYZ (cd/m²) of every replicate of a pixel. 416 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Replicates {
    sums: [[i128; 3]; REPLICATES],
    counts: [u32; REPLICATES],
}

impl Replicates {
    /// Adds one sample of finite numbers.
    #[inline]
    pub fn add(&mut self, replicate: usize, xyz: [f32; 3]) {
        for (sum, x) in self.sums[replicate].iter_mut().zip(xyz) {
            *sum = sum.wrapping_add(sum_units(x));
        }
        self.counts[replicate] = self.counts[replicate].saturating_add(1);
    }

    /// Mean XYZ (cd/m²) of each replicate that has samples.
    pub fn means(&self) -> impl Iterator<Item = Xyz> {
        let taken = self.sums.iter().zip(&self.counts).filter(|(_, count)| **count > 0);
        taken.map(|(sum, count)| sum.map(|units| sum_to_f64(units) / f64::from(*count)))
    }

    /// Variance of the mean of all samples in the channels that `matrix` makes of XYZ; infinite below two replicates.
    ///
    /// Replicates may differ in their variance by more than their counts: three points of a net are not half as good again as two.
    /// With weights w and means m, E (mᵣ − m)² = (1 − 2 wᵣ) Vᵣ + V, where V = Σ wᵣ² Vᵣ is what is looked for; solved for V this is without
    /// bias whatever the Vᵣ are. It asks for wᵣ < ½; else variances are taken as inverse to the counts.
    pub fn variance_of_mean(&self, matrix: &Matrix3) -> [f64; 3] {
        let taken: Vec<_> = self.counts.iter().zip(&self.sums).filter(|(count, _)| **count > 0).collect();
        if taken.len() < 2 {
            return [f64::INFINITY; 3];
        }
        let n: f64 = taken.iter().map(|(count, _)| f64::from(**count)).sum();
        let color = |sum: &[i128; 3], count: f64| matrix.apply(sum.map(|units| sum_to_f64(units) / count));
        let mut total = [0i128; 3];
        taken.iter().for_each(|(_, sum)| (0..3).for_each(|c| total[c] = total[c].wrapping_add(sum[c])));
        let mean = color(&total, n);
        let any = taken.iter().all(|(count, _)| f64::from(**count) < 0.5 * n);
        let (mut spread, mut weights) = ([0.0; 3], if any { 1.0 } else { 0.0 });
        for (count, sum) in &taken {
            let (share, of_one) = (f64::from(**count) / n, color(sum, f64::from(**count)));
            let weight = if any { share * share / (1.0 - 2.0 * share) } else { share / (taken.len() - 1) as f64 };
            (0..3).for_each(|c| spread[c] += weight * (of_one[c] - mean[c]) * (of_one[c] - mean[c]));
            weights += if any { weight } else { share };
        }
        spread.map(|spread| spread / weights)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variance_is_that_of_the_means() {
        let mut pixel = Replicates::default();
        assert_eq!(pixel.variance_of_mean(&Matrix3::IDENTITY), [f64::INFINITY; 3]);
        // Replicate r has the mean r: variance of 0…7 is 6, of their mean 6/8.
        for (replicate, mean) in (0..REPLICATES).zip([0.0f32, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]) {
            pixel.add(replicate, [mean - 0.5, 1.0, mean]);
            pixel.add(replicate, [mean + 0.5, 1.0, mean]);
        }
        let close = |found: [f64; 3], expected: [f64; 3]| (0..3).all(|c| (found[c] - expected[c]).abs() < 1e-14);
        assert!(close(pixel.variance_of_mean(&Matrix3::IDENTITY), [0.75, 0.0, 0.75]));
        assert!(close(pixel.variance_of_mean(&Matrix3::diagonal([2.0; 3])), [3.0, 0.0, 3.0]));
    }

    #[test]
    fn replicates_may_differ_in_variance() {
        // Means ±a of three replicates of 2 samples and ±b of one of 3: all 16 signs are equally likely, and the variance of the
        // mean is (3 · 4 a² + 9 b²) / 81.
        let (a, b) = (1.0f32, 5.0f32);
        let mut sum = 0.0;
        for signs in 0..16 {
            let sign = |i: u32| if signs >> i & 1 == 1 { 1.0 } else { -1.0 };
            let mut pixel = Replicates::default();
            (0..3).for_each(|r| (0..2).for_each(|_| pixel.add(r, [a * sign(r as u32); 3])));
            (0..3).for_each(|_| pixel.add(3, [b * sign(3); 3]));
            sum += pixel.variance_of_mean(&Matrix3::IDENTITY)[1] / 16.0;
        }
        let expected = f64::from(12.0 * a * a + 9.0 * b * b) / 81.0;
        assert!((sum - expected).abs() < 1e-12, "{sum} against {expected}");
    }

    #[test]
    fn replicates_count_by_their_samples() {
        // Two replicates with 1 and 3 samples: (1 · (3/4)² + 3 · (1/4)²) / (1 · 4) = 0.1875.
        let mut pixel = Replicates::default();
        pixel.add(0, [1.0; 3]);
        (0..3).for_each(|_| pixel.add(5, [0.0; 3]));
        assert_eq!(pixel.variance_of_mean(&Matrix3::IDENTITY), [0.1875; 3]);
    }
}
