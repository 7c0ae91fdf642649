//! How far each pixel of a picture is from the one without noise, as its replicates tell; [`super::bound`] makes promises of it.
//!
//! A pixel is the mean m of R replicates mᵣ, rendered with nets of their own; the covariance of m is C = Σ (mᵣ − m)(mᵣ − m)ᵀ / (R (R − 1)).
//!
//! - ΔE: the root mean square of CIEDE2000 to first order, √tr(M C̄ Mᵀ) with its metric M at the pixel's colour (`spectrum::ciede2000_metric`) as
//!   [`View`] shows it. C̄ is the mean of C over 3 × 3 pixels: a light that one path in many finds is missing in most pixels' replicates, which
//!   then know nothing of what they miss; their neighbours do.
//! - RMSE: of linear sRGB, the mean of the channels' variances.

use super::pilot::Pilot;
use crate::film::{Replicates, View};
use crate::spectrum::{Matrix3, Xyz, ciede2000_metric};
use rayon::prelude::*;

/// Pixels to each side whose covariances are averaged.
const REACH: usize = 1;

/// Caustics hold half of the error in one pixel in a hundred; in fewer than this it is single samples.
const FEW: usize = 1000;

/// The noise of a picture, pixel by pixel, row by row. Of no pixels, as in half of a single one, it is 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// Root mean square ΔE2000 against the picture without noise.
    pub de: Vec<f32>,
    /// Mean square error of linear sRGB, mean of the channels.
    pub squares: Vec<f32>,
    /// XYZ relative to display white.
    pub colors: Vec<[f32; 3]>,
    /// Pixels that share one covariance.
    pub sharing: f64,
}

/// The covariance of a pixel's mean, relative to display white: xx, yy, zz, xy, yz, zx.
type Covariance = [f32; 6];

impl Noise {
    /// Of rows of `width` pixels; one with fewer than two replicates makes everything infinite.
    pub fn of(replicates: &[Replicates], width: usize, view: &View) -> Self {
        let side = (2 * REACH + 1) as f64;
        Self::among(&all(replicates, view), width, view, side * side, |_, _| true)
    }

    /// Of each pixel by itself alone.
    pub fn of_each(replicates: &[Replicates], width: usize, view: &View) -> Self {
        Self::among(&all(replicates, view), width, view, 1.0, |at, other| at == other)
    }

    /// Of each pixel by itself alone, as if parts of the pilot were independent of each other. Together they err less, but enough is told to compare
    /// pixels by.
    pub fn of_pilot(pilot: &Pilot, width: usize, view: &View) -> Self {
        let pixels: Vec<_> = pilot.means().map(|means| moments(means, view)).collect();
        Self::among(&pixels, width, view, 1.0, |at, other| at == other)
    }

    /// Of the pixels of one [`half`], by themselves alone, if they had as many samples as those of the other half beside them. So it says
    /// of these what it would say however many samples its own pixels had.
    pub fn of_half(replicates: &[Replicates], counts: &[u64], width: usize, view: &View, which: usize) -> Self {
        let in_it = |at: usize| half(at, width) == which;
        let of = |(at, pixel): (usize, &Replicates)| {
            if !in_it(at) {
                return Default::default();
            }
            let (mean, covariance) = moments(pixel.means(), view);
            let more = beside(counts, width, at) * counts[at] as f64;
            (mean, covariance.map(|c| (f64::from(c) * more) as f32))
        };
        let pixels: Vec<_> = replicates.par_iter().enumerate().map(of).collect();
        // Of 3 × 3 pixels those that touch by corners.
        Self::among(&pixels, width, view, 5.0, |at, other| in_it(at) && in_it(other))
    }

    /// How many pixels hold half of the squared error, if these are one in [`FEW`] at most.
    pub fn held(&self) -> Option<usize> {
        let mut squares = self.squares.clone();
        squares.sort_unstable_by(|a, b| b.total_cmp(a));
        let middle = 0.5 * squares.iter().map(|square| f64::from(*square)).sum::<f64>();
        let sums = squares.iter().scan(0.0, |sum, square| {
            *sum += f64::from(*square);
            Some(*sum)
        });
        let pixels = sums.take_while(|sum| *sum < middle).count() + 1;
        (middle > 0.0 && middle.is_finite() && pixels * FEW <= squares.len()).then_some(pixels)
    }

    /// Of pixels that speak for themselves, and by which of their neighbours.
    fn among(
        pixels: &[(Xyz, Covariance)],
        width: usize,
        view: &View,
        sharing: f64,
        speaks: impl Fn(usize, usize) -> bool + Sync,
    ) -> Self {
        let de = |at: usize| {
            let (mean, around) = (pixels[at].0, around(pixels, width, at, |other| speaks(at, other)));
            let metric = ciede2000_metric(view.lab(mean)).after(&view.lab_slope(mean));
            trace(&metric, &around).sqrt() as f32
        };
        let square = |at: usize| {
            let squares = trace(&view.rgb_from_display(), &pixels[at].1.map(f64::from));
            (squares / 3.0) as f32
        };
        let chosen = || (0..pixels.len()).into_par_iter().filter(|at| speaks(*at, *at));
        let color = |at: usize| pixels[at].0.map(|c| c as f32);
        let [de, squares] = [chosen().map(de).collect(), chosen().map(square).collect()];
        Self { de, squares, colors: chosen().map(color).collect(), sharing }
    }
}

/// The halves of a picture, like the fields of a chessboard: what is decided about one is decided by the other.
pub fn half(at: usize, width: usize) -> usize {
    (at % width + at / width) % 2
}

/// Mean of 1/n over the pixels beside one, or its own where there is no other.
fn beside(counts: &[u64], width: usize, at: usize) -> f64 {
    let x = at % width;
    let left = (x > 0).then(|| at - 1);
    let right = (x + 1 < width).then(|| at + 1);
    let (mut sum, mut count) = (0.0, 0.0);
    for other in [left, right, at.checked_sub(width), Some(at + width)].into_iter().flatten() {
        if let Some(samples) = counts.get(other) {
            sum += 1.0 / *samples as f64;
            count += 1.0;
        }
    }
    if count > 0.0 { sum / count } else { 1.0 / counts[at] as f64 }
}

fn all(replicates: &[Replicates], view: &View) -> Vec<(Xyz, Covariance)> {
    replicates.par_iter().map(|pixel| moments(pixel.means(), view)).collect()
}

/// A pixel's mean as a display shows it, and the covariance of that mean, from independent means.
fn moments(means: impl Iterator<Item = Xyz>, view: &View) -> (Xyz, Covariance) {
    let means: Vec<Xyz> = means.map(|mean| view.display_f64(mean)).collect();
    let count = means.len() as f64;
    if means.len() < 2 {
        return ([0.0; 3], [f32::INFINITY; 6]);
    }
    let mean: Xyz = std::array::from_fn(|c| means.iter().map(|xyz| xyz[c]).sum::<f64>() / count);
    let mut sums = [0.0; 6];
    for xyz in &means {
        let [x, y, z]: Xyz = std::array::from_fn(|c| xyz[c] - mean[c]);
        let products = [x * x, y * y, z * z, x * y, y * z, z * x];
        (0..6).for_each(|i| sums[i] += products[i]);
    }
    (mean, sums.map(|sum| (sum / (count * (count - 1.0))) as f32))
}

/// The mean covariance of a pixel and those around it that are in.
fn around(pixels: &[(Xyz, Covariance)], width: usize, at: usize, is_in: impl Fn(usize) -> bool) -> [f64; 6] {
    let (x, y, height) = (at % width, at / width, pixels.len() / width);
    let (mut sum, mut count) = ([0.0; 6], 0.0);
    for j in y.saturating_sub(REACH)..=(y + REACH).min(height - 1) {
        let row = j * width + x.saturating_sub(REACH)..=j * width + (x + REACH).min(width - 1);
        for at in row.filter(|at| is_in(*at)) {
            (0..6).for_each(|i| sum[i] += f64::from(pixels[at].1[i]));
            count += 1.0;
        }
    }
    sum.map(|sum| sum / count)
}

/// tr(M C Mᵀ), not below 0; infinite where nothing is known.
fn trace(matrix: &Matrix3, &[xx, yy, zz, xy, yz, zx]: &[f64; 6]) -> f64 {
    let row = |[a, b, c]: [f64; 3]| a * a * xx + b * b * yy + c * c * zz + 2.0 * (a * b * xy + b * c * yz + c * a * zx);
    let sum = matrix.0.into_iter().map(row).sum::<f64>();
    if sum.is_finite() { sum.max(0.0) } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_pixels_that_hold_half_of_the_error_are_counted() {
        let noise = |squares: Vec<f32>| Noise { de: vec![], squares, colors: vec![], sharing: 1.0 };
        let mut squares = vec![1e-3; 4000];
        assert_eq!(noise(squares.clone()).held(), None, "every pixel alike");
        squares[7] = 3.0;
        squares[900] = 2.0;
        assert_eq!(noise(squares.clone()).held(), Some(2), "3 of 9 are less than half, 5 are more");
        squares.truncate(1000);
        assert_eq!(noise(squares).held(), Some(1));
        assert_eq!(noise(vec![0.0; 4000]).held(), None);
    }

    /// What a half says depends on how many samples the other half has, and on nothing that its own number decides: its covariance falls as
    /// its samples grow.
    #[test]
    fn a_half_speaks_of_as_many_samples_as_its_neighbours_have() {
        let view = View::new(0.0, [0.95, 1.0, 1.09]);
        let mut pixel = Replicates::default();
        (0..16).for_each(|i| pixel.add(i % 8, [1.0, 1.0 + 0.1 * (i % 8) as f32, 1.0]));
        // Squares of the pixels of the second half among 2 × 2, beside pixels of these numbers of samples.
        let squares = |counts: [u64; 4]| Noise::of_half(&[pixel; 4], &counts, 2, &view, 1).squares;
        let same = squares([16; 4]);
        assert_eq!(same, Noise::of(&[pixel; 4], 2, &view).squares[..2]);
        let close = |found: Vec<f32>, times: f32| {
            found
                .iter()
                .zip(&same)
                .for_each(|(a, b)| assert!((a / b / times - 1.0).abs() < 1e-6, "{found:?} {same:?}"));
        };
        // 1/8 and 1/24 are 1/12 in the mean.
        close(squares([8, 16, 16, 24]), 16.0 / 12.0);
        close(squares([16, 32, 32, 16]), 2.0);
    }
}
