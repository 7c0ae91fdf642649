//! How far a picture is from the one without noise, as its replicates tell.
//!
//! A pixel is the mean m of R replicates mᵣ, rendered with nets of their own; the covariance of m is C = Σ (mᵣ − m)(mᵣ − m)ᵀ / (R (R − 1)).
//!
//! - ΔE: the root mean square of CIEDE2000 to first order, √tr(M C̄ Mᵀ) with its metric M at the pixel's colour (`spectrum::ciede2000_metric`) as
//!   [`View`] shows it. C̄ is the mean of C over 3 × 3 pixels: a light that one path in many finds is missing in most pixels' replicates, which
//!   then know nothing of what they miss; their neighbours do.
//! - The mean ΔE over the picture is at most the mean of that (Jensen), by about 20 % for normal errors: what is promised is on the safe side.
//! - The 95th percentile is that of pixels whose ΔE is spread like |N(0, 1)|, which has the longest tail of those that normal errors make.
//! - RMSE: of linear sRGB, √ of the mean of the variances.
//! - A promise holds with 95 %: what the pixels' spread leaves open (1.645 standard errors; neighbours that share their C̄ count once) is
//!   added.
//!
//! What no replicate anywhere has met, such as a caustic found by one path in a million, no spread can tell.

use super::View;
use super::parts::Parts;
use crate::film::Replicates;
use crate::spectrum::{Matrix3, Xyz, ciede2000_metric};
use rayon::prelude::*;

/// One-sided 95 % of a normal distribution, in standard deviations.
const CONFIDENCE: f64 = 1.645;

/// What the 95th percentile is of.
const PERCENTILE: f64 = 0.95;

/// Pixels to each side whose covariances are averaged.
const REACH: usize = 1;

/// |N(0, 1)| at the middles of eight equally likely parts.
const HALF_NORMAL: [f64; 8] = [0.0784, 0.2372, 0.4023, 0.5791, 0.7764, 1.0100, 1.3180, 1.8627];

/// The noise of a picture, pixel by pixel, row by row. Of no pixels, as in half of a single one, it is 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// Root mean square ΔE2000 against the picture without noise.
    pub de: Vec<f32>,
    /// Mean square error of linear sRGB, mean of the channels.
    pub squares: Vec<f32>,
}

/// What a picture's error is, as estimated and as promised: below it with 95 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    pub estimate: f64,
    pub promised: f64,
}

/// The covariance of a pixel's mean, relative to display white: xx, yy, zz, xy, yz, zx.
type Covariance = [f32; 6];

impl Noise {
    /// Of rows of `width` pixels; one with fewer than two replicates makes everything infinite.
    pub fn of(replicates: &[Replicates], width: usize, view: &View) -> Self {
        Self::among(&all(replicates, view), width, view, |_, _| true)
    }

    /// Of each pixel by itself alone.
    pub fn of_each(replicates: &[Replicates], width: usize, view: &View) -> Self {
        Self::among(&all(replicates, view), width, view, |at, other| at == other)
    }

    /// Of each pixel by itself alone, as if parts were independent of each other. Together they err less, but enough is told to compare
    /// pixels by.
    pub fn of_parts(parts: &Parts, width: usize, view: &View) -> Self {
        let pixels: Vec<_> = parts.means().map(|means| moments(means, view)).collect();
        Self::among(&pixels, width, view, |at, other| at == other)
    }

    /// Of the pixels of one [`half`], by themselves alone.
    pub fn of_half(replicates: &[Replicates], width: usize, view: &View, which: usize) -> Self {
        let in_it = |at: usize| half(at, width) == which;
        Self::among(&all(replicates, view), width, view, |at, other| in_it(at) && in_it(other))
    }

    /// Of pixels that speak for themselves, and by which of their neighbours.
    fn among(
        pixels: &[(Xyz, Covariance)],
        width: usize,
        view: &View,
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
        Self { de: chosen().map(de).collect(), squares: chosen().map(square).collect() }
    }

    /// Mean ΔE2000 over the picture.
    pub fn mean_de(&self) -> Bound {
        bound_of_mean(&self.de, sharing())
    }

    /// 95th percentile of ΔE2000 over the picture.
    pub fn de95(&self) -> Bound {
        let spread = |de: &f32| HALF_NORMAL.map(|z| z * f64::from(*de));
        let mut all: Vec<f64> = self.de.par_iter().flat_map_iter(spread).collect();
        all.par_sort_unstable_by(f64::total_cmp);
        let at = |share: f64| {
            let place = libm::ceil(share * all.len() as f64) as usize;
            all.get(place.clamp(1, all.len().max(1)) - 1).copied().unwrap_or(0.0)
        };
        let pixels = (self.de.len() as f64).max(1.0);
        let error = (sharing() * PERCENTILE * (1.0 - PERCENTILE) / pixels).sqrt();
        Bound { estimate: at(PERCENTILE), promised: at(PERCENTILE + CONFIDENCE * error) }
    }

    /// Root mean square error of linear sRGB.
    pub fn rmse(&self) -> Bound {
        let Bound { estimate, promised } = bound_of_mean(&self.squares, 1.0);
        Bound { estimate: estimate.sqrt(), promised: promised.sqrt() }
    }
}

/// The halves of a picture, like the fields of a chessboard: what is decided about one is decided by the other.
pub fn half(at: usize, width: usize) -> usize {
    (at % width + at / width) % 2
}

/// Pixels that share one covariance.
fn sharing() -> f64 {
    let side = (2 * REACH + 1) as f64;
    side * side
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

/// The mean of values of which `sharing` count as one, and what it is below with 95 %.
fn bound_of_mean(values: &[f32], sharing: f64) -> Bound {
    let count = (values.len() as f64).max(1.0);
    let estimate = values.iter().map(|value| f64::from(*value)).sum::<f64>() / count;
    if !estimate.is_finite() {
        return Bound { estimate: f64::INFINITY, promised: f64::INFINITY };
    }
    let squares =
        values.iter().map(|value| (f64::from(*value) - estimate) * (f64::from(*value) - estimate)).sum::<f64>();
    Bound { estimate, promised: estimate + CONFIDENCE * (sharing * squares / (count * count)).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A promise of what nobody has measured would end a render before it has begun.
    #[test]
    fn what_is_not_known_is_not_promised() {
        let mut seen = Replicates::default();
        (0..16).for_each(|i| seen.add(i % 8, [1.0, 1.0, 1.0 + 0.01 * i as f32]));
        let view = View::new(0.0, [0.95, 1.0, 1.09]);
        let known = Noise::of(&[seen; 4], 2, &view);
        assert!(known.mean_de().promised > 0.0 && known.mean_de().promised < 10.0);
        let unknown = Noise::of(&[seen, seen, seen, Replicates::default()], 2, &view);
        for bound in [unknown.mean_de(), unknown.de95(), unknown.rmse()] {
            assert_eq!((bound.estimate, bound.promised), (f64::INFINITY, f64::INFINITY));
        }
        let nothing = Noise::of_half(&[seen], 1, &view, 1);
        assert_eq!((nothing.mean_de().promised, nothing.de95().promised, nothing.rmse().promised), (0.0, 0.0, 0.0));
    }
}
