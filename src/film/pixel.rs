//! The exact sums of one pixel.

use super::fixed::{square_to_f64, square_units, sum_to_f64, sum_units};

/// Sums of XYZ (cd/m²) and of their squares, and how many samples they hold. 112 bytes.
///
/// Equal sets of samples give equal pixels, bit for bit, in any order and by any route of [`merge`](Pixel::merge).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pixel {
    sums: [i128; 3],
    squares: [u128; 3],
    count: u32,
    rejected: u32,
}

impl Pixel {
    /// Adds one sample in cd/m². A sample with a channel that is no finite number is counted as rejected and not added.
    #[inline]
    pub fn add(&mut self, xyz: [f32; 3]) {
        if !xyz.iter().all(|c| c.is_finite()) {
            self.rejected = self.rejected.saturating_add(1);
            return;
        }
        self.count = self.count.saturating_add(1);
        for (channel, x) in xyz.into_iter().enumerate() {
            // Wrapping can only happen in a pixel whose squares have overflowed (see `fixed`), and keeps even that
            // pixel independent of order.
            self.sums[channel] = self.sums[channel].wrapping_add(sum_units(x));
            self.squares[channel] = self.squares[channel].saturating_add(square_units(x));
        }
    }

    /// Adds the samples of another pixel.
    #[inline]
    pub fn merge(&mut self, other: &Pixel) {
        for channel in 0..3 {
            self.sums[channel] = self.sums[channel].wrapping_add(other.sums[channel]);
            self.squares[channel] = self.squares[channel].saturating_add(other.squares[channel]);
        }
        self.count = self.count.saturating_add(other.count);
        self.rejected = self.rejected.saturating_add(other.rejected);
    }

    /// Samples added.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Samples refused because they were not finite.
    pub fn rejected(&self) -> u32 {
        self.rejected
    }

    /// Whether a sum left its range (|sample| ≥ 2³⁹ cd/m², Σx² ≥ 2⁸⁰, or 2³² − 1 samples): the mean is then too small
    /// and the variance unknown. Development reports such pixels.
    pub fn overflowed(&self) -> bool {
        self.count == u32::MAX || self.squares.contains(&u128::MAX)
    }

    /// The mean of the samples in cd/m², rounded once per channel; zero without samples.
    pub fn mean(&self) -> [f64; 3] {
        let n = f64::from(self.count.max(1));
        self.sums.map(|sum| sum_to_f64(sum) / n)
    }

    /// An unbiased estimate of the variance of [`mean`](Pixel::mean) in (cd/m²)², for independent samples: infinite
    /// below two samples or after overflow. Its floor from rounding is about 1e-16 of the squared mean.
    pub fn variance_of_mean(&self) -> [f64; 3] {
        if self.count < 2 || self.overflowed() {
            return [f64::INFINITY; 3];
        }
        let (n, mean) = (f64::from(self.count), self.mean());
        let spread = |channel: usize| square_to_f64(self.squares[channel]) / n - mean[channel] * mean[channel];
        [0, 1, 2].map(|channel| spread(channel).max(0.0) / (n - 1.0))
    }
}
