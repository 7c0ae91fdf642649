//! What the numbers of a picture mean as colours: by what the scene says, or else the file.

use crate::scene::describe::{ColorSpaceName, TextureSpaceName};
use crate::spectrum::{Chromaticities, Matrix3, RgbSpace};
use crate::texture::{Curve, Encoding, Raster};

/// The gamma of Adobe RGB (1998), section 4.3.1.2: 2 and 51/256.
const ADOBE_GAMMA: f64 = 563.0 / 256.0;

/// From the numbers of a picture to linear sRGB.
pub struct Reading {
    curves: Option<[Curve; 3]>,
    matrix: Option<Matrix3>,
    /// Whether what the file says of its primaries makes no colours.
    pub odd: bool,
}

impl Reading {
    pub fn new(raster: &Raster, named: Option<TextureSpaceName>) -> Self {
        let codes = raster.encoding() == Encoding::Codes;
        let primaries = match named {
            // That a file of light says srgb of its curve leaves it its primaries.
            Some(TextureSpaceName::Srgb) if codes => None,
            None | Some(TextureSpaceName::Srgb | TextureSpaceName::Linear) => raster.chromaticities,
            Some(name) => name.space().map(ColorSpaceName::chromaticities),
        };
        let others = primaries.filter(|stated| stated.space() != Some(RgbSpace::Srgb));
        let matrix = others.and_then(|stated| stated.to(RgbSpace::Srgb));
        Self { curves: curves(raster, named, codes), matrix, odd: others.is_some() && matrix.is_none() }
    }

    pub fn linear_srgb(&self, mut rgb: [f64; 3]) -> [f64; 3] {
        if let Some(curves) = &self.curves {
            rgb = std::array::from_fn(|i| curves[i].decode(rgb[i]));
        }
        self.matrix.as_ref().map_or(rgb, |matrix| matrix.apply(rgb))
    }
}

/// `None` of what is in proportion to light.
fn curves(raster: &Raster, named: Option<TextureSpaceName>, codes: bool) -> Option<[Curve; 3]> {
    let same = |curve: Curve| Some([curve.clone(), curve.clone(), curve]);
    match named {
        Some(TextureSpaceName::Srgb) => same(Curve::Srgb),
        Some(TextureSpaceName::Linear | TextureSpaceName::AcesCg | TextureSpaceName::Aces2065) => None,
        _ if !codes => None,
        None => raster.curves.clone().or_else(|| same(Curve::Srgb)),
        Some(TextureSpaceName::DisplayP3) => same(Curve::Srgb),
        Some(TextureSpaceName::Rec2020) => same(Curve::Bt709),
        Some(TextureSpaceName::AdobeRgb) => same(Curve::Power(ADOBE_GAMMA)),
    }
}

impl ColorSpaceName {
    pub fn chromaticities(self) -> Chromaticities {
        match self {
            Self::Srgb => RgbSpace::Srgb.chromaticities(),
            Self::DisplayP3 => RgbSpace::DisplayP3.chromaticities(),
            Self::Rec2020 => RgbSpace::Rec2020.chromaticities(),
            Self::AdobeRgb => Chromaticities::ADOBE_RGB,
            Self::AcesCg => RgbSpace::AcesCg.chromaticities(),
            Self::Aces2065 => Chromaticities::ACES2065_1,
        }
    }
}

impl TextureSpaceName {
    /// Whose primaries it names.
    fn space(self) -> Option<ColorSpaceName> {
        match self {
            Self::Linear => None,
            Self::Srgb => Some(ColorSpaceName::Srgb),
            Self::DisplayP3 => Some(ColorSpaceName::DisplayP3),
            Self::Rec2020 => Some(ColorSpaceName::Rec2020),
            Self::AdobeRgb => Some(ColorSpaceName::AdobeRgb),
            Self::AcesCg => Some(ColorSpaceName::AcesCg),
            Self::Aces2065 => Some(ColorSpaceName::Aces2065),
        }
    }
}
