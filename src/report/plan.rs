//! Which pixel gets how many samples, so that a picture's error falls fastest.
//!
//! The mean of errors σₚ/√nₚ is least for nₚ ∝ σₚ^(2/3), the root mean square for nₚ ∝ σₚ (Lagrange), σₚ being a pixel's noise for one sample.
//!
//! A pixel whose own first samples decided how many it gets would be biased: where they happen to be alike, it gets few, and what is rare in
//! it is missed for good. Here σₚ is that of the pixels around it, without itself, and of the first samples alone, so the number of a
//! pixel's samples and their values are independent but for the common factor. When to stop is decided for either half of a chessboard by the
//! noise of the other ([`super::noise::half`]), for the same reason: a picture that stops when it happens to look quiet is darker in the mean.
//! So a pixel's mean is what it is without any plan (`tests/target_error.rs`).

use std::ops::Range;

/// Pixels around one that speak for it: 5 × 5.
const REACH: i64 = 2;

/// No pixel gets less than this share of the mean number, so that what its surroundings do not show is found too, nor more than this
/// many times of it.
const LEAST: f64 = 0.25;
const MOST: f64 = 16.0;

/// How samples are shared: 1 is the mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Shares(Vec<f64>);

impl Shares {
    /// By the noise of each pixel after equally many samples, row by row, so that the mean of σ (`power` 2/3) or its mean square (1) is
    /// least.
    pub fn new(noise: &[f32], width: usize, power: f64) -> Self {
        let around: Vec<f64> = (0..noise.len()).map(|at| libm::pow(around(noise, width, at), power)).collect();
        let mean = mean(&around);
        if !(mean > 0.0 && mean.is_finite()) {
            return Self(vec![1.0; noise.len()]);
        }
        let bounded: Vec<f64> = around.iter().map(|share| (share / mean).clamp(LEAST, MOST)).collect();
        let mean = self::mean(&bounded);
        Self(bounded.iter().map(|share| share / mean).collect())
    }

    /// Samples of each pixel from those that it has to its share of what is the mean where it lies, in whole steps; never fewer than it has.
    pub fn ranges(&self, has: impl Iterator<Item = u64>, mean: impl Fn(usize) -> f64, step: u64) -> Vec<Range<u64>> {
        let wanted = |(at, share): (usize, &f64)| libm::round(share * mean(at) / step as f64) as u64 * step;
        self.0.iter().enumerate().zip(has).map(|(place, has)| has..wanted(place).max(has)).collect()
    }
}

/// Root mean square of the pixels around one.
fn around(noise: &[f32], width: usize, at: usize) -> f64 {
    let (x, y) = ((at % width) as i64, (at / width) as i64);
    let height = (noise.len() / width) as i64;
    let (mut sum, mut count) = (0.0, 0.0);
    for j in (y - REACH).max(0)..=(y + REACH).min(height - 1) {
        for i in (x - REACH).max(0)..=(x + REACH).min(width as i64 - 1) {
            if (i, j) != (x, y) {
                let value = f64::from(noise[j as usize * width + i as usize]);
                sum += value * value;
                count += 1.0;
            }
        }
    }
    if count > 0.0 { (sum / count).sqrt() } else { f64::from(noise[at]) }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noisy_places_get_more_and_a_pixel_does_not_speak_for_itself() {
        let mut noise = vec![1.0; 11 * 11];
        noise[5 * 11 + 5] = 1000.0;
        let shares = Shares::new(&noise, 11, 2.0 / 3.0).0;
        assert!(shares[5 * 11 + 5] < 1.0 && shares[5 * 11 + 6] > shares[5 * 11 + 5]);
        assert!((mean(&shares) - 1.0).abs() < 1e-12);
        // Against a pixel far away, whatever its own noise was (so large that others reach their bounds, it moves what those are).
        let against = |own: f32| {
            let mut noise: Vec<f32> = (0..121).map(|i| 1.0 + 0.01 * i as f32).collect();
            noise[5 * 11 + 5] = own;
            let shares = Shares::new(&noise, 11, 2.0 / 3.0).0;
            shares[5 * 11 + 5] / shares[0]
        };
        assert!((against(0.001) - against(2.0)).abs() < 1e-12);
    }

    #[test]
    fn ranges_go_on_where_they_ended() {
        let shares = Shares(vec![0.5, 1.5]);
        assert_eq!(shares.ranges([16, 16].into_iter(), |_| 32.0, 8), vec![16..16, 16..48]);
        assert_eq!(shares.ranges([16, 48].into_iter(), |_| 64.0, 8), vec![16..32, 48..96]);
    }

    #[test]
    fn a_picture_without_noise_is_shared_evenly() {
        assert_eq!(Shares::new(&[0.0; 9], 3, 1.0), Shares(vec![1.0; 9]));
    }
}
