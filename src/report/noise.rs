//! How far a picture is from the one without noise, as its replicates tell.
//!
//! A pixel is the mean m of R replicates mᵣ, rendered with nets of their own. If the replicates' errors are normal, s (mᵣ − m) with
//! s = 1/√(R − 1) is distributed as the error of m itself, for E (mᵣ − m)² = σ² (1 − 1/R) and Var m = σ²/R. So the colour differences
//! between m and m + s (mᵣ − m) say what those between m and the truth are like, without the truth.
//!
//! - Differences are of the developed picture: XYZ after exposure and white balance, CIELAB of display white (Y = 1), unclipped, CIEDE2000;
//!   root mean squares are of linear RGB, white being 1.
//! - A pixel's ΔE is the root mean square over its replicates. Its expectation is at least that of |ΔE| (Jensen), by 10–25 % for normal
//!   errors: what is promised of the mean is on the safe side.
//! - A promise holds with 95 %: what the pixels' spread leaves open (1.645 standard errors of their mean, pixels being independent) is
//!   added. Percentiles are read off all replicates' differences, higher by as many standard errors of the rank.
//! - What no replicate has met, such as a caustic found by one path in a million, no spread can tell.

use crate::film::{Develop, FilmError, REPLICATES, Replicates};
use crate::spectrum::{Matrix3, RgbSpace, Xyz, ciede2000, lab_from_xyz};
use rayon::prelude::*;

/// One-sided 95 % of a normal distribution, in standard deviations.
const CONFIDENCE: f64 = 1.645;

/// What the 95th percentile is of.
const PERCENTILE: f64 = 0.95;

/// From a film's XYZ to what a display shows.
#[derive(Clone, Copy, Debug)]
pub struct Viewing {
    to_display: Matrix3,
    rgb_from_xyz: Matrix3,
    white: Xyz,
}

impl Viewing {
    /// At the exposure `ev`, whatever `develop` says of it.
    pub fn new(develop: &Develop, ev: f64) -> Result<Self, FilmError> {
        let space = RgbSpace::Srgb;
        let rgb = Develop { space, ..develop.clone() }.matrix(ev)?;
        let (from_rgb, white) = (space.xyz_from_rgb(), space.white_xyz());
        Ok(Self { to_display: from_rgb.after(&rgb), rgb_from_xyz: space.rgb_from_xyz(), white })
    }

    fn lab(&self, display: Xyz) -> [f64; 3] {
        lab_from_xyz(display, self.white)
    }
}

/// The noise of a picture, pixel by pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// Root mean square ΔE2000 against the picture without noise.
    pub de: Vec<f32>,
    /// Mean square error of linear RGB, mean of the channels.
    pub squares: Vec<f32>,
    /// ΔE2000 of every replicate's share, in ascending order.
    all: Vec<f32>,
}

/// What a picture's error is, as estimated and as promised: below it with 95 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    pub estimate: f64,
    pub promised: f64,
}

impl Noise {
    /// Of pixels with at least two replicates; others have infinite noise.
    pub fn of(replicates: &[Replicates], viewing: &Viewing) -> Self {
        let pixels: Vec<_> = replicates.par_iter().map(|pixel| one(pixel, viewing)).collect();
        let mut all: Vec<f32> = pixels.iter().flat_map(|pixel| pixel.2.iter().copied()).collect();
        all.par_sort_unstable_by(f32::total_cmp);
        Self { de: pixels.iter().map(|p| p.0).collect(), squares: pixels.iter().map(|p| p.1).collect(), all }
    }

    /// Mean ΔE2000 over the picture.
    pub fn mean_de(&self) -> Bound {
        bound_of_mean(&self.de)
    }

    /// 95th percentile of ΔE2000 over the picture.
    pub fn de95(&self) -> Bound {
        let rank = |share: f64| {
            let last = self.all.len().saturating_sub(1);
            let place = libm::ceil(share * self.all.len() as f64) as usize;
            self.all.get(place.clamp(1, last + 1) - 1).copied().map_or(f64::INFINITY, f64::from)
        };
        let pixels = (self.de.len() as f64).max(1.0);
        let error = (PERCENTILE * (1.0 - PERCENTILE) / pixels).sqrt();
        Bound { estimate: rank(PERCENTILE), promised: rank(PERCENTILE + CONFIDENCE * error) }
    }

    /// Root mean square error of linear RGB.
    pub fn rmse(&self) -> Bound {
        let Bound { estimate, promised } = bound_of_mean(&self.squares);
        Bound { estimate: estimate.sqrt(), promised: promised.sqrt() }
    }
}

/// A pixel's ΔE, mean square error, and the ΔE of each replicate.
fn one(pixel: &Replicates, viewing: &Viewing) -> (f32, f32, [f32; REPLICATES]) {
    let means: Vec<Xyz> = pixel.means().map(|mean| viewing.to_display.apply(mean)).collect();
    let count = means.len() as f64;
    if means.len() < 2 {
        return (f32::INFINITY, f32::INFINITY, [f32::INFINITY; REPLICATES]);
    }
    let mean: Xyz = std::array::from_fn(|c| means.iter().map(|xyz| xyz[c]).sum::<f64>() / count);
    let (lab, scale) = (viewing.lab(mean), 1.0 / (count - 1.0).sqrt());
    let (mut de_squares, mut rgb_squares, mut each) = (0.0, 0.0, [0.0; REPLICATES]);
    for (slot, xyz) in each.iter_mut().zip(means.iter().cycle()) {
        let off: Xyz = std::array::from_fn(|c| (xyz[c] - mean[c]) * scale);
        let de = ciede2000(lab, viewing.lab(std::array::from_fn(|c| mean[c] + off[c])));
        *slot = de as f32;
        de_squares += de * de;
        rgb_squares += viewing.rgb_from_xyz.apply(off).iter().map(|x| x * x).sum::<f64>() / 3.0;
    }
    let count = REPLICATES as f64;
    ((de_squares / count).sqrt() as f32, (rgb_squares / count) as f32, each)
}

/// The mean of independent values, and what it is below with 95 %.
fn bound_of_mean(values: &[f32]) -> Bound {
    let count = (values.len() as f64).max(1.0);
    let estimate = values.iter().map(|value| f64::from(*value)).sum::<f64>() / count;
    let spread =
        values.iter().map(|value| (f64::from(*value) - estimate) * (f64::from(*value) - estimate)).sum::<f64>();
    Bound { estimate, promised: estimate + CONFIDENCE * (spread / (count * count)).sqrt() }
}
