//! The points that a pixel's samples stand on, and how neighbouring pixels share them.
//!
//! Points come from generator matrices modulo 2 under a random linear scramble of their digits (J. Matoušek, "On the L2-discrepancy for
//! anchored boxes", 1998), the same for all pixels. The matrices of dimensions 2k and 2k + 1 are Uₖ and Pascal's triangle times Uₖ, with an
//! upper triangular Uₖ, so that each pair by itself is a (0, m, 2)-net for every m, as Sobol's first two dimensions are (Sobol 1967;
//! there U = 1). How well a pair goes together with those before it is up to Uₖ, which `tools/sampler_net.py` finds. Against Sobol's other
//! dimensions in their best order, variance at 16, 64, 256 and 1,024 samples a pixel: metals 1.07, 0.84, 0.95 and 0.91 ×, over seven scenes
//! of metal, glass and stones 1.05, 0.97, 0.93 and 1.06 × (each scene to 5–10 %), and the median pixel of a dispersive diamond 1.00 ×
//! at 16 and 0.87 × at 64. Eighteen other sets of matrices, found with other weights, were at 0.99 to 1.07 × these on metals and in a Cornell box.
//! A scramble of its own for each pixel and coordinate (Owen's) did no better than any of the tables tried with Sobol's points (±7 %).
//!
//! A pixel adds a shift of its own, digit by digit. Shifts of the pixels of a tile are points of another net, along a Z-curve whose
//! every branching is turned at random, as A. G. M. Ahmed & P. Wonka propose for whole sequences ("Screen-space blue-noise diffusion
//! of Monte Carlo sampling error via hierarchical ordering of pixels", ACM TOG 39(6), 2020): what one pixel gets too much its
//! neighbours get too little, and the error of a picture is grain without blotches. There the number of samples must be known
//! beforehand. Here it need not be: with n = 2^m samples the first m digits of a coordinate are all there, whatever the shift, and what
//! tells pixels apart are the next ones. So any k neighbouring digits of the shifts must differ among 2^k pixels, wherever they
//! begin. Pascal's triangle modulo 2 is such a matrix (any k neighbouring rows of its first k columns have determinant 1), and stays one
//! when columns are added to later ones; which are, was searched for so that also pairs of dimensions are well spread
//! (`tools/sampler_net.py` finds both the matrices and the mixes).
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

/// What is above the diagonal of the matrices U of the second pair of dimensions and those after it: column after column, the first row's
/// digit lowest. (The first pair's is 1.)
#[rustfmt::skip]
const SPREAD: [u128; 9] = [
    0x01e428e5fd14de59a, 0x12c6d607316b0f9d1, 0x381c4fd5f3537231d, 0x1750e028774ab76b7, 0x3be450b54a37198e7,
    0x04648f62cfb31fc75, 0x09b5c9b5bc180da37, 0x0722891fd44c5475c, 0x2ccf588ca292b77fe,
];

/// Later pairs have random matrices, by these numbers: none that share their first digits with a dimension before them.
const LATER: [u32; DIMENSIONS / 2 - 1 - SPREAD.len()] =
    [4, 26, 11, 94, 65, 29, 80, 31, 27, 21, 18, 71, 19, 44, 15, 74, 32, 31, 65, 51, 5, 73];

/// Which of the first three columns of Pascal's matrix are added to later ones, a bit each: 0 to 1; 0, 1 to 2; 0, 1, 2 to 3.
const MIXED: [u32; 16] = [63, 40, 50, 45, 45, 50, 45, 50, 13, 0, 45, 50, 45, 50, 13, 0];

/// The net, and the shifts of a tile's pixels along its Z-curve.
pub struct Net {
    pub points: Vec<Point>,
    pub shifts: Vec<Shift>,
}

impl Net {
    pub fn new() -> Self {
        Self { points: span(column), shifts: span(mixed_pascal) }
    }
}

/// What a digit of a point's number adds to its coordinate.
fn column(dimension: usize, column: u32) -> u32 {
    let pair = dimension / 2;
    let above = match pair.checked_sub(1) {
        None => 0,
        Some(after) if after < SPREAD.len() => (SPREAD[after] >> (column * column.saturating_sub(1) / 2)) as u32,
        Some(after) => hash(hash((pair as u32) << 5 | column) ^ LATER[after - SPREAD.len()]),
    };
    let above = above & ((1 << column) - 1);
    let upper = above | 1 << column;
    let rows = if dimension.is_multiple_of(2) { upper } else { times_pascal(upper) };
    rows.reverse_bits()
}

/// The second dimension of a pair from the first: Pascal's triangle modulo 2 has a 1 where the column holds all bits of the row (Lucas).
fn times_pascal(digits: u32) -> u32 {
    let sum =
        |row: u32| (row..DIGITS).filter(|column| column & row == row).fold(0, |sum, column| sum ^ digits >> column);
    (0..DIGITS).fold(0, |product, row| product | (sum(row) & 1) << row)
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
/// others at random, by the one of 25 tried numbers with which tiles err least. Were later columns the same in all dimensions, whole
/// tiles would share the errors of two dimensions together.
fn mixed_pascal(dimension: usize, column: u32) -> u32 {
    let pascal =
        |column: u32| (0..32).filter(|row| row & column == column).fold(0, |digits, row| digits | 1 << (31 - row));
    let random = hash(((dimension as u32) << 5 | column) ^ 1021);
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
#[inline]
pub fn place_in_tile([x, y]: [u32; 2], key: u32) -> u32 {
    let z = (0..DIGITS / 2).fold(0, |z, bit| z | (x >> bit & 1) << (2 * bit) | (y >> bit & 1) << (2 * bit + 1));
    // All at once, by vectors.
    let turns: [u32; DIGITS as usize] = std::array::from_fn(|bit| {
        let above = z >> (bit + 1) | 1 << (DIGITS - bit as u32);
        (hash(key ^ hash(above)) & 1) << bit
    });
    turns.into_iter().fold(z, |place, turn| place ^ turn)
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
    fn every_pair_of_dimensions_fills_all_boxes_of_a_points_share_alike() {
        let net = Net::new();
        for pair in 0..DIMENSIONS / 2 {
            for m in 0..=DIGITS {
                for wide in 0..=m {
                    let mut cells = vec![0; 1 << m];
                    for point in &net.points[..1 << m] {
                        let [x, y] = [(2 * pair, wide), (2 * pair + 1, m - wide)]
                            .map(|(d, digits)| (u64::from(point[d]) >> (32 - digits)) as usize);
                        cells[x << (m - wide) | y] += 1;
                    }
                    assert!(
                        cells.iter().all(|&count| count == 1),
                        "pair {pair}, 2^{m} points, {wide} digits of the first"
                    );
                }
            }
        }
    }

    /// Whether three leading digits of two dimensions, of 2^m points, have combinations that never come.
    fn clash(points: &[Point], one: usize, other: usize) -> bool {
        (0..=3).any(|digits| {
            let seen = points.iter().fold(0u8, |seen, point| {
                let [x, y] = [(one, digits), (other, 3 - digits)].map(|(d, n)| (u64::from(point[d]) >> (32 - n)) as u8);
                seen | 1 << (x << (3 - digits) | y)
            });
            seen != u8::MAX
        })
    }

    #[test]
    fn no_two_dimensions_know_each_other() {
        let net = Net::new();
        for other in 0..DIMENSIONS {
            for one in 0..other {
                assert!(!clash(&net.points[..1 << 10], one, other), "{one} and {other}, 1024 points");
                assert!(other >= SHARED || !clash(&net.points[..1 << 8], one, other), "{one} and {other}, 256 points");
            }
        }
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
