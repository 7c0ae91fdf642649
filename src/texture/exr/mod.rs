//! OpenEXR: 16 or 32 bits, every compression that the crate `exr` knows (all but deep data). A picture is, of the first part
//! that has it, R, G and B; X, Y and Z; Y with RY and BY; Y or R alone; or R, G and B of a named layer. It is as large as the
//! display window, and black where the data window has none of it.

mod choice;
mod luminance_chroma;
mod sampled;
mod window;

use super::error::{Fault, room_for};
use super::{Raster, Samples};
use crate::spectrum::Chromaticities;
use choice::{Choice, Kind};
use exr::error::Error;
use exr::image::read::image::ReadImage;
use exr::meta::attribute::Chromaticities as Attribute;
use exr::meta::header::Header;
use exr::prelude::{ReadChannels, ReadLayers, ReadSpecificChannel, Vec2};
use std::fs::File;
use std::io::BufReader;

pub(super) fn read(file: File, beside: usize) -> Result<Raster, Fault> {
    let chunks = match exr::block::read(BufReader::new(&file), false) {
        Ok(chunks) => chunks,
        // Not of the library, but of the format: channels with fewer samples than the picture has texels.
        Err(Error::NotSupported(reason)) if reason.contains("subsampling") => return sampled(&file, beside),
        Err(error) => return Err(fault(error)),
    };
    let choice = Choice::of(chunks.headers())?;
    for Vec2(width, height) in chunks.headers().iter().map(|header| header.layer_size) {
        room_for(width as u64, height as u64, bytes_a_texel(&choice) + beside)?;
    }
    let header = chunks.headers()[choice.part].clone();
    let samples = match &choice.names[..] {
        [one] => Samples::Grey(grey(chunks, one)?),
        names => Samples::Rgb(three(chunks, names)?),
    };
    finish(samples, &header, choice, beside)
}

/// A picture of one part with channels of half the resolution.
fn sampled(file: &File, beside: usize) -> Result<Raster, Fault> {
    let (meta, input) = sampled::open(file)?;
    let choice = Choice::of(&meta.headers)?;
    let header = meta.headers[choice.part].clone();
    let Vec2(width, height) = header.layer_size;
    room_for(width as u64, height as u64, 4 * header.channels.list.len() + bytes_a_texel(&choice) + beside)?;
    let planes = sampled::planes(&meta, input, &choice)?;
    let samples = match <[Vec<f32>; 3]>::try_from(planes) {
        Ok([a, b, c]) => Samples::Rgb(a.into_iter().zip(b).zip(c).map(|((a, b), c)| [a, b, c]).collect()),
        Err(mut one) => Samples::Grey(one.pop().unwrap_or_default()),
    };
    finish(samples, &header, choice, beside)
}

/// A picture of what was read of its part.
fn finish(samples: Samples, header: &Header, choice: Choice, beside: usize) -> Result<Raster, Fault> {
    let stated = header.shared_attributes.chromaticities.map(chromaticities);
    let chromaticities = if choice.kind == Kind::Xyz { Some(Chromaticities::XYZ) } else { stated };
    let mut notes = choice.notes.clone();
    if header.channels.list.iter().any(|channel| channel.name.eq("A")) {
        notes.push("its alpha is ignored".into());
    }
    let samples = match samples {
        Samples::Rgb(pixels) if choice.kind == Kind::LuminanceChroma => {
            Samples::Rgb(luminance_chroma::to_rgb(pixels, stated)?)
        }
        samples => samples,
    };
    let (Vec2(width, height), samples) = window::place(samples, header, bytes_a_texel(&choice) + beside, &mut notes);
    let [width, height] = [width, height].map(|side| side as u32);
    let white = header.own_attributes.white_luminance.map(f64::from);
    let white_luminance = white.filter(|white| *white > 0.0 && white.is_finite());
    Ok(Raster { width, height, samples, curves: None, chromaticities, white_luminance, notes })
}

fn bytes_a_texel(choice: &Choice) -> usize {
    4 * choice.names.len()
}

type Chunks<'a> = exr::block::reader::Reader<BufReader<&'a File>>;

fn three(chunks: Chunks, names: &[String]) -> Result<Vec<[f32; 3]>, Fault> {
    let read = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required(names[0].as_str())
        .required(names[1].as_str())
        .required(names[2].as_str())
        .collect_pixels(
            |size, _| (size.0, vec![[0.0; 3]; size.area()]),
            |(width, pixels): &mut (usize, Vec<[f32; 3]>), at, (a, b, c): (f32, f32, f32)| {
                pixels[at.1 * *width + at.0] = [a, b, c];
            },
        )
        .first_valid_layer()
        .all_attributes();
    let image = as_parallel_as_we_are(read).from_chunks(chunks).map_err(fault)?;
    Ok(image.layer_data.channel_data.pixels.1)
}

fn grey(chunks: Chunks, name: &str) -> Result<Vec<f32>, Fault> {
    let read = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required(name)
        .collect_pixels(
            |size, _| (size.0, vec![0.0; size.area()]),
            |(width, pixels): &mut (usize, Vec<f32>), at, (y,): (f32,)| pixels[at.1 * *width + at.0] = y,
        )
        .first_valid_layer()
        .all_attributes();
    let image = as_parallel_as_we_are(read).from_chunks(chunks).map_err(fault)?;
    Ok(image.layer_data.channel_data.pixels.1)
}

/// The library has threads of its own, one for each core.
fn as_parallel_as_we_are<F, L>(read: ReadImage<F, L>) -> ReadImage<F, L>
where
    F: FnMut(f64),
{
    if rayon::current_num_threads() == 1 { read.non_parallel() } else { read }
}

fn chromaticities(stated: Attribute) -> Chromaticities {
    let xy = |Vec2(x, y): Vec2<f32>| [f64::from(x), f64::from(y)];
    Chromaticities { primaries_xy: [stated.red, stated.green, stated.blue].map(xy), white_xy: xy(stated.white) }
}

fn fault(error: Error) -> Fault {
    Fault::new(match error {
        Error::Invalid(reason) if reason.contains("missing bytes") => "the EXR ends in the middle".to_owned(),
        Error::NotSupported(reason) => format!("this kind of EXR is not read: {reason}"),
        error => format!("this is no EXR that can be read: {error}"),
    })
}
