//! A picture in memory, as its file gave it.

use crate::spectrum::Chromaticities;

/// A picture: rows from the top, each from the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    pub width: u32,
    pub height: u32,
    pub samples: Samples,
    pub encoding: Encoding,
    /// Of R, G and B, where the file states them.
    pub chromaticities: Option<Chromaticities>,
    /// What a person should know of how it was read.
    pub notes: Vec<String>,
}

/// The channels of a picture that are kept.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    Grey(Vec<f32>),
    Rgb(Vec<[f32; 3]>),
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
    /// R, G and B of all texels.
    pub fn into_rgb(self) -> Vec<[f32; 3]> {
        match self.samples {
            Samples::Grey(values) => values.into_iter().map(|value| [value; 3]).collect(),
            Samples::Rgb(values) => values,
        }
    }
}
