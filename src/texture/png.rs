//! PNG: grey, RGB or a palette, of 1 to 16 bits. The values are codes over the largest code.
//!
//! What they mean is told by the first of the chunks cICP, iCCP, sRGB, and gAMA with cHRM that the file has (PNG, third
//! edition, section 4.3). A gAMA of 1/2.2 is how files without the other chunks say sRGB, as they are viewed everywhere.

use super::error::{Fault, array, room_for};
use super::stated::Stated;
use super::{Codes, Curve, Raster, Samples, code_points};
use crate::spectrum::{Chromaticities, RgbSpace};
use png::{BitDepth, CodingIndependentCodePoints, ColorType, Decoder, DecodingError, Info, Limits};
use png::{ScaledFloat, SourceChromaticities, Transformations};
use std::fs::File;
use std::io::BufReader;

/// What a PNG may take beside its pixels, for tables and what it says of itself.
const CHUNK_BYTES: usize = 64 << 20;

/// At most what a texel's number of its colour takes, where it is kept instead of the colour.
const INDEX_BYTES: usize = 4;

pub(super) fn read(file: File, beside: usize) -> Result<Raster, Fault> {
    let mut decoder = Decoder::new_with_limits(BufReader::new(file), Limits { bytes: CHUNK_BYTES });
    // Grey of few bits and palettes become whole bytes.
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    let info = decoder.read_header_info().map_err(fault)?;
    let [width, height] = [info.width, info.height].map(u64::from);
    room_for(width, height, bytes_a_texel(info, beside))?;
    let mut reader = decoder.read_info().map_err(fault)?;
    let length = reader.output_buffer_size().ok_or_else(|| Fault::new("the picture is too large"))?;
    let mut bytes = array(0u8, length, [width, height])?;
    let frame = reader.next_frame(&mut bytes).map_err(fault)?;
    bytes.truncate(frame.buffer_size());
    let mut stated = Stated::of(reader.info());
    if matches!(frame.color_type, ColorType::GrayscaleAlpha | ColorType::Rgba) {
        stated.notes.insert(0, "its alpha is ignored".into());
    }
    let wide = frame.bit_depth == BitDepth::Sixteen;
    Ok(Raster {
        width: width as u32,
        height: height as u32,
        samples: Samples::Codes(Codes { channels: frame.color_type.samples(), wide, bytes }),
        curves: stated.curves,
        chromaticities: stated.chromaticities,
        white_luminance: None,
        notes: stated.notes,
    })
}

/// As read, with room for an alpha, and as kept: colours of three channels of two bytes are kept one by one.
fn bytes_a_texel(info: &Info, beside: usize) -> usize {
    let color = matches!(info.color_type, ColorType::Rgb | ColorType::Rgba | ColorType::Indexed);
    match (color, info.bit_depth) {
        (true, BitDepth::Sixteen) => 8 + beside,
        (true, _) => 4 + INDEX_BYTES,
        (false, BitDepth::Sixteen) => 4 + 2,
        (false, _) => 2 + 1,
    }
}

impl Stated {
    fn of(info: &Info) -> Self {
        if let Some(points) = &info.coding_independent_code_points {
            return Self::by_number(points);
        }
        if let Some(profile) = &info.icc_profile {
            return Self::by_profile(profile);
        }
        if info.srgb.is_some() {
            return Self::in_space(Curve::Srgb, Some(RgbSpace::Srgb.chromaticities()));
        }
        let curves = info.gama_chunk.map(|gamma| [(); 3].map(|()| power(gamma)));
        Self { curves, chromaticities: info.chrm_chunk.map(chromaticities), notes: Vec::new() }
    }

    fn by_number(points: &CodingIndependentCodePoints) -> Self {
        let (curve, primaries) = (points.transfer_function, points.color_primaries);
        let (known, chromaticities) = (code_points::curve(curve), code_points::primaries(primaries));
        let mut notes = Vec::new();
        if known.is_none() {
            notes.push(format!(
                "its chunk cICP names the curve {curve}, which is none of surfaces: read by that of sRGB"
            ));
        }
        if chromaticities.is_none() {
            notes
                .push(format!("its chunk cICP names the primaries {primaries}, which are not known: taken for sRGB's"));
        }
        if !points.is_video_full_range_image {
            notes.push("its chunk cICP says that black and white are not its first and last code: taken as if".into());
        }
        Self { notes, ..Self::in_space(known.unwrap_or(Curve::Srgb), chromaticities) }
    }
}

/// 1/2.2, in the units of gAMA.
const GAMMA_OF_SRGB: u32 = 45455;

fn power(gamma: ScaledFloat) -> Curve {
    match gamma.into_scaled() {
        0 | GAMMA_OF_SRGB => Curve::Srgb,
        scaled => Curve::Power(100_000.0 / f64::from(scaled)),
    }
}

fn chromaticities(stated: SourceChromaticities) -> Chromaticities {
    let xy = |(x, y): (ScaledFloat, ScaledFloat)| [x, y].map(|value| f64::from(value.into_scaled()) / 100_000.0);
    let primaries_xy = [stated.red, stated.green, stated.blue].map(xy);
    Chromaticities { primaries_xy, white_xy: xy(stated.white) }
}

fn fault(error: DecodingError) -> Fault {
    Fault::new(match error {
        DecodingError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            "the PNG ends in the middle".to_owned()
        }
        error => format!("this is no PNG that can be read: {error}"),
    })
}
