//! Matt surfaces: what a file says of one, and what becomes of it.

use crate::scene::pictures::ImageTexture;
use crate::spectrum::SpectrumId;
use serde::Deserialize;
use toml::Spanned;

/// A matt surface that scatters alike in all directions (Lambert).
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Diffuse {
    pub reflectance: Spanned<ReflectanceSource>,
}

/// A data set's name or file, one value for all wavelengths, a linear sRGB colour to be upsampled, or a picture of colours.
#[derive(Debug)]
pub enum ReflectanceSource {
    Name(String),
    Constant(f64),
    Rgb([f64; 3]),
    Image(ImageTexture),
}

/// A matt surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matt {
    pub reflectance: SpectrumId,
}

impl Matt {
    /// Returns what it is, for people.
    pub fn describe(&self) -> String {
        "diffuse".to_owned()
    }
}
