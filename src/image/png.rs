//! PNG: what a display can show, 8 or 16 bits a channel, encoded by the sRGB curve.
//!
//! Colours outside are mapped as the development says ([`Developed::display`]); the values are rounded to the nearest
//! code. No dither: path-traced pixels carry noise of about a code or more, which does the same service, and plain
//! rounding lets a test (or a colour checker) read back the value it expects. Where that is not enough, 16 bits are.
//!
//! Metadata are tEXt chunks, iTXt where they are not ASCII. The colour space is said in sRGB or cICP,
//! and in gAMA and cHRM for readers that know neither.

use png::chunk::ChunkType;
use png::{BitDepth, ColorType, Compression, Encoder, ScaledFloat, SourceChromaticities, SrgbRenderingIntent};

use super::{Bits, Encoded, ImageError, Metadata};
use crate::film::Developed;
use crate::spectrum::{RgbSpace, encode_srgb};

/// The PNG file of a picture.
pub fn encode(developed: &Developed, bits: Bits, metadata: &Metadata) -> Result<Encoded, ImageError> {
    let mut bytes = Vec::new();
    write(&mut bytes, developed, bits, metadata)
        .map_err(|e| ImageError::Encode { format: "PNG", reason: e.to_string() })?;
    Ok(Encoded { bytes, beyond_half: 0 })
}

/// The PNG file of pixels that are sRGB-encoded already, 8 bits a channel: maps, packed for speed rather than size.
pub fn encode_srgb8(width: u32, height: u32, pixels: &[u8]) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_compression(Compression::Fast);
    encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(pixels)?;
        writer.finish()
    });
    written.map_err(|e| ImageError::Encode { format: "PNG", reason: e.to_string() })?;
    Ok(bytes)
}

fn write(
    bytes: &mut Vec<u8>,
    developed: &Developed,
    bits: Bits,
    metadata: &Metadata,
) -> Result<(), png::EncodingError> {
    let mut encoder = Encoder::new(bytes, developed.width(), developed.height());
    encoder.set_color(ColorType::Rgb);
    set_space(&mut encoder, developed.space);
    for (key, value) in metadata.named() {
        add_text(&mut encoder, key, value)?;
    }
    let samples = match bits {
        Bits::Eight => {
            encoder.set_depth(BitDepth::Eight);
            codes(developed, 255.0).map(|code| code as u8).collect()
        }
        Bits::Sixteen => {
            encoder.set_depth(BitDepth::Sixteen);
            codes(developed, 65535.0).flat_map(|code| (code as u16).to_be_bytes()).collect::<Vec<u8>>()
        }
    };
    let mut writer = encoder.write_header()?;
    if let Some(primaries) = cicp_primaries(developed.space) {
        // The sRGB curve (13), no matrix, full range.
        writer.write_chunk(ChunkType(*b"cICP"), &[primaries, 13, 0, 1])?;
    }
    writer.write_image_data(&samples)?;
    writer.finish()
}

/// Encoded channels in order, as whole numbers up to `max`.
fn codes(developed: &Developed, max: f64) -> impl Iterator<Item = f64> {
    developed.display().flatten().map(move |linear| libm::round(encode_srgb(linear) * max))
}

/// The chunk sRGB where it is true, and gAMA and cHRM, which the PNG specification (11.3.2.5) recommends with it.
fn set_space<W: std::io::Write>(encoder: &mut Encoder<W>, space: RgbSpace) {
    if space == RgbSpace::Srgb {
        encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
    }
    encoder.set_source_gamma(ScaledFloat::from_scaled(45455));
    let xy = |[x, y]: [f64; 2]| (ScaledFloat::new(x as f32), ScaledFloat::new(y as f32));
    let [red, green, blue] = space.primaries_xy().map(xy);
    encoder.set_source_chromaticities(SourceChromaticities { white: xy(space.white_xy()), red, green, blue });
}

/// ColourPrimaries of ITU-T H.273 for spaces that the chunk sRGB does not name. AP1 has none; it leaves cHRM.
fn cicp_primaries(space: RgbSpace) -> Option<u8> {
    match space {
        RgbSpace::DisplayP3 => Some(12),
        RgbSpace::Rec2020 => Some(9),
        RgbSpace::Srgb | RgbSpace::AcesCg => None,
    }
}

fn add_text<W: std::io::Write>(encoder: &mut Encoder<W>, key: String, value: &str) -> Result<(), png::EncodingError> {
    if value.is_ascii() {
        encoder.add_text_chunk(key, value.to_string())
    } else {
        encoder.add_itxt_chunk(key, value.to_string())
    }
}
