//! A picture in memory, as its file gave it.

use super::{Codes, Curve};
use crate::spectrum::Chromaticities;

/// A picture: rows from the top, each from the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    pub width: u32,
    pub height: u32,
    pub samples: Samples,
    /// How the codes of red, green and blue become light, where the file states it.
    pub curves: Option<[Curve; 3]>,
    /// Of R, G and B, where the file states them.
    pub chromaticities: Option<Chromaticities>,
    /// Of (1, 1, 1), cd/m², where the file states it.
    pub white_luminance: Option<f64>,
    /// What a person should know of how it was read.
    pub notes: Vec<String>,
}

/// The channels of a picture that are kept.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    Grey(Vec<f32>),
    Rgb(Vec<[f32; 3]>),
    Codes(Codes),
}

/// What the numbers are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// In proportion to light, any size.
    Linear,
    /// Codes of a display over their largest, 0…1: what curve they follow is not in the numbers.
    Codes,
}

impl Raster {
    pub fn encoding(&self) -> Encoding {
        match self.samples {
            Samples::Grey(_) | Samples::Rgb(_) => Encoding::Linear,
            Samples::Codes(_) => Encoding::Codes,
        }
    }

    /// R, G and B of all texels.
    pub fn into_rgb(self) -> Vec<[f32; 3]> {
        use rayon::prelude::*;
        match self.samples {
            Samples::Grey(values) => values.into_iter().map(|value| [value; 3]).collect(),
            Samples::Rgb(values) => values,
            Samples::Codes(codes) => codes.colors().map(|color| color.map(|channel| channel as f32)).collect(),
        }
    }

    /// R, G and B of all texels, the infinite as the largest finite value of all, and how many texels had one.
    pub fn into_finite_rgb(self) -> (Vec<[f32; 3]>, usize) {
        let mut rgb = self.into_rgb();
        let endless = |texel: &[f32; 3]| texel.contains(&f32::INFINITY);
        let count = rgb.iter().filter(|texel| endless(texel)).count();
        if count > 0 {
            let largest = rgb.iter().flatten().copied().filter(|value| value.is_finite()).fold(0.0, f32::max);
            let finite = |value: &mut f32| *value = if *value == f32::INFINITY { largest } else { *value };
            rgb.iter_mut().flatten().for_each(finite);
        }
        (rgb, count)
    }
}
