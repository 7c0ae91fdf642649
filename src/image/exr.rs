//! OpenEXR: every colour as it is.
//!
//! Three channels R, G, B of one part, scan lines, ZIP; what else there is stands beside them ([`super::channels`]). They hold
//!
//! - linear RGB of the development: `chromaticities` are those of its space, `whiteLuminance` = 2^EV, the luminance of
//!   RGB (1, 1, 1) in cd/m²; or
//! - XYZ in cd/m²: `chromaticities` (1, 0), (0, 1), (0, 0) with white (1/3, 1/3), `whiteLuminance` = 1. That is how
//!   the reference image Chromaticities/XYZ.exr of the OpenEXR project says it, and a reader that honours the attribute
//!   shows it right; channels named X, Y, Z would be shown as a grey picture, because Y alone means luminance.
//!
//! Both attributes together give back absolute XYZ from either file. `adoptedNeutral` is the xy that should look
//! neutral. `displayWindow` is the full image, `dataWindow` the crop. No dates.

use std::io::Cursor;

use exr::math::Vec2;
use exr::meta::attribute::{AttributeValue, Chromaticities, IntegerBounds, Text};
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, ImageAttributes, Layer,
    LayerAttributes, LineOrder, WritableImage, f16,
};

use super::exr_header::sort_attributes;
use super::{Encoded, ExrSpace, Extra, ImageError, Metadata, Options};
use crate::film::Developed;
use crate::spectrum::{RgbSpace, Xyz};

/// Lossless ZIP of 16 lines; lines in order, whatever thread compressed them first.
///
/// A megapixel of shading with 5 % noise in every pixel, the worst case (two cores; MB and ms, f32 and half): ZIP of 16
/// lines 11.9 and 3.5 in 207 and 122, PIZ 10.8 and 3.1 in 865 and 96, none 12.6 and 6.3 in 12 and 29. Noise in the
/// low bits of f32 hardly packs, but black backgrounds do, and every reader knows ZIP. Small files want `half`.
const ENCODING: Encoding =
    Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };

/// The EXR file of a picture, with `extra` beside it.
pub fn encode(
    developed: &Developed,
    extra: &Extra,
    options: &Options,
    metadata: &Metadata,
) -> Result<Encoded, ImageError> {
    let pixels = match options.exr_space {
        ExrSpace::Rgb => &developed.rgb,
        ExrSpace::Xyz => &developed.xyz,
    };
    let mut attributes = Attributes::new(developed, options.exr_space, metadata)?;
    let named = extra.attributes.iter().map(|(name, value)| (text(name), AttributeValue::Text(text(value))));
    attributes.layer.other.extend(named);
    let mut storage = Storage { half: options.half, beyond_half: 0 };
    let picture = [("R", 0), ("G", 1), ("B", 2)];
    let picture = picture.map(|(name, i)| storage.channel(name, false, pixels.iter().map(|pixel| pixel[i])));
    let others: Vec<_> =
        extra.channels.iter().map(|c| storage.channel(&c.name, c.full, c.values.iter().copied())).collect();
    let channels = picture.into_iter().chain(others).collect();
    Ok(Encoded { bytes: attributes.write(channels)?, beyond_half: storage.beyond_half })
}

/// How channels are stored, and what that cut off.
struct Storage {
    half: bool,
    beyond_half: u64,
}

impl Storage {
    fn channel(&mut self, name: &str, full: bool, values: impl Iterator<Item = f32>) -> AnyChannel<FlatSamples> {
        if full || !self.half {
            return AnyChannel::new(text(name), FlatSamples::F32(values.collect()));
        }
        let mut beyond = 0;
        let halves = values.inspect(|c| beyond += u64::from(c.abs() > HALF_MAX)).map(to_half).collect();
        self.beyond_half += beyond;
        AnyChannel::new(text(name), FlatSamples::F16(halves))
    }
}

const HALF_MAX: f32 = 65504.0;

/// Saturates: infinity would spread through every filter a reader applies.
fn to_half(channel: f32) -> f16 {
    f16::from_f32(channel.clamp(-HALF_MAX, HALF_MAX))
}

/// All of the file but its pixels.
struct Attributes {
    size: Vec2<usize>,
    image: ImageAttributes,
    layer: LayerAttributes,
}

impl Attributes {
    fn new(developed: &Developed, space: ExrSpace, metadata: &Metadata) -> Result<Self, ImageError> {
        let (window, [width, height]) = (developed.window, developed.image);
        let int = |n: u32| i32::try_from(n).map_err(|_| failed("the image has more than 2³¹ pixels on a side"));
        let (xy, luminance) = match space {
            ExrSpace::Rgb => (rgb_chromaticities(developed.space), libm::exp2(developed.ev) as f32),
            ExrSpace::Xyz => (xyz_chromaticities(), 1.0),
        };
        // RGB is balanced already; XYZ is neutral where the development would have made it so.
        let neutral = match space {
            ExrSpace::Rgb => xy.white,
            ExrSpace::Xyz => chromaticity(developed.white),
        };
        let display = Vec2(int(width)? as usize, int(height)? as usize);
        let mut image = ImageAttributes::new(IntegerBounds::from_dimensions(display));
        image.chromaticities = Some(xy);
        let layer = LayerAttributes {
            layer_position: Vec2(int(window.x0)?, int(window.y0)?),
            white_luminance: Some(luminance),
            adopted_neutral: Some(neutral),
            other: metadata.named().map(|(key, value)| (text(&key), AttributeValue::Text(text(value)))).collect(),
            ..LayerAttributes::default()
        };
        Ok(Self { size: Vec2(window.width as usize, window.height as usize), image, layer })
    }

    fn write(self, channels: Vec<AnyChannel<FlatSamples>>) -> Result<Vec<u8>, ImageError> {
        let channels = AnyChannels::sort(channels.into_iter().collect());
        let image = Image::new(self.image, Layer::new(self.size, self.layer, ENCODING, channels));
        let mut bytes = Cursor::new(Vec::new());
        // The library has threads of its own, one for each core.
        let write = if rayon::current_num_threads() == 1 { image.write().non_parallel() } else { image.write() };
        write.to_buffered(&mut bytes).map_err(|e| failed(&e.to_string()))?;
        let mut bytes = bytes.into_inner();
        sort_attributes(&mut bytes).ok_or_else(|| failed("the header is malformed"))?;
        Ok(bytes)
    }
}

fn failed(reason: &str) -> ImageError {
    ImageError::Encode { format: "EXR", reason: reason.to_string() }
}

/// UTF-8, as OpenEXR recommends for its strings.
fn text(value: &str) -> Text {
    Text::from_slice_unchecked(value.as_bytes())
}

fn rgb_chromaticities(space: RgbSpace) -> Chromaticities {
    let xy = |[x, y]: [f64; 2]| Vec2(x as f32, y as f32);
    let [red, green, blue] = space.primaries_xy().map(xy);
    Chromaticities { red, green, blue, white: xy(space.white_xy()) }
}

fn xyz_chromaticities() -> Chromaticities {
    let third = 1.0 / 3.0;
    Chromaticities { red: Vec2(1.0, 0.0), green: Vec2(0.0, 1.0), blue: Vec2(0.0, 0.0), white: Vec2(third, third) }
}

fn chromaticity([x, y, z]: Xyz) -> Vec2<f32> {
    let sum = x + y + z;
    Vec2((x / sum) as f32, (y / sum) as f32)
}
