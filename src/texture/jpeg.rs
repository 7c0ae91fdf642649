//! JPEG: grey or colour of 8 bits, baseline or progressive. The values are codes over 255.
//!
//! What they mean is told by an ICC profile; without one they are sRGB's where they are colours. How a camera was held (Exif) is not
//! asked: the picture lies as its rows are stored. The decoder is used without instructions of one processor, so that all give the same.

use super::error::{Fault, array, room_for};
use super::stated::Stated;
use super::{Codes, Raster, Samples};
use std::fs::File;
use std::io::{BufReader, Read};
use zune_jpeg::JpegDecoder;
use zune_jpeg::errors::DecodeErrors;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// The largest side that a file can state.
const SIDE: usize = 65_535;

/// At most what a texel's number of its colour takes, where it is kept instead of the colour.
const INDEX_BYTES: usize = 4;

/// Of a channel: its code, and its coefficient while a progressive picture is read.
const CHANNEL_BYTES: usize = 3;

pub(super) fn read(file: File, _beside: usize) -> Result<Raster, Fault> {
    let mut bytes = Vec::new();
    BufReader::new(file).read_to_end(&mut bytes).map_err(Fault::new)?;
    let options = DecoderOptions::default().set_max_width(SIDE).set_max_height(SIDE).set_strict_mode(true);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(&bytes), options);
    decoder.decode_headers().map_err(fault)?;
    let info = decoder.info().ok_or_else(|| Fault::new("the JPEG ends in the middle"))?;
    let (channels, space) = match info.components {
        1 => (1, ColorSpace::Luma),
        3 => (3, ColorSpace::RGB),
        4 => return Err(Fault::new("it has the four inks of print, CMYK: save it as RGB")),
        other => return Err(Fault::new(format!("it has {other} channels: grey has 1 and colour 3"))),
    };
    let [width, height] = [info.width, info.height].map(u64::from);
    let texels = room_for(width, height, CHANNEL_BYTES * channels + INDEX_BYTES)?;
    decoder.set_options(options.jpeg_set_out_colorspace(space));
    let mut codes = array(0u8, texels * channels, [width, height])?;
    decoder.decode_into(&mut codes).map_err(fault)?;
    let stated = decoder.icc_profile().map_or_else(Stated::default, |profile| Stated::by_profile(&profile));
    Ok(Raster {
        width: width as u32,
        height: height as u32,
        samples: Samples::Codes(Codes { channels, wide: false, bytes: codes }),
        curves: stated.curves,
        chromaticities: stated.chromaticities,
        white_luminance: None,
        notes: stated.notes,
    })
}

fn fault(error: DecodeErrors) -> Fault {
    Fault::new(match error {
        DecodeErrors::ExhaustedData | DecodeErrors::IoErrors(_) => "the JPEG ends in the middle".to_owned(),
        error => format!("this is no JPEG that can be read: {error}"),
    })
}
