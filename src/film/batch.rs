//! Samples of one pixel in a row: gathered in f64, exactly, before its wide sums are touched once for all of them.
//!
//! In the units of [`fixed`](super::fixed) a sample and its square are integers, of up to 89 and 90 bits below [`BRIGHT`]. Each is cut into a
//! multiple of 2ᵏ and a rest of at most 2ᵏ⁻¹ (T. J. Dekker, "A floating-point technique for extending the available precision",
//! Numerische Mathematik 18, 1971; here at a fixed place, by adding and subtracting 1.5 · 2ᵏ⁺⁵²). Of [`FULL`] samples the multiples sum
//! to at most 2⁵³ · 2ᵏ and the rests to at most 2⁵³: no addition is rounded, and the pixel gets the bits that
//! [`Pixel::add`] gives it sample by sample. What is brighter, or no number, goes that way.
//!
//! What it costs is written at [`Pixel`].

use super::Pixel;
use super::fixed::{SQUARE_FRACTION_BITS, SUM_FRACTION_BITS};

/// Magnitudes from here on, in cd/m², are not gathered.
const BRIGHT: f32 = 33_554_432.0;

/// So many samples are gathered at most.
const FULL: u32 = 16;

/// X, Y, Z and Z again: four numbers are one register.
type Four = [f64; 4];

/// Adds samples to a pixel: the same, bit for bit, as to [`add`](Pixel::add) each of them.
impl Extend<[f32; 3]> for Pixel {
    #[inline]
    fn extend<T: IntoIterator<Item = [f32; 3]>>(&mut self, samples: T) {
        let mut batch = Batch::default();
        for xyz in samples {
            batch.add(xyz, self);
        }
        batch.empty_into(self);
    }
}

/// Some samples of a pixel.
#[derive(Default)]
struct Batch {
    sums: Chunks<44>,
    squares: Chunks<49>,
    count: u32,
}

impl Batch {
    #[inline(always)]
    fn add(&mut self, xyz: [f32; 3], pixel: &mut Pixel) {
        let [x, y, z] = xyz;
        // A constant in the fourth place would keep the compiler from taking all four at once.
        let four = [x, y, z, z];
        if !four.iter().fold(true, |fits, x| fits & (x.abs() < BRIGHT)) {
            return add_alone(xyz, pixel);
        }
        if self.count == FULL {
            self.empty_into(pixel);
        }
        let four = four.map(f64::from);
        // Both products are exact: a power of two, and two mantissas of 24 bits.
        self.sums.add(four.map(|x| x * const { power_of_two(SUM_FRACTION_BITS) }));
        self.squares.add(four.map(|x| x * x * const { power_of_two(SQUARE_FRACTION_BITS) }));
        self.count += 1;
    }

    #[inline(never)]
    fn empty_into(&mut self, pixel: &mut Pixel) {
        let Self { sums, squares, count } = std::mem::take(self);
        pixel.add_sums(sums.totals(), squares.totals().map(i128::cast_unsigned), count);
    }
}

#[cold]
fn add_alone(xyz: [f32; 3], pixel: &mut Pixel) {
    pixel.add(xyz);
}

/// Sums of integers, each cut into a multiple of 2^`CUT` and a rest.
#[derive(Default)]
#[repr(align(32))]
struct Chunks<const CUT: u32> {
    high: Four,
    low: Four,
}

impl<const CUT: u32> Chunks<CUT> {
    /// Adds numbers below 2^(`CUT` + 51), cut towards zero.
    #[inline(always)]
    fn add(&mut self, numbers: Four) {
        let place = const { 1.5 * power_of_two(CUT + 52) };
        for (channel, number) in numbers.into_iter().enumerate() {
            let whole = number.trunc();
            let high = (whole + place) - place;
            self.high[channel] += high;
            self.low[channel] += whole - high;
        }
    }

    fn totals(&self) -> [i128; 3] {
        std::array::from_fn(|channel| {
            let high = (self.high[channel] * const { 1.0 / power_of_two(CUT) }) as i64;
            (i128::from(high) << CUT) + i128::from(self.low[channel] as i64)
        })
    }
}

/// 2ⁿ, for n below 1024.
const fn power_of_two(n: u32) -> f64 {
    f64::from_bits((1023 + n as u64) << 52)
}
