//! The points that a pixel's samples stand on, and how neighbouring pixels share them.
//!
//! Points are the first [`POINTS`] of Sobol's sequence (Sobol 1967; direction numbers of Joe & Kuo 2008 by `sobol_burley`) under a
//! random linear scramble of their digits (J. Matoušek, "On the L2-discrepancy for anchored boxes", 1998), the same for all
//! pixels. The dimensions are put in another order: the pixel has the one pair that is a (0, m, 2)-net, the
//! wavelength the dimension that goes best with it, and each pair from an even dimension on was chosen for the t-values of itself
//! (m ≤ 12) and of the four dimensions that it makes with the pixel's. Against Owen-scrambled points in the order of Joe and Kuo, 256
//! samples a pixel: MSE −15 % on metals, −7 % in a Cornell box, +6 % on clear glass. A scramble of its own for each pixel and coordinate
//! (Owen's) did no better than any of the tables tried (±7 %).
//!
//! A pixel adds a shift of its own, digit by digit. Shifts of the pixels of a tile are points of another net, along a Z-curve whose
//! every branching is turned at random, as A. G. M. Ahmed & P. Wonka propose for whole sequences ("Screen-space blue-noise diffusion
//! of Monte Carlo sampling error via hierarchical ordering of pixels", ACM TOG 39(6), 2020): what one pixel gets too much its
//! neighbours get too little, and the error of a picture is grain without blotches. There the number of samples must be known
//! beforehand. Here it need not be: with n = 2^m samples the first m digits of a coordinate are all there, whatever the shift, and what
//! tells pixels apart are the next ones. So any k neighbouring digits of the shifts must differ among 2^k pixels, wherever they
//! begin. Pascal's triangle modulo 2 is such a matrix (any k neighbouring rows of its first k columns have determinant 1), and stays one
//! when columns are added to later ones; which are, was searched for so that also pairs of dimensions are well spread
//! (`tools/sampler_net.py` finds both the order and the mixes).
//! Linear scrambling is what makes that work: Owen's would turn the next digits in each stratum in another way.

/// Points of the net; longer renders go through it again under new shifts.
pub const POINTS: u32 = 1 << DIGITS;
/// Dimensions of the net; paths that need more go on with hashed numbers.
pub const DIMENSIONS: usize = 64;
/// Pixels along a tile; its pixels have a shift each.
pub const TILE: u32 = 1 << (DIGITS / 2);

const DIGITS: u32 = 12;

/// Dimensions in which neighbours share a net; in later ones each pixel has a random shift of its own.
pub const SHARED: usize = 32;

/// A coordinate for each dimension, its first binary digit on top.
pub type Point = [u32; DIMENSIONS];
pub type Shift = [u32; SHARED];

/// Which of Joe and Kuo's dimensions come first, by their t-values.
const FIRST: [u32; 32] = [
    0, 1, 2, 34, 4, 9, 3, 10, 6, 11, 39, 41, 21, 36, 8, 23, 24, 59, 35, 63, 5, 7, 27, 60, 18, 22, 16, 25, 13, 28, 12,
    40,
];

/// Which of the first three columns of Pascal's matrix are added to later ones, a bit each: 0 to 1; 0, 1 to 2; 0, 1, 2 to 3.
const MIXED: [u32; 16] = [63, 40, 6, 45, 26, 45, 45, 50, 5, 10, 23, 18, 50, 45, 50, 45];

/// The net, and the shifts of a tile's pixels along its Z-curve.
pub struct Net {
    pub points: Vec<Point>,
    pub shifts: Vec<Shift>,
}

impl Net {
    pub fn new() -> Self {
        let order = order();
        let sobol = |d: usize, column: u32| {
            sobol_burley::parts::sobol_rev((1u32 << column).reverse_bits(), order[d]).reverse_bits()
        };
        Self { points: span(sobol), shifts: span(mixed_pascal) }
    }
}

fn order() -> Vec<u32> {
    let rest = (0..DIMENSIONS as u32).filter(|dimension| !FIRST.contains(dimension));
    FIRST.into_iter().chain(rest).collect()
}

/// All sums modulo 2 of the scrambled columns of each dimension: the point of each number.
fn span<const D: usize>(column_of: impl Fn(usize, u32) -> u32) -> Vec<[u32; D]> {
    let mut points = vec![[0; D]];
    for column in 0..DIGITS {
        let column: [u32; D] = std::array::from_fn(|d| scramble(column_of(d, column), d as u32));
        for i in 0..points.len() {
            points.push(std::array::from_fn(|d| points[i][d] ^ column[d]));
        }
    }
    points
}

/// A column of Pascal's triangle modulo 2, by Lucas's theorem, with columns before it added: the first ones as [`MIXED`] says, the
/// others at random, by the one of eight tried numbers with which tiles err least. Were later columns the same in all dimensions, whole tiles would share the errors of two dimensions together.
fn mixed_pascal(dimension: usize, column: u32) -> u32 {
    let pascal =
        |column: u32| (0..32).filter(|row| row & column == column).fold(0, |digits, row| digits | 1 << (31 - row));
    let random = hash(((dimension as u32) << 5 | column) ^ 1000);
    let added = match (column, MIXED.get(dimension)) {
        (1, Some(code)) => code & 1,
        (2, Some(code)) => code >> 1 & 3,
        (3, Some(code)) => code >> 3,
        _ => random,
    };
    (0..column).filter(|before| added >> before & 1 == 1).fold(pascal(column), |sum, before| sum ^ pascal(before))
}

/// Adds to each digit a random choice of those before it.
fn scramble(digits: u32, dimension: u32) -> u32 {
    (1..32).fold(digits, |scrambled, k| {
        let before = !(u32::MAX >> k) & hash(dimension << 5 | k);
        let flip = (digits & before).count_ones() & 1;
        scrambled ^ flip << (31 - k)
    })
}

/// The place of a pixel on its tile's Z-curve, whose branchings are turned by `key`.
pub fn place_in_tile([x, y]: [u32; 2], key: u32) -> u32 {
    let z = (0..DIGITS / 2).fold(0, |z, bit| z | (x >> bit & 1) << (2 * bit) | (y >> bit & 1) << (2 * bit + 1));
    (0..DIGITS).fold(z, |place, bit| {
        let above = z >> (bit + 1) | 1 << (DIGITS - bit);
        place ^ (hash(key ^ hash(above)) & 1) << bit
    })
}

/// A permutation of the 32-bit numbers that mixes well in two multiplications (PCG's RXS-M-XS output function; Jarzynski &
/// Olano 2020, "Hash functions for GPU rendering", find it the best of its cost).
#[inline]
pub fn hash(value: u32) -> u32 {
    let state = value.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

#[cfg(test)]
mod tests {
    use super::*;

    fn digit(point: &[u32], dimension: usize, place: u32) -> u32 {
        point[dimension] >> (31 - place) & 1
    }

    #[test]
    fn any_window_of_digits_tells_that_many_pixels_apart_in_every_dimension() {
        let net = Net::new();
        for dimension in 0..SHARED {
            for (known, k) in [(0, 1), (0, 2), (0, 4), (1, 3), (2, 4), (4, 4), (6, 2), (6, 6)] {
                // With the first 2^m samples each pixel has every combination of m digits; those that come with the first one
                // of them, m samples' digits being alike, must be told apart by the next k.
                let samples = 1usize << known;
                let mut cells = vec![0; samples << k];
                for shift in &net.shifts[..1 << k] {
                    for point in &net.points[..samples] {
                        let cell = (0..known + k).fold(0, |cell, place| {
                            cell << 1 | digit(point, dimension, place) ^ digit(shift, dimension, place)
                        });
                        cells[cell as usize] += 1;
                    }
                }
                assert!(cells.iter().all(|&count| count == 1), "dimension {dimension}, {samples} samples, {k} digits");
            }
        }
    }

    #[test]
    fn a_tile_has_every_place_once_and_its_quarters_are_together() {
        let mut seen = vec![0; POINTS as usize];
        for y in 0..TILE {
            for x in 0..TILE {
                let place = place_in_tile([x, y], 77);
                seen[place as usize] += 1;
                assert_eq!(place >> 2, place_in_tile([x ^ 1, y ^ 1], 77) >> 2);
            }
        }
        assert!(seen.iter().all(|&count| count == 1));
        assert_ne!(place_in_tile([3, 5], 1), place_in_tile([3, 5], 2));
    }
}
