//! From the colours of a picture to spectra: the fit of `upsample` in a table, made when a scene has pictures.
//!
//! W. Jakob & J. Hanika (2019), section 4: for each channel that can be the largest, coefficients over that channel and
//! the ratios of the other two to it, linear between the nodes. Here with two changes. What is kept is the difference to
//! the grey of the largest channel, so grey is exact; and between levels of the largest channel coefficients are linear
//! not in the channel but in the argument of its grey, (2z − 1)/(2 √(z − z²)), by which they grow towards black and white:
//! that alone brought the largest error from ΔE 97 to 1. Darker colours than the lowest level are that level, scaled.
//!
//! - Radiance: one level, 1/2, and a factor of twice the largest channel. Reflectance: [`LEVELS`] levels, linear sRGB.
//! - Cost: 0.05 s for radiance, 0.13 s for reflectance, once (two cores).
//! - Error, ΔE2000 of RGB → spectrum → RGB under D65 over 3,000 random colours (`tests/it/spectrum/color.rs`):
//!
//! | | mean | 99 % | largest |
//! |---|---|---|---|
//! | reflectance, sRGB | 0.07 | 0.2 | 1.0 |
//! | radiance, sRGB | 0.004 | 0.04 | 0.4 |
//! | radiance, Display P3 | 0.009 | 0.09 | 2.3 |
//! | radiance, Rec. 2020 | 0.02 | 0.2 | 3.7 |
//! | radiance, ACEScg | 0.04 | 1.2 | 5.0 |
//!
//! The large ones are colours beside the corners of wide spaces, some of which no light has; the direct fit misses them
//! by up to 4.

use super::{Library, RgbSpace, Sigmoid, SpectrumError, Tint, Upsampler};
use rayon::prelude::*;

/// Levels of the largest channel for reflectances, and the ends of their range.
const LEVELS: usize = 24;
const DARKEST: f64 = 1.0 / 64.0;
const BRIGHTEST: f64 = 1.0 - 1.0 / 16384.0;
/// Levels stand evenly in the inverse hyperbolic sine of the grey's argument over this: densest where things change most.
const WARP: f64 = 0.3;

/// Nodes of each ratio.
const REFLECTANCE_RATIOS: usize = 32;
const RADIANCE_RATIOS: usize = 64;

/// Where no smooth spectrum reaches a colour, coefficients grow without end, and what lies between two such nodes is far
/// from both. Bounded by this the largest error in ACEScg falls from 27 to 5, and sRGB keeps its own.
const LARGEST: f64 = 1000.0;

/// Fits stop at this squared error: 1e-7 of white.
const CLOSE: f64 = 1e-14;

/// Coefficients by colour.
pub struct UpsampleTable {
    levels: Vec<f64>,
    ratios: usize,
    /// By largest channel, level, and the ratios of the two channels that follow it.
    nodes: Vec<[f32; 3]>,
    /// A reflectance is never scaled up.
    largest_scale: f64,
}

impl UpsampleTable {
    /// For radiances in linear RGB of a space, of any strength; white is 1 at every wavelength.
    pub fn for_radiance(library: &Library, space: RgbSpace) -> Result<Self, SpectrumError> {
        Self::new(Upsampler::for_space(library, space)?, vec![0.5], RADIANCE_RATIOS, f64::INFINITY)
    }

    /// For reflectances in linear sRGB, 0…1; white is 0.99994.
    pub fn for_reflectance(library: &Library) -> Result<Self, SpectrumError> {
        Self::new(Upsampler::new(library)?, levels(), REFLECTANCE_RATIOS, 1.0)
    }

    fn new(upsampler: Upsampler, levels: Vec<f64>, ratios: usize, largest_scale: f64) -> Result<Self, SpectrumError> {
        let fits = Fits { upsampler: upsampler.coarse(), levels: &levels, ratios };
        let lines: Vec<_> = (0..3).flat_map(|channel| (0..ratios).map(move |i| (channel, i))).collect();
        let fitted: Vec<_> = lines.par_iter().map(|&(channel, i)| fits.line(channel, i)).collect();
        let nodes = (0..3 * levels.len() * ratios * ratios).map(|index| {
            let (plane, i, j) = (index / (ratios * ratios), index / ratios % ratios, index % ratios);
            let (channel, level) = (plane / levels.len(), plane % levels.len());
            fitted[channel * ratios + i][level * ratios + j]
        });
        Ok(Self { nodes: nodes.collect(), levels, ratios, largest_scale })
    }

    /// The spectrum of a colour; channels are finite and not negative.
    pub fn tint(&self, rgb: [f32; 3]) -> Tint {
        let rgb = rgb.map(f64::from);
        let channel = largest(rgb);
        let strength = rgb[channel];
        if strength <= 0.0 {
            return Tint::BLACK;
        }
        let level = strength.clamp(self.levels[0], self.levels[self.levels.len() - 1]);
        let ratios = [1, 2].map(|next| rgb[(channel + next) % 3] / strength);
        Tint {
            coefficients: self.coefficients(channel, level, ratios).map(|c| c as f32),
            scale: (strength / level).min(self.largest_scale) as f32,
        }
    }

    fn coefficients(&self, channel: usize, level: f64, ratios: [f64; 2]) -> [f64; 3] {
        let [(i, x), (j, y)] = ratios.map(|ratio| cell(ratio * (self.ratios - 1) as f64, self.ratios));
        let grey = argument(level);
        let plane = |k: usize| {
            let first = ((channel * self.levels.len() + k) * self.ratios + i) * self.ratios + j;
            let [a, b] = [first, first + self.ratios].map(|at| mix(self.nodes[at], self.nodes[at + 1], y));
            mix(a, b, x)
        };
        let [c0, c1, c2] = match self.levels.len() {
            1 => plane(0).map(f64::from),
            count => {
                let k = self.levels.partition_point(|below| *below <= level).clamp(1, count - 1) - 1;
                let [low, high] = [k, k + 1].map(|k| argument(self.levels[k]));
                mix(plane(k), plane(k + 1), (grey - low) / (high - low)).map(f64::from)
            }
        };
        [c0, c1, c2 + grey]
    }
}

/// The largest channel.
fn largest(rgb: [f64; 3]) -> usize {
    (0..3).fold(0, |best, channel| if rgb[channel] > rgb[best] { channel } else { best })
}

/// The cell of a grid of `count` nodes, and where in it.
fn cell(position: f64, count: usize) -> (usize, f64) {
    let cell = (position as usize).min(count - 2);
    (cell, position - cell as f64)
}

fn mix<T: Copy + Into<f64>>(a: [T; 3], b: [T; 3], t: f64) -> [f32; 3] {
    std::array::from_fn(|i| (a[i].into() * (1.0 - t) + b[i].into() * t) as f32)
}

/// The argument of the sigmoid of a grey.
fn argument(grey: f64) -> f64 {
    Sigmoid::grey(grey).0[2]
}

fn levels() -> Vec<f64> {
    let [first, last] = [DARKEST, BRIGHTEST].map(|end| libm::asinh(argument(end) / WARP));
    let level = |k: usize| {
        let x = WARP * libm::sinh(first + (last - first) * k as f64 / (LEVELS - 1) as f64);
        0.5 + 0.5 * x / libm::sqrt(1.0 + x * x)
    };
    (0..LEVELS).map(level).collect()
}

/// The fits at the nodes, each begun at its neighbour's.
struct Fits<'a> {
    upsampler: Upsampler,
    levels: &'a [f64],
    ratios: usize,
}

impl Fits<'_> {
    /// All levels and second ratios at one first ratio, as differences to grey.
    fn line(&self, channel: usize, i: usize) -> Vec<[f32; 3]> {
        let (levels, last) = (self.levels, self.ratios - 1);
        let mut line = vec![[0.0; 3]; levels.len() * self.ratios];
        let middle = levels.partition_point(|level| *level < 0.5).min(levels.len() - 1);
        // From grey to the start of the line in steps of a node.
        let mut start = Sigmoid::grey(levels[middle]);
        for k in (i..last).rev() {
            start = self.fit(start, self.color(channel, middle, k, last));
        }
        for j in (0..self.ratios).rev() {
            if (i, j) == (last, last) {
                continue; // Grey differs from itself by nothing.
            }
            start = self.fit(start, self.color(channel, middle, i, j));
            let mut fit = start;
            let mut keep = |k: usize, from: Sigmoid| {
                let fit = self.fit(from, self.color(channel, k, i, j));
                let [c0, c1, c2] = fit.0;
                line[k * self.ratios + j] = [c0, c1, c2 - argument(levels[k])].map(|c| c as f32);
                fit
            };
            for k in middle..levels.len() {
                fit = keep(k, fit);
            }
            fit = start;
            for k in (0..middle).rev() {
                fit = keep(k, fit);
            }
        }
        line
    }

    fn color(&self, channel: usize, level: usize, i: usize, j: usize) -> [f64; 3] {
        let mut rgb = [self.levels[level]; 3];
        rgb[(channel + 1) % 3] *= i as f64 / (self.ratios - 1) as f64;
        rgb[(channel + 2) % 3] *= j as f64 / (self.ratios - 1) as f64;
        rgb
    }

    fn fit(&self, from: Sigmoid, rgb: [f64; 3]) -> Sigmoid {
        let fit = self.upsampler.fit(from, rgb, CLOSE);
        let size = fit.0.into_iter().map(f64::abs).fold(0.0, f64::max);
        if size > LARGEST { Sigmoid(fit.0.map(|c| c * LARGEST / size)) } else { fit }
    }
}
