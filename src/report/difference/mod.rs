//! Two pictures compared, with what of it is noise: from replicates of each that were rendered with independent seeds.
//!
//! Replicate r of both pictures has the same random numbers, so that their difference d_r is far less noisy than either picture.
//! The pictures are the means of their replicates. Of two noisy pictures any distance is too large: noise alone makes one. So
//!
//! - the mean ΔE2000 is given as measured, M, and beside it what noise alone gives: the same measure of a picture and itself
//!   plus Σ ±d_r / R with as many plus as minus signs, in which every true difference is gone and all of the noise is left;
//! - what is there beyond noise is asked of *different* replicates: T, the mean over the picture and over r of d_r · u₋ᵣ, with u₋ᵣ
//!   the direction of the mean difference of all others (in the metric of CIEDE2000 about the mean of both pictures).
//!   d_r and u₋ᵣ are independent: the expectation of T is no more than the true mean ΔE2000, 0 without a difference, and near
//!   the truth where each pixel's difference is above its noise. This is cross-validation (M. Stone, Journal of the Royal
//!   Statistical Society B 36 (1974)), as for distances of noisy patterns by A. Walther et al., NeuroImage 137 (2016);
//! - a mean of lengths is too long, not too short, in expectation (Jensen). So the truth lies between T and M, and the interval is
//!   from T to M and further by the jackknife's reach of each ([`super::jackknife`]). A picture is different if
//!   the interval does not touch 0, or if the 99 % interval of its energy leaves out 0: a change of all pixels that is small beside the
//!   noise of each shows in their sum only. What is no more than the rounding of single precision is none. Without a difference the jackknife's reach is about 1.5 times too wide (8 replicates; Efron &
//!   Stein 1981): false alarms are rarer than the nominal 3.5 % (`tests/it/report/compare_statistics.rs`).
//!
//! What no path has found is in no replicate. Where light comes by ways that nothing aims at, the interval of ΔE ends as much higher, begins
//! twice as much lower, and that of the energy is as much wider, as such light may change them ([`super::bound`]): a model has it or has it not.
//!
//! Limits: ΔE2000 is no norm, and L*a*b* bends: where a pixel's noise is as large as its colour, M may fall short by the bend.
//!
//! Pictures are compared as [`View`] shows them. RMSE and relMSE are of linear sRGB, the mean of (x − r)² and of
//! (x − r)² / (r² + 0.01) over pixels and channels.

mod sums;

use super::jackknife::Estimate;
use crate::film::{Unseen, View};
use crate::spectrum::{Xyz, ciede2000};
use rayon::prelude::*;
use serde::Serialize;
use sums::{Pixel, Sums, balanced, mean, sum_of_squares};

/// Mean XYZ in cd/m² of every pixel.
pub type Image = Vec<[f32; 3]>;

/// The fewest replicates that tell noise from difference.
pub const FEWEST: usize = 3;

/// What the replicates of two pictures say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Every sample is the same.
    Identical,
    /// Nothing beyond noise, neither in colours nor in energy.
    Indistinguishable,
    Different,
}

/// How far a picture is from another one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    pub verdict: Verdict,
    pub delta_e2000: DeltaE,
    /// Of linear sRGB.
    pub rmse: f64,
    /// What noise alone gives.
    pub rmse_noise: f64,
    pub rel_mse: f64,
    /// Mean luminance over the reference's, less 1.
    pub energy: Estimate,
    /// What light that no path has found may add to both intervals.
    pub missed: Missed,
}

/// What may have been missed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Missed {
    /// Mean ΔE2000.
    pub delta_e2000: f64,
    /// As [`Difference::energy`].
    pub energy: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DeltaE {
    /// Of the pictures as they are.
    pub mean: f64,
    pub percentile_95: f64,
    pub max: f64,
    /// What noise alone gives in the mean.
    pub noise: f64,
    /// The part of the mean on which independent replicates agree; without a difference it is about 0, of either sign.
    pub beyond_noise: f64,
    /// Where the mean of pictures without noise lies, with 95 % confidence.
    pub interval_95: [f64; 2],
}

/// How noisy one picture is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Noise {
    /// Of linear sRGB.
    pub rmse: f64,
    /// Mean ΔE2000.
    pub delta_e2000: f64,
}

/// A comparison and its maps, row by row.
#[derive(Clone, Debug)]
pub struct Compared {
    pub difference: Difference,
    /// ΔE2000.
    pub delta_e: Vec<f32>,
    /// Luminance less the reference's, relative to the display's white.
    pub luminance: Vec<f32>,
}

/// ΔE2000, a tenth of what an eye can just tell.
const INVISIBLE: f64 = 0.1;

/// Pixels that are summed up at a time, whatever the number of threads.
const CHUNK: usize = 1024;

/// Compares the replicates of a picture with those of a reference: as many, at least [`FEWEST`], of equal size, in which light may be missing.
pub fn compare(view: &View, reference: &[Image], picture: &[Image], unseen: &Unseen) -> Compared {
    let count = reference.first().map_or(0, Vec::len);
    let chunks: Vec<(Sums, Vec<[f32; 2]>)> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let mut sums = Sums::new(reference.len());
            let pixels = chunk * CHUNK..((chunk + 1) * CHUNK).min(count);
            let maps = pixels.map(|pixel| {
                let of = |replicates: &[Image]| replicates.iter().map(|image| view.display(image[pixel])).collect();
                sums.add(view, &Pixel::new(of(reference), of(picture)))
            });
            let maps = maps.collect();
            (sums, maps)
        })
        .collect();
    let mut sums = Sums::new(reference.len());
    chunks.iter().for_each(|(chunk, _)| sums.merge(chunk));
    let maps = || chunks.iter().flat_map(|(_, maps)| maps);
    let delta_e: Vec<f32> = maps().map(|map| map[0]).collect();
    let colors: Vec<_> = merged(reference).iter().map(|xyz| view.display(*xyz).map(|c| c as f32)).collect();
    let difference = sums.difference(&delta_e).allowing_for(view, &colors, unseen);
    Compared { difference, luminance: maps().map(|map| map[1]).collect(), delta_e }
}

impl Difference {
    /// Whether what no path may have found is more than a tenth of what was measured, and more than nobody sees.
    pub fn may_miss_much(&self) -> bool {
        self.missed.delta_e2000 > INVISIBLE.max(0.1 * self.delta_e2000.mean)
    }

    /// With intervals that hold the truth whatever no path has found; `colors` are the reference's, relative to display white.
    fn allowing_for(mut self, view: &View, colors: &[[f32; 3]], unseen: &Unseen) -> Self {
        if unseen.luminance() == 0.0 || self.verdict == Verdict::Identical {
            return self;
        }
        let luminance = colors.iter().map(|xyz| f64::from(xyz[1])).sum::<f64>() / colors.len() as f64;
        // Of a black reference no share is known.
        let energy = if luminance > 0.0 { unseen.luminance() / luminance } else { 0.0 };
        self.missed = Missed { delta_e2000: unseen.mean_de(view, colors), energy };
        // Light that both have lies over what differs: as much for each picture.
        let [low, high] = self.delta_e2000.interval_95;
        let missed = self.missed.delta_e2000;
        self.delta_e2000.interval_95 = [(low - 2.0 * missed).max(0.0), high + missed];
        let [low, high] = self.energy.interval_95;
        self.energy.interval_95 = [low - self.missed.energy, high + self.missed.energy];
        self
    }
}

/// How noisy the mean of replicates is.
pub fn noise(view: &View, replicates: &[Image]) -> Noise {
    let count = replicates.first().map_or(0, Vec::len);
    let chunks: Vec<[f64; 2]> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let pixels = chunk * CHUNK..((chunk + 1) * CHUNK).min(count);
            pixels.fold([0.0; 2], |[square, delta_e], pixel| {
                let shown: Vec<Xyz> = replicates.iter().map(|image| view.display(image[pixel])).collect();
                let (mean, noise) = (mean(&shown), balanced(&shown));
                let noisy = std::array::from_fn(|i| mean[i] + noise[i]);
                [square + sum_of_squares(view.rgb(noise)), delta_e + ciede2000(view.lab(mean), view.lab(noisy))]
            })
        })
        .collect();
    let [square, delta_e] = chunks.iter().fold([0.0; 2], |sum, chunk| [sum[0] + chunk[0], sum[1] + chunk[1]]);
    let pixels = count.max(1) as f64;
    Noise { rmse: (square / (3.0 * pixels)).sqrt(), delta_e2000: delta_e / pixels }
}

/// The mean of replicates.
pub fn merged(replicates: &[Image]) -> Image {
    let count = replicates.first().map_or(0, Vec::len);
    let at = |pixel: usize| {
        let all: Vec<Xyz> = replicates.iter().map(|image| image[pixel].map(f64::from)).collect();
        mean(&all).map(|c| c as f32)
    };
    (0..count).into_par_iter().map(at).collect()
}

/// Nearest rank: the smallest value that a fraction `p` of the values do not exceed.
fn percentile(values: &[f32], p: f64) -> f64 {
    let mut values = values.to_vec();
    let rank = libm::ceil(values.len() as f64 * p) as usize;
    let index = rank.clamp(1, values.len().max(1)) - 1;
    if index < values.len() { f64::from(*values.select_nth_unstable_by(index, f32::total_cmp).1) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::RgbSpace;

    /// XYZ of linear sRGB at an exposure of 0 EV and a white of D65, so that the display shows the RGB itself.
    fn xyz(rgb: [f64; 3]) -> [f32; 3] {
        RgbSpace::Srgb.xyz_from_rgb().apply(rgb).map(|c| c as f32)
    }

    fn view() -> View {
        View::new(0.0, RgbSpace::Srgb.white_xyz())
    }

    /// Four replicates of two pixels each.
    fn replicates(pixels: [[[f64; 3]; 2]; 4]) -> Vec<Image> {
        pixels.map(|pair| pair.map(xyz).to_vec()).to_vec()
    }

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() < 2e-6 * (1.0 + b.abs())
    }

    #[test]
    fn measures_without_noise_are_those_by_hand() {
        let grey = replicates([[[0.5; 3], [0.2; 3]]; 4]);
        let other = replicates([[[0.5, 0.6, 0.5], [0.2, 0.2, 0.5]]; 4]);
        let Compared { difference, delta_e, luminance } = compare(&view(), &grey, &other, &Unseen::NOTHING);
        let square = 0.1 * 0.1 + 0.3 * 0.3;
        assert!(near(difference.rmse, (square / 6.0_f64).sqrt()), "{difference:?}");
        let relative = 0.01 / 0.26 + 0.09 / 0.05;
        assert!(near(difference.rel_mse, relative / 6.0), "{difference:?}");
        let luminances = RgbSpace::Srgb.xyz_from_rgb().0[1];
        let gained = (0.1 * luminances[1] + 0.3 * luminances[2]) / 0.7;
        assert!(near(difference.energy.value, gained), "{difference:?}");
        assert!(near(f64::from(luminance[0]), 0.1 * luminances[1]));
        let lab = |rgb| view().lab(xyz(rgb).map(f64::from));
        let expected = [ciede2000(lab([0.5; 3]), lab([0.5, 0.6, 0.5])), ciede2000(lab([0.2; 3]), lab([0.2, 0.2, 0.5]))];
        assert!(delta_e.iter().zip(expected).all(|(found, expected)| near((*found).into(), expected)));
        assert!(near(difference.delta_e2000.mean, 0.5 * (expected[0] + expected[1])));
        assert!(near(difference.delta_e2000.max, expected[0].max(expected[1])));
        assert!(near(difference.delta_e2000.percentile_95, expected[0].max(expected[1])));
        assert_eq!((difference.rmse_noise, difference.delta_e2000.noise), (0.0, 0.0));
        assert_eq!(difference.verdict, Verdict::Different);
        assert!(difference.energy.interval_95.iter().all(|end| near(*end, gained)));
        let delta_e = &difference.delta_e2000;
        assert!(near(delta_e.beyond_noise, delta_e.mean));
        assert!(delta_e.interval_95.iter().all(|end| near(*end, delta_e.mean)));
    }

    #[test]
    fn the_same_is_identical_even_if_noisy() {
        let noisy =
            replicates([[[0.5; 3], [0.2; 3]], [[0.4; 3], [0.1; 3]], [[0.6; 3], [0.2; 3]], [[0.3; 3], [0.9; 3]]]);
        let difference = compare(&view(), &noisy, &noisy, &Unseen::NOTHING).difference;
        assert_eq!(difference.verdict, Verdict::Identical);
        let zero = Estimate { value: 0.0, interval_95: [0.0; 2] };
        assert_eq!((difference.delta_e2000.mean, difference.delta_e2000.max, difference.rmse), (0.0, 0.0, 0.0));
        assert_eq!((difference.energy, difference.delta_e2000.interval_95), (zero, [0.0; 2]));
    }

    /// Replicates ±0.1 about 0.5: Σ ± x / 4 = 0.1, of every channel and of one pixel in two.
    #[test]
    fn noise_is_that_of_the_mean() {
        let noisy =
            replicates([[[0.6; 3], [0.2; 3]], [[0.4; 3], [0.2; 3]], [[0.6; 3], [0.2; 3]], [[0.4; 3], [0.2; 3]]]);
        let found = noise(&view(), &noisy);
        assert!(near(found.rmse, (0.1_f64 * 0.1 / 2.0).sqrt()), "{found:?}");
        let lab = |grey: f64| view().lab(xyz([grey; 3]).map(f64::from));
        assert!(near(found.delta_e2000, 0.5 * ciede2000(lab(0.5), lab(0.6))), "{found:?}");
        assert!(merged(&noisy).iter().zip([0.5, 0.2]).all(|(found, grey)| near(found[1].into(), grey)));
    }
}
