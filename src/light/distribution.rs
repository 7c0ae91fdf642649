//! Texels chosen by weight, rows first, then the texel in the row: by inversion of cumulative sums, which keeps points that
//! are spread well spread well.
//!
//! The numbers that choose are multiples of 2⁻²⁴, so cumulative sums are kept as whole numbers of such steps: a texel is then
//! chosen exactly as often as its density says. What rounds to no step is never chosen, and its density says that too.

const STEPS: f64 = 16_777_216.0;

#[derive(Clone, Debug)]
pub(super) struct Distribution {
    width: usize,
    /// Up to and with each row.
    rows: Vec<u32>,
    /// Up to and with each texel of a row, row by row.
    texels: Vec<u32>,
}

impl Distribution {
    /// By the weight of each texel, row by row; not negative, and some above 0.
    pub fn new(width: u32, weights: &[f64]) -> Self {
        let sums = weights.chunks(width as usize).map(|row| row.iter().sum());
        Self {
            width: width as usize,
            rows: cumulative(sums.collect::<Vec<f64>>()),
            texels: weights.chunks(width as usize).flat_map(|row| cumulative(row.iter().copied())).collect(),
        }
    }

    /// A texel, and where the two numbers lie within what chose it: 0…1 and uniform again.
    #[inline]
    pub fn sample(&self, [u, v]: [f32; 2]) -> Option<([u32; 2], [f32; 2])> {
        let (row, a) = choose(&self.rows, u)?;
        let (column, b) = choose(self.row(row), v)?;
        Some(([row as u32, column as u32], [a, b]))
    }

    /// Probability of a texel.
    #[inline]
    pub fn probability(&self, [row, column]: [u32; 2]) -> f32 {
        let (row, column) = (row as usize, column as usize);
        (steps(&self.rows, row) as f32 / STEPS as f32) * (steps(self.row(row), column) as f32 / STEPS as f32)
    }

    #[inline]
    fn row(&self, row: usize) -> &[u32] {
        &self.texels[row * self.width..(row + 1) * self.width]
    }
}

/// All zero where nothing has a weight.
fn cumulative(weights: impl IntoIterator<Item = f64, IntoIter: Clone>) -> Vec<u32> {
    let weights = weights.into_iter();
    let total: f64 = weights.clone().sum();
    let mut sum = 0.0;
    let up_to = |weight: f64| {
        sum += weight;
        if total > 0.0 { libm::round((sum / total).min(1.0) * STEPS) as u32 } else { 0 }
    };
    weights.map(up_to).collect()
}

#[inline]
fn steps(cumulative: &[u32], index: usize) -> u32 {
    cumulative[index] - if index == 0 { 0 } else { cumulative[index - 1] }
}

#[inline]
fn choose(cumulative: &[u32], u: f32) -> Option<(usize, f32)> {
    let step = (u * STEPS as f32) as u32;
    let index = cumulative.partition_point(|&up_to| up_to <= step);
    let last = *cumulative.get(index)?;
    let first = last - steps(cumulative, index);
    Some((index, ((step - first) as f32 + 0.5) / (last - first) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_step_chooses_the_texel_whose_probability_counts_it() {
        let weights = [3.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 2.0, 1e-12];
        let distribution = Distribution::new(3, &weights);
        let mut counts = [0u32; 9];
        for i in 0..1 << 12 {
            for j in 0..1 << 6 {
                let u = [i as f32 / 4096.0, j as f32 / 64.0];
                let ([row, column], inside) = distribution.sample(u).unwrap();
                counts[(row * 3 + column) as usize] += 1;
                assert!(inside.iter().all(|x| (0.0..1.0).contains(x)));
            }
        }
        for (i, count) in counts.into_iter().enumerate() {
            let probability = distribution.probability([i as u32 / 3, i as u32 % 3]);
            assert!((probability - weights[i] as f32 / 8.0).abs() < 1e-7, "{i}: {probability}");
            assert!((count as f32 / 262_144.0 - probability).abs() < 1e-2 && (probability > 0.0) == (count > 0), "{i}");
        }
        // The middle row and the last texel are too dark to be chosen.
        assert_eq!(distribution.probability([2, 2]), 0.0);
        let total: f32 = (0..9).map(|i| distribution.probability([i / 3, i % 3])).sum();
        assert_eq!(total, 1.0);
    }

    #[test]
    fn numbers_at_both_ends_choose_texels_that_have_weight() {
        let distribution = Distribution::new(2, &[0.0, 1.0, 1.0, 0.0]);
        assert_eq!(distribution.sample([0.0, 0.0]).unwrap().0, [0, 1]);
        let last = 1.0 - 1.0 / STEPS as f32;
        assert_eq!(distribution.sample([last, last]).unwrap().0, [1, 0]);
    }
}
