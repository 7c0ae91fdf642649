//! The exact sums of one pixel.

use super::fixed::{square_to_f64, square_units, sum_to_f64, sum_units};

/// Sums of XYZ (cd/m²) and of their squares, and how many samples they hold. 112 bytes.
///
/// [`add`](Pixel::add) costs 10.7 ns and some 170 instructions: six 128-bit sums, more than the registers hold. Runs of samples
/// are gathered first ([`batch`](super::batch)) and cost 4.0 ns and some 65 each (casting in f64 to the same bits 17.8, f64 sums without
/// exactness 0.9; one core of a 4th-generation Xeon, `benches/film.rs`). Tried and no faster than `add`: shifting limb by
/// limb instead of in 128 bits, and cutting into two or three chunks by adding and subtracting 1.5 · 2ⁿ in f64 for one sample at a time.
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
    /// Bytes of a pixel in a file.
    pub const BYTES: usize = 104;

    /// Adds one sample in cd/m². A sample with a channel that is no finite number is counted as rejected and not added.
    #[inline]
    pub fn add(&mut self, xyz: [f32; 3]) {
        if !xyz.iter().all(|c| c.is_finite()) {
            self.rejected = self.rejected.saturating_add(1);
            return;
        }
        self.add_sums(xyz.map(sum_units), xyz.map(square_units), 1);
    }

    /// Adds the samples of another pixel.
    #[inline]
    pub fn merge(&mut self, other: &Pixel) {
        self.add_sums(other.sums, other.squares, other.count);
        self.rejected = self.rejected.saturating_add(other.rejected);
    }

    /// Adds the sums of `count` samples, in the units of [`fixed`](super::fixed).
    #[inline]
    pub(super) fn add_sums(&mut self, sums: [i128; 3], squares: [u128; 3], count: u32) {
        for channel in 0..3 {
            // Wrapping can only happen in a pixel whose squares have overflowed (see `fixed`), and keeps even that
            // pixel independent of order.
            self.sums[channel] = self.sums[channel].wrapping_add(sums[channel]);
            self.squares[channel] = self.squares[channel].saturating_add(squares[channel]);
        }
        self.count = self.count.saturating_add(count);
    }

    /// The sums as bytes, little-endian: for files.
    pub fn to_bytes(&self) -> [u8; Self::BYTES] {
        let mut bytes = [0; Self::BYTES];
        for channel in 0..3 {
            bytes[16 * channel..][..16].copy_from_slice(&self.sums[channel].to_le_bytes());
            bytes[48 + 16 * channel..][..16].copy_from_slice(&self.squares[channel].to_le_bytes());
        }
        bytes[96..100].copy_from_slice(&self.count.to_le_bytes());
        bytes[100..].copy_from_slice(&self.rejected.to_le_bytes());
        bytes
    }

    /// The inverse of [`to_bytes`](Pixel::to_bytes).
    pub fn from_bytes(bytes: &[u8; Self::BYTES]) -> Self {
        let wide = |at: usize| std::array::from_fn(|i| bytes[at + i]);
        let short = |at: usize| u32::from_le_bytes(std::array::from_fn(|i| bytes[at + i]));
        Self {
            sums: [0, 16, 32].map(|at| i128::from_le_bytes(wide(at))),
            squares: [48, 64, 80].map(|at| u128::from_le_bytes(wide(at))),
            count: short(96),
            rejected: short(100),
        }
    }

    /// Samples added.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Samples refused because they were not finite.
    pub fn rejected(&self) -> u32 {
        self.rejected
    }

    /// Whether a sum left its range (|sample| ≥ 2⁴³ cd/m², Σx² ≥ 2⁸⁸, or 2³² − 1 samples): the mean is then too small
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
