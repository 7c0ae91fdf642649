//! How uncertain a pixel is: the spread of independent replicates of it.
//!
//! The samples of a pixel lie in a net, so that their spread says nothing about the error of their mean: it is far smaller than
//! that of as many independent samples. What is honest is to render a pixel [`REPLICATES`] times, each time with a net of
//! its own, and look how far the means mᵣ (of nᵣ samples, n in all) lie apart:
//!
//! Var(m̄) ≈ Σᵣ nᵣ (mᵣ − m̄)² / ((R − 1) n),
//!
//! unbiased for equal nᵣ (A. B. Owen, *Practical Quasi-Monte Carlo Integration*, 2023, on replicated randomised nets).
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
        let mut spread = [0.0; 3];
        for (count, sum) in &taken {
            let (count, of_one) = (f64::from(**count), color(sum, f64::from(**count)));
            (0..3).for_each(|c| spread[c] += count * (of_one[c] - mean[c]) * (of_one[c] - mean[c]));
        }
        spread.map(|spread| spread / ((taken.len() - 1) as f64 * n))
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
        assert_eq!(pixel.variance_of_mean(&Matrix3::IDENTITY), [0.75, 0.0, 0.75]);
        assert_eq!(pixel.variance_of_mean(&Matrix3::diagonal([2.0; 3])), [3.0, 0.0, 3.0]);
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
