//! What a scene file says of the pictures it takes light and colours from; a part of `describe`.

use super::lamps::LightSpectrum;
use super::numbers::{Number, Numbers};
use crate::texture::Wrap;
use serde::Deserialize;
use toml::Spanned;

/// A picture of all directions by longitude and latitude, twice as wide as high (EXR or Radiance HDR). Its middle is towards
/// +y, its top row straight up (+z), and who looks along +y sees it as it is: +x lies right of the middle. A texel's linear
/// RGB becomes a smooth spectrum (Jakob & Hanika 2019) times the illuminant: what is grey in the file has the illuminant's
/// spectrum.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EnvironmentImage {
    /// Beside the scene file.
    pub file: Spanned<String>,
    /// The light that is white in the file; D65 unless given.
    pub illuminant: Option<Spanned<LightSpectrum>>,
    /// cd/m² of a texel that is white, RGB (1, 1, 1); the `whiteLuminance` of an EXR, such as spectrel's own, or 1 unless given.
    pub scale: Option<Number>,
    /// Instead of `scale`: the mean over all directions, cd/m², by the Y of the file's RGB.
    pub luminance: Option<Number>,
    /// Degrees about +z, against the clock from above; 0 unless given.
    pub rotate: Option<Number>,
    /// What the file says unless given; sRGB primaries if it says nothing.
    pub color_space: Option<ColorSpaceName>,
}

/// Whose primaries the R, G and B of a file are. All are linear here.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum ColorSpaceName {
    /// Of sRGB and ITU-R BT.709.
    #[serde(alias = "rec709")]
    Srgb,
    /// Of Display P3; `p3` too.
    #[serde(alias = "p3")]
    DisplayP3,
    /// Of ITU-R BT.2020.
    #[serde(alias = "bt2020")]
    Rec2020,
    /// Of Adobe RGB (1998); `adobe` too.
    #[serde(alias = "adobe")]
    AdobeRgb,
    /// AP1, with the white of ACES; `ap1` too.
    #[serde(rename = "acescg", alias = "ap1")]
    AcesCg,
    /// AP0, with the white of ACES; `ap0` too.
    #[serde(rename = "aces2065-1", alias = "ap0")]
    Aces2065,
}

/// A picture on a surface (PNG, JPEG, EXR or Radiance HDR), u to its right and v upwards. Spheres have u around z and v from bottom to top by
/// angle, rectangles and disks the square around them. Between texels it is bilinear; smaller than pixels it is averaged by
/// the samples of a pixel.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageTexture {
    /// A file beside the scene file, or beside the material's own.
    pub image: Spanned<String>,
    /// How numbers become colours: as the file says unless given; `srgb` for a PNG or JPEG that says nothing, `linear` for the others.
    /// Roughness is data and has none.
    pub color_space: Option<Spanned<TextureSpaceName>>,
    /// How often the picture stands beside and above itself over u and v from 0 to 1; [1, 1] unless given.
    pub scale: Option<Numbers<2>>,
    #[serde(default)]
    pub wrap: WrapName,
}

/// How the numbers of a picture become colours.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum TextureSpaceName {
    /// Codes by the sRGB curve.
    #[serde(alias = "rec709")]
    Srgb,
    /// In proportion to light; of sRGB primaries unless the file says others.
    Linear,
    /// Codes of a PNG or JPEG by the sRGB curve, primaries of Display P3; `p3` too.
    #[serde(alias = "p3")]
    DisplayP3,
    /// Codes of a PNG or JPEG by the curve of ITU-R BT.2020, and its primaries.
    #[serde(alias = "bt2020")]
    Rec2020,
    /// Codes of a PNG or JPEG by the power 2.2 (563/256), primaries of Adobe RGB (1998); `adobe` too.
    #[serde(alias = "adobe")]
    AdobeRgb,
    /// In proportion to light, of AP1 with the white of ACES; `ap1` too.
    #[serde(rename = "acescg", alias = "ap1")]
    AcesCg,
    /// In proportion to light, of AP0 with the white of ACES; `ap0` too.
    #[serde(rename = "aces2065-1", alias = "ap0")]
    Aces2065,
}

/// What is beyond the edges of a picture.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum WrapName {
    /// The picture again; unless given.
    #[default]
    Repeat,
    /// The colours of its edges.
    Clamp,
}

impl From<WrapName> for Wrap {
    fn from(name: WrapName) -> Self {
        match name {
            WrapName::Repeat => Self::Repeat,
            WrapName::Clamp => Self::Clamp,
        }
    }
}
