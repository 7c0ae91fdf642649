//! The wavelengths that the renderer uses: 2048 nodes, drawn from a density and used in sets of N per path.
//!
//! Every spectrum is tabulated at the nodes once, so that a lookup in a path is one load. Node i stands for the cell
//! between the quantiles i/M and (i+1)/M of the density: its wavelength is the middle of the cell, its weight the cell's
//! width, so a constant integrates exactly; XYZ of A and D50…D75 are within 4e-7, of FL1–FL12 and LED-B1…5 within 5e-6 (of FL1–FL12
//! within 2e-6 by the density that follows them).
//! Set s of N lanes has the nodes s + j·M/N, j = 0…N−1: one in each N-th of the density, so a path sees the whole
//! range, and ∫ f dλ is the mean over the sets of (M/N) Σ_j f(λ_j) w_j.
//!
//! Emission lines are lines 0.1 nm wide, about what lamps have, where the density has boxes for them.

use super::density::LineWidth;
use super::{ColorMatching, Density, LAMBDA_MAX_NM, LAMBDA_MIN_NM, Line, Spectrum, Xyz};
use crate::math::LANES;

/// How many nodes there are: M.
pub const NODE_COUNT: usize = 2048;

/// The nodes of a render.
#[derive(Clone, Debug)]
pub struct Nodes {
    /// M + 1 ends of cells, nm.
    edges_nm: Vec<f64>,
}

impl Nodes {
    pub fn new(density: &Density) -> Self {
        let mut edges_nm = vec![LAMBDA_MIN_NM; NODE_COUNT + 1];
        for i in 1..NODE_COUNT {
            let u = i as f64 / NODE_COUNT as f64;
            edges_nm[i] = density.quantile(u, edges_nm[i - 1], LAMBDA_MAX_NM);
        }
        edges_nm[NODE_COUNT] = LAMBDA_MAX_NM;
        Self { edges_nm }
    }

    /// The wavelength of node i, nm.
    pub fn wavelength_nm(&self, i: usize) -> f64 {
        0.5 * (self.edges_nm[i] + self.edges_nm[i + 1])
    }

    /// Where the cell of node i begins and ends, nm.
    pub fn cell_nm(&self, i: usize) -> (f64, f64) {
        (self.edges_nm[i], self.edges_nm[i + 1])
    }

    /// The width of the cell of node i, nm; all of them sum to 470.
    pub fn weight_nm(&self, i: usize) -> f64 {
        self.edges_nm[i + 1] - self.edges_nm[i]
    }

    /// The value of a spectrum at each node: its mean over the cell, as far as it is straight between its breakpoints.
    /// (Values at the middles of the cells: XYZ of D50 off by 1.4e-6 instead of 3.9e-7, for the cells with a bend in them.)
    /// A line's power is spread over the nodes of its box, or over its two neighbours if the density gives it no box, such
    /// that total power and mean wavelength are kept.
    pub fn values(&self, spectrum: &Spectrum) -> Vec<f64> {
        let mut bends = spectrum.breakpoints_nm();
        bends.sort_by(f64::total_cmp);
        let mut values: Vec<_> = (0..NODE_COUNT)
            .map(|i| {
                let integral: f64 = self.pieces(i, &bends).map(|(nm, width)| width * spectrum.at(nm)).sum();
                integral / self.weight_nm(i)
            })
            .collect();
        for Line { nm, power } in spectrum.lines() {
            if (LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(&nm) {
                for (i, share) in self.spread(nm) {
                    values[i] += power * share / self.weight_nm(i);
                }
            }
        }
        values
    }

    /// [`Nodes::values`] as the renderer keeps them.
    pub fn tabulate(&self, spectrum: &Spectrum) -> Vec<f32> {
        self.values(spectrum).into_iter().map(|value| value as f32).collect()
    }

    /// ∫ (x̄, ȳ, z̄) dλ over the cell of each node, nm: exact, so that what is flat in a cell counts exactly.
    pub fn observer_weights(&self, observer: &ColorMatching) -> Vec<Xyz> {
        let cell = |i: usize| {
            let mut sum = [0.0; 3];
            for (nm, width) in self.pieces(i, observer.y.wavelengths_nm()) {
                let value = observer.at(nm);
                (0..3).for_each(|c| sum[c] += width * value[c]);
            }
            sum
        };
        (0..NODE_COUNT).map(cell).collect()
    }

    /// XYZ of a spectrum by the nodes, without the factor 683: what a render of it converges to.
    pub fn tristimulus(&self, spectrum: &Spectrum, observer: &ColorMatching) -> Xyz {
        let mut sum = [0.0; 3];
        for (value, weight) in self.values(spectrum).into_iter().zip(self.observer_weights(observer)) {
            (0..3).for_each(|c| sum[c] += value * weight[c]);
        }
        sum
    }

    /// How far off what one set of [`LANES`] wavelengths tells of a light is: the variance of its XYZ over that of the whole,
    /// squared.
    pub fn variance(&self, light: &Spectrum, observer: &ColorMatching) -> f64 {
        let sets = NODE_COUNT / LANES;
        let mut told = vec![[0.0; 3]; sets];
        for (i, (value, weight)) in self.values(light).into_iter().zip(self.observer_weights(observer)).enumerate() {
            (0..3).for_each(|c| told[i % sets][c] += value * weight[c]);
        }
        let mean: Xyz = std::array::from_fn(|c| told.iter().map(|xyz| xyz[c]).sum::<f64>() / sets as f64);
        let squares = told.iter().flat_map(|xyz| (0..3).map(|c| (xyz[c] - mean[c]) * (xyz[c] - mean[c])));
        let whole: f64 = mean.iter().map(|value| value * value).sum();
        if whole > 0.0 { squares.sum::<f64>() / (sets as f64 * whole) } else { 0.0 }
    }

    /// A cell cut at sorted breakpoints: middle and width of each piece, nm. What is straight in between integrates
    /// exactly by these middles.
    fn pieces(&self, i: usize, breakpoints: &[f64]) -> impl Iterator<Item = (f64, f64)> {
        let (low, high) = (self.edges_nm[i], self.edges_nm[i + 1]);
        let first = breakpoints.partition_point(|&nm| nm <= low);
        let end = first + breakpoints[first..].partition_point(|&nm| nm < high);
        let inside = &breakpoints[first..end];
        (0..=inside.len()).map(move |piece| {
            let start = if piece == 0 { low } else { inside[piece - 1] };
            let end = inside.get(piece).copied().unwrap_or(high);
            (0.5 * (start + end), end - start)
        })
    }

    /// The nodes that a line's power goes to, with shares that sum to 1 and have the line as their mean.
    fn spread(&self, nm: f64) -> Vec<(usize, f64)> {
        let LineWidth { nm, half_width } = LineWidth::of(nm);
        let (low, high) = (nm - half_width, nm + half_width);
        let first = self.edges_nm.partition_point(|&edge| edge <= low).saturating_sub(1);
        let end = self.edges_nm.partition_point(|&edge| edge < high).min(NODE_COUNT);
        let overlap = |i: usize| self.edges_nm[i + 1].min(high) - self.edges_nm[i].max(low);
        let total: f64 = (first..end).map(overlap).sum();
        let mut shares: Vec<_> = (first..end).map(|i| (i, overlap(i) / total)).collect();
        let mean: f64 = shares.iter().map(|&(i, share)| share * self.wavelength_nm(i)).sum();
        let off = |i: usize| self.wavelength_nm(i) - mean;
        let variance: f64 = shares.iter().map(|&(i, share)| share * off(i) * off(i)).sum();
        // A tilt moves the mean onto the line.
        let tilt = (nm - mean) / variance;
        for (i, share) in &mut shares {
            *share *= 1.0 + tilt * off(*i);
        }
        let boxed = shares.len() > 4 && shares.iter().all(|(_, share)| *share >= 0.0);
        if boxed { shares } else { self.two_neighbours(nm) }
    }

    fn two_neighbours(&self, nm: f64) -> Vec<(usize, f64)> {
        let cell = self.edges_nm.partition_point(|&edge| edge <= nm).saturating_sub(1).min(NODE_COUNT - 1);
        let left = if nm < self.wavelength_nm(cell) { cell.saturating_sub(1) } else { cell };
        let right = (left + 1).min(NODE_COUNT - 1);
        let gap = self.wavelength_nm(right) - self.wavelength_nm(left);
        // In the outer half of the first and last cell there is one neighbour only.
        let t = if gap > 0.0 { ((nm - self.wavelength_nm(left)) / gap).clamp(0.0, 1.0) } else { 0.0 };
        vec![(left, 1.0 - t), (right, t)]
    }
}

#[cfg(test)]
mod tests {
    use super::super::density::of_lines;
    use super::*;

    #[test]
    fn cells_hold_equal_probability_and_fill_the_range() {
        for density in [Density::visible(), of_lines(&[435.833, 546.074, 576.96, 579.066, 589.3, 10.0])] {
            let nodes = Nodes::new(&density);
            let total: f64 = (0..NODE_COUNT).map(|i| nodes.weight_nm(i)).sum();
            assert!((total - 470.0).abs() < 1e-9);
            for i in 0..NODE_COUNT {
                let mass = density.cdf(nodes.edges_nm[i + 1]) - density.cdf(nodes.edges_nm[i]);
                assert!((mass * NODE_COUNT as f64 - 1.0).abs() < 1e-6, "cell {i}: {mass}");
                assert!(nodes.weight_nm(i) > 0.0);
            }
        }
    }

    /// A line counts what the observer sees of it, next to the ends of the range as anywhere, alone and beside a strong one.
    #[test]
    fn lines_at_the_ends_of_the_range_are_as_bright_as_elsewhere() {
        let observer = super::super::Library::new(Vec::new()).observer(super::super::Observer::Cie1931).unwrap();
        for nm in [360.0, 360.0002, 360.01, 360.03, 360.0499, 360.2, 829.8, 829.952, 829.99, 830.0] {
            for strong in [0.0, 1e4] {
                let lines = [Line { nm: 546.074, power: strong }, Line { nm, power: 1.0 }];
                let density = Density::following(&Spectrum::Lines(lines.to_vec()), &observer);
                let line = Spectrum::Lines(vec![lines[1]]);
                let (found, expected) = (Nodes::new(&density).tristimulus(&line, &observer), observer.at(nm));
                for (found, expected) in found.into_iter().zip(expected) {
                    assert!((found - expected).abs() <= 1e-4 * expected, "{nm}: {found} for {expected}");
                }
            }
        }
    }

    #[test]
    fn lines_keep_their_power_and_place() {
        let lines = [435.833, 546.074, 589.0, 589.6];
        for density in [Density::visible(), of_lines(&lines)] {
            let nodes = Nodes::new(&density);
            for nm in lines.into_iter().chain([365.0, 825.0, 600.0]) {
                let values = nodes.values(&Spectrum::Lines(vec![Line { nm, power: 3.0 }]));
                let power: f64 = values.iter().enumerate().map(|(i, v)| v * nodes.weight_nm(i)).sum();
                let mean: f64 =
                    values.iter().enumerate().map(|(i, v)| v * nodes.weight_nm(i) * nodes.wavelength_nm(i)).sum();
                assert!((power - 3.0).abs() < 1e-9 && (mean / 3.0 - nm).abs() < 1e-9, "{nm}: {power}, {mean}");
                assert!(values.iter().all(|&value| value >= 0.0));
            }
        }
    }
}
