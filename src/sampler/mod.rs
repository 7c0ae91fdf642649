//! The numbers that choose a path.
//!
//! They come from a digital net in a table ([`net`]), which each pixel reads through shifts of its own: two loads and an exclusive or a
//! number, where scrambling each coordinate anew costs 20–60 ns a sample. Every power-of-two prefix of a pixel's samples
//! is a stratified net, and the errors of neighbouring pixels cancel.
//! Beyond the table's dimensions, and for [`Kind::Independent`], numbers are hashes of where they are used.
//!
//! A number depends on seed, pixel, sample index and dimension alone: not on threads, tiles, or how a render was cut.

mod net;

use net::{Net, POINTS, Point, Shift, TILE, hash};
use std::sync::LazyLock;

/// Which numbers a render draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    #[default]
    Sobol,
    Independent,
}

static NET: LazyLock<Net> = LazyLock::new(Net::new);

/// The samples of one pixel.
#[derive(Clone, Copy, Debug)]
pub struct PixelSamples {
    kind: Kind,
    /// Of the tile, or of the pixel alone.
    key: u32,
    /// Of the pixel.
    own: u32,
    /// In the tile; 0 for a pixel alone.
    place: u32,
    round: Round,
}

/// How a pixel reads the net while its samples go through it once.
#[derive(Clone, Copy, Debug)]
struct Round {
    number: u64,
    key: u32,
    own: u32,
    shift: Shift,
}

impl Round {
    /// Before the first one.
    const NONE: Self = Self { number: u64::MAX, key: 0, own: 0, shift: [0; net::SHARED] };

    #[inline]
    fn new(number: u64, pixel: &PixelSamples) -> Self {
        let round = if number == 0 { 0 } else { hash(number as u32 ^ hash((number >> 32) as u32)) };
        let (key, own) = (pixel.key ^ round, pixel.own ^ round);
        if pixel.kind == Kind::Independent {
            return Self { number, key, own, ..Self::NONE };
        }
        let of_place = &NET.shifts[pixel.place as usize];
        // All at once, by vectors: hashed anew for each number they took 5 % of the instructions of a path among metals.
        let shift = std::array::from_fn(|d| of_place[d] ^ hash(key ^ turned(d as u32)));
        Self { number, key, own, shift }
    }
}

/// Tells the shifts of a pixel's dimensions apart.
#[inline]
fn turned(dimension: u32) -> u32 {
    dimension.wrapping_mul(0x9e37_79b9)
}

impl PixelSamples {
    /// Those of the pixel at (`x`, `y`) of the full picture.
    pub fn new(kind: Kind, seed: u64, [x, y]: [u32; 2]) -> Self {
        let seed = mixed(0x9e37_79b9, [seed as u32, (seed >> 32) as u32]);
        let key = mixed(seed, [x / TILE, y / TILE]);
        let place = net::place_in_tile([x % TILE, y % TILE], key);
        Self { kind, key, own: mixed(seed, [x, y]), place, round: Round::NONE }
    }

    /// The same pixel under a random shift of its own: replicates draw independent points, each as well stratified as the
    /// pixel's own, and those of neighbours know nothing of each other, so that noise may be judged by it.
    pub fn replicate(&self, replicate: u32) -> Self {
        let own = hash(self.own ^ hash(replicate ^ 0x7feb_352d));
        Self { kind: self.kind, key: own, own, place: 0, round: Round::NONE }
    }

    /// The same pixel as one of a half of the picture: numbers of two halves know nothing of each other, those of one half still share
    /// a net (MSE on metals up to 4 % above that of one net for all).
    pub fn in_half(&self, half: u32) -> Self {
        Self { key: hash(self.key ^ hash(half ^ 0x2545_f491)), round: Round::NONE, ..*self }
    }

    /// The numbers of sample `index`.
    #[inline]
    pub fn sample(&mut self, index: u64) -> Sampler<'_> {
        let number = index / u64::from(POINTS);
        if self.round.number != number {
            self.round = Round::new(number, self);
        }
        let Round { key, own, shift, .. } = &self.round;
        let net = (self.kind == Kind::Sobol).then(|| (&NET.points[(index as u32 % POINTS) as usize], shift));
        let stream = hash(own.wrapping_add(hash(index as u32 ^ 0x68bc_21eb)));
        Sampler { net, key: *key, own: *own, stream, dimension: 0 }
    }
}

fn mixed(key: u32, words: [u32; 2]) -> u32 {
    words.iter().fold(key, |key, &word| hash(key ^ hash(word ^ key.rotate_left(16))))
}

/// The stream of numbers of one sample of one pixel. Copies give the same numbers again.
#[derive(Clone, Copy, Debug)]
pub struct Sampler<'a> {
    /// The sample's point and the pixel's shift.
    net: Option<(&'static Point, &'a Shift)>,
    key: u32,
    own: u32,
    stream: u32,
    dimension: u32,
}

impl Sampler<'_> {
    /// Uniform in [0, 1), a multiple of 2⁻²⁴.
    #[inline]
    pub fn uniform(&mut self) -> f32 {
        (self.bits() >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// Two, of dimensions that go well together.
    #[inline]
    pub fn uniform_2d(&mut self) -> [f32; 2] {
        self.dimension = self.dimension.next_multiple_of(2);
        [self.uniform(), self.uniform()]
    }

    /// One of `sets` equally likely numbers, stratified over a pixel's samples. `sets` is a power of two.
    #[inline]
    pub fn set(&mut self, sets: u32) -> u32 {
        ((u64::from(self.bits()) * u64::from(sets)) >> 32) as u32
    }

    #[inline]
    fn bits(&mut self) -> u32 {
        let dimension = self.dimension;
        self.dimension += 1;
        let known = self.net.and_then(|(point, shift)| Some((point.get(dimension as usize)?, shift)));
        let Some((point, shift)) = known else { return hash(self.stream ^ hash(dimension.wrapping_add(self.key))) };
        point ^ shift.get(dimension as usize).copied().unwrap_or_else(|| hash(self.own ^ turned(dimension)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIXEL: [u32; 2] = [17, 4];

    #[test]
    fn any_aligned_block_of_samples_visits_every_wavelength_set_once() {
        for first in [0u64, 256, 4096 * 3 + 512] {
            let mut seen = [0; 256];
            for index in first..first + 256 {
                seen[PixelSamples::new(Kind::Sobol, 9, PIXEL).sample(index).set(256) as usize] += 1;
            }
            assert!(seen.iter().all(|&count| count == 1), "block at {first}");
        }
    }

    #[test]
    fn pairs_of_dimensions_are_stratified() {
        let mut cells = [0; 256];
        for index in 0..256 {
            let [u, v] = PixelSamples::new(Kind::Sobol, 1, PIXEL).sample(index).uniform_2d();
            cells[(u * 16.0) as usize * 16 + (v * 16.0) as usize] += 1;
        }
        assert!(cells.iter().all(|&count| count == 1), "the first two Sobol dimensions are a (0, 8, 2)-net");
    }

    #[test]
    fn every_dimension_is_uniform_in_both_kinds() {
        for kind in [Kind::Sobol, Kind::Independent] {
            for dimension in [0, 1, 5, 63, 64, 200] {
                let mean = (0..4096u64)
                    .map(|index| {
                        let mut pixel = PixelSamples::new(kind, 3, PIXEL);
                        let mut sampler = pixel.sample(index);
                        (0..dimension).for_each(|_| {
                            sampler.uniform();
                        });
                        f64::from(sampler.uniform())
                    })
                    .sum::<f64>()
                    / 4096.0;
                // Five standard errors of independent numbers: 5 × 0.2887 / 64.
                assert!((mean - 0.5).abs() < 0.0226, "{kind:?} dimension {dimension}: mean {mean}");
            }
        }
    }

    /// What a pixel that knows nothing yet gives in the order of time, one gives that has gone through other rounds, halves and replicates.
    #[test]
    fn what_was_drawn_before_changes_nothing() {
        let numbers = |pixel: &mut PixelSamples, index| {
            let mut sampler = pixel.sample(index);
            [(); 80].map(|()| sampler.uniform())
        };
        let round = u64::from(POINTS);
        for kind in [Kind::Sobol, Kind::Independent] {
            let fresh = PixelSamples::new(kind, 7, PIXEL);
            let mut used = fresh;
            let mut firsts = Vec::new();
            for index in [0, round, 0, 5 * round + 3, 1 << 40, 1, round] {
                assert_eq!(numbers(&mut used, index), numbers(&mut fresh.clone(), index), "{kind:?} {index}");
                assert_eq!(
                    numbers(&mut used.in_half(1), index),
                    numbers(&mut fresh.in_half(1), index),
                    "{kind:?} {index}"
                );
                assert_eq!(numbers(&mut used.replicate(2), 1), numbers(&mut fresh.replicate(2), 1), "{kind:?} {index}");
                firsts.push(numbers(&mut used, index)[7].to_bits());
            }
            firsts.sort_unstable();
            firsts.dedup();
            assert_eq!(firsts.len(), 5, "{kind:?}: samples differ, repeats do not");
        }
    }

    #[test]
    fn pixels_and_seeds_differ_and_repeats_agree() {
        let first = |seed, pixel| PixelSamples::new(Kind::Sobol, seed, pixel).sample(0).uniform();
        assert_eq!(first(1, [0, 0]), first(1, [0, 0]));
        let distinct: std::collections::BTreeSet<u32> =
            (0..64).flat_map(|i| [first(i, [3, 3]).to_bits(), first(1, [i as u32, 8]).to_bits()]).collect();
        assert!(distinct.len() > 120);
    }

    /// Variance of the mean over blocks of 4 × 4 pixels, times 16, against the variance of pixels: 1 for white noise.
    fn blotches(kind: Kind, samples: u64, integrand: impl Fn([f32; 2]) -> f64) -> f64 {
        let (size, seeds) = (64, 4);
        let (mut of_pixels, mut of_blocks) = (0.0, 0.0);
        for seed in 0..seeds {
            let mut blocks = [0.0; 256];
            let value = |x: u32, y: u32| {
                let mut pixel = PixelSamples::new(kind, seed, [x, y]);
                (0..samples).map(|index| integrand(pixel.sample(index).uniform_2d())).sum::<f64>() / samples as f64
            };
            let values: Vec<f64> = (0..size * size).map(|i| value(i % size, i / size)).collect();
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            for (i, value) in (0..size * size).zip(&values) {
                of_pixels += (value - mean).powi(2);
                blocks[(i / size / 4 * 16 + i % size / 4) as usize] += value - mean;
            }
            of_blocks += blocks.iter().map(|sum| sum * sum).sum::<f64>();
        }
        of_blocks / of_pixels
    }

    /// Variance of a tile's mean, times its pixels, against the variance of pixels, for a pair of dimensions; of independent pixels 1.
    fn of_tile(pair: u32, samples: u64) -> f64 {
        let (mut of_pixels, mut of_tiles) = (0.0, 0.0);
        for seed in 0..12 {
            let mut total = 0.0;
            for i in 0..TILE * TILE {
                let mut pixel = PixelSamples::new(Kind::Sobol, seed, [i % TILE, i / TILE]);
                let value = |index| {
                    let mut sampler = pixel.sample(index);
                    (0..pair).for_each(|_| {
                        sampler.uniform_2d();
                    });
                    edge(sampler.uniform_2d())
                };
                let error = (0..samples).map(value).sum::<f64>() / samples as f64 - 0.45;
                of_pixels += error * error;
                total += error;
            }
            of_tiles += total * total;
        }
        of_tiles / of_pixels
    }

    /// Below the line v = 0.8 − 0.7 u lies 0.45 of the square.
    fn edge([u, v]: [f32; 2]) -> f64 {
        f64::from(u8::from(u * 0.7 + v < 0.8))
    }

    #[test]
    fn tiles_err_less_than_independent_pixels_would_in_pairs_of_shared_dimensions() {
        for pair in 0..net::SHARED as u32 / 2 {
            for samples in [1, 4, 16, 64] {
                let ratio = of_tile(pair, samples);
                assert!(ratio < 0.5, "pair {pair}, {samples} samples: {ratio}");
            }
        }
    }

    /// How far the errors of the two fields of a chessboard of 8 × 8 pixels go together, over many seeds, in a pair of dimensions.
    fn correlation_of_halves(kind: Kind, apart: bool, pair: u32, first: u64) -> f64 {
        let (mut products, mut squares) = (0.0, [0.0; 2]);
        for seed in 0..600 {
            let mut errors = [0.0; 2];
            for (x, y) in (0..64).map(|i| (i % 8, i / 8)) {
                let (half, pixel) = ((x ^ y) & 1, PixelSamples::new(kind, seed, [x, y]));
                let mut pixel = if apart { pixel.in_half(half) } else { pixel };
                let value = |index| {
                    let mut sampler = pixel.sample(index);
                    (0..pair).for_each(|_| {
                        sampler.uniform_2d();
                    });
                    edge(sampler.uniform_2d()) - 0.45
                };
                errors[half as usize] += (first..first + 4).map(value).sum::<f64>();
            }
            products += errors[0] * errors[1];
            (0..2).for_each(|half| squares[half] += errors[half] * errors[half]);
        }
        products / (squares[0] * squares[1]).sqrt()
    }

    #[test]
    fn halves_of_a_picture_know_nothing_of_each_other() {
        let together = correlation_of_halves(Kind::Sobol, false, 0, 0);
        assert!(together < -0.5, "what is to be taken away is there: {together}");
        for (kind, pair, first) in [
            (Kind::Sobol, 0, 0),
            (Kind::Sobol, 0, 4096),
            (Kind::Sobol, 5, 0),
            (Kind::Sobol, 15, 64),
            (Kind::Sobol, 16, 0),
            (Kind::Sobol, 40, 0),
            (Kind::Independent, 0, 0),
        ] {
            let apart = correlation_of_halves(kind, true, pair, first);
            // Five standard errors of nothing: 5/√600.
            assert!(apart.abs() < 0.204, "{kind:?} pair {pair}, from sample {first}: {apart}");
        }
    }

    #[test]
    fn errors_of_neighbours_cancel_at_low_counts() {
        let bump = |[u, v]: [f32; 2]| f64::from(u * (1.0 - u) * v);
        for samples in [1, 2, 4, 16] {
            for (name, ratio) in
                [("an edge", blotches(Kind::Sobol, samples, edge)), ("a bump", blotches(Kind::Sobol, samples, bump))]
            {
                assert!(ratio < 0.5, "{name} at {samples}: {ratio}");
            }
            let white = blotches(Kind::Independent, samples, edge);
            assert!((0.8..1.2).contains(&white), "independent numbers at {samples}: {white}");
        }
    }
}
