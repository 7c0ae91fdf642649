//! PNG: grey, RGB or a palette, of 1 to 16 bits. The values are codes over the largest code.

use super::error::{Fault, array, room_for};
use super::{Encoding, Raster, Samples};
use png::{BitDepth, ColorType, Decoder, DecodingError, Limits, Transformations};
use std::fs::File;
use std::io::BufReader;

/// What a PNG may take beside its pixels, for tables and what it says of itself.
const CHUNK_BYTES: usize = 64 << 20;

/// At most: three channels as read, of two bytes, and as kept.
const BYTES_A_TEXEL: usize = 8 + 12;

pub(super) fn read(file: File, beside: usize) -> Result<Raster, Fault> {
    let mut decoder = Decoder::new_with_limits(BufReader::new(file), Limits { bytes: CHUNK_BYTES });
    // Grey of few bits and palettes become whole bytes.
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let size = decoder.read_header_info().map_err(fault)?.size();
    let [width, height] = [size.0, size.1].map(u64::from);
    room_for(width, height, BYTES_A_TEXEL + beside)?;
    let mut reader = decoder.read_info().map_err(fault)?;
    let length = reader.output_buffer_size().ok_or_else(|| Fault::new("the picture is too large"))?;
    let mut bytes = array(0u8, length, [width, height])?;
    let frame = reader.next_frame(&mut bytes).map_err(fault)?;
    bytes.truncate(frame.buffer_size());
    let codes: Vec<f32> = match frame.bit_depth {
        BitDepth::Sixteen => {
            bytes.chunks_exact(2).map(|b| f32::from(u16::from_be_bytes([b[0], b[1]])) / 65535.0).collect()
        }
        _ => bytes.iter().map(|&code| f32::from(code) / 255.0).collect(),
    };
    let samples = match frame.color_type.samples() {
        1 | 2 => Samples::Grey(codes.chunks_exact(frame.color_type.samples()).map(|texel| texel[0]).collect()),
        channels => {
            let color = |texel: &[f32]| [texel[0], texel[1], texel[2]];
            Samples::Rgb(codes.chunks_exact(channels).map(color).collect())
        }
    };
    let alpha = matches!(frame.color_type, ColorType::GrayscaleAlpha | ColorType::Rgba);
    Ok(Raster {
        width: size.0,
        height: size.1,
        samples,
        encoding: Encoding::Codes,
        chromaticities: None,
        notes: if alpha { vec!["its alpha is ignored".into()] } else { Vec::new() },
    })
}

fn fault(error: DecodingError) -> Fault {
    Fault::new(match error {
        DecodingError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            "the PNG ends in the middle".to_owned()
        }
        error => format!("this is no PNG that can be read: {error}"),
    })
}
