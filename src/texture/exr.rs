//! OpenEXR: the channels R, G and B, or Y alone, of the first part that has them; 16 or 32 bits, every compression that the
//! crate `exr` knows (all but DWAA, DWAB and deep data).

use super::error::{Fault, room_for};
use super::{Encoding, Raster, Samples};
use crate::spectrum::Chromaticities;
use exr::error::Error;
use exr::image::read::image::ReadImage;
use exr::meta::attribute::Chromaticities as Attribute;
use exr::meta::header::Header;
use exr::prelude::{ReadChannels, ReadLayers, ReadSpecificChannel, Vec2};
use std::fs::File;
use std::io::BufReader;

pub(super) fn read(file: File, beside: usize) -> Result<Raster, Fault> {
    let chunks = exr::block::read(BufReader::new(file), false).map_err(fault)?;
    let (header, colored) = picture(chunks.headers())?;
    for Vec2(width, height) in chunks.headers().iter().map(|header| header.layer_size) {
        room_for(width as u64, height as u64, if colored { 12 } else { 4 } + beside)?;
    }
    let notes = notes(header);
    let chromaticities = header.shared_attributes.chromaticities.map(chromaticities);
    let (Vec2(width, height), samples) = if colored { rgb(chunks)? } else { grey(chunks)? };
    let [width, height] = [width, height].map(|side| side as u32);
    Ok(Raster { width, height, samples, encoding: Encoding::Linear, chromaticities, notes })
}

type Chunks = exr::block::reader::Reader<BufReader<File>>;

fn rgb(chunks: Chunks) -> Result<(Vec2<usize>, Samples), Fault> {
    let read = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| (size.0, vec![[0.0; 3]; size.area()]),
            |(width, pixels): &mut (usize, Vec<[f32; 3]>), at, (r, g, b): (f32, f32, f32)| {
                pixels[at.1 * *width + at.0] = [r, g, b];
            },
        )
        .first_valid_layer()
        .all_attributes();
    let image = as_parallel_as_we_are(read).from_chunks(chunks).map_err(fault)?;
    Ok((image.layer_data.size, Samples::Rgb(image.layer_data.channel_data.pixels.1)))
}

fn grey(chunks: Chunks) -> Result<(Vec2<usize>, Samples), Fault> {
    let read = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required("Y")
        .collect_pixels(
            |size, _| (size.0, vec![0.0; size.area()]),
            |(width, pixels): &mut (usize, Vec<f32>), at, (y,): (f32,)| pixels[at.1 * *width + at.0] = y,
        )
        .first_valid_layer()
        .all_attributes();
    let image = as_parallel_as_we_are(read).from_chunks(chunks).map_err(fault)?;
    Ok((image.layer_data.size, Samples::Grey(image.layer_data.channel_data.pixels.1)))
}

/// The library has threads of its own, one for each core.
fn as_parallel_as_we_are<F, L>(read: ReadImage<F, L>) -> ReadImage<F, L>
where
    F: FnMut(f64),
{
    if rayon::current_num_threads() == 1 { read.non_parallel() } else { read }
}

/// The first part that holds a picture, and whether in colour.
fn picture(headers: &[Header]) -> Result<(&Header, bool), Fault> {
    let has = |header: &Header, name: &str| {
        let mut found = header.channels.list.iter().filter(|channel| channel.name.eq(name));
        found.any(|channel| channel.sampling == Vec2(1, 1))
    };
    let flat = || headers.iter().filter(|header| !header.deep);
    let colored = flat().find(|header| ["R", "G", "B"].iter().all(|name| has(header, name)));
    // Y with RY and BY is a colour picture whose colours are kept at half the resolution.
    let grey = flat().find(|header| has(header, "Y") && !header.channels.list.iter().any(|c| c.name.eq("RY")));
    if let Some(header) = colored {
        return Ok((header, true));
    }
    if let Some(header) = grey {
        return Ok((header, false));
    }
    let names = headers.iter().flat_map(|header| &header.channels.list).map(|channel| format!("`{}`", channel.name));
    let names = names.collect::<Vec<_>>().join(", ");
    let deep = if headers.iter().all(|header| header.deep) { "deep data, which is not read, and " } else { "" };
    Err(Fault::new(format!(
        "it has {deep}the channels {names}: a picture has `R`, `G` and `B`, or `Y`, at full resolution"
    )))
}

fn notes(header: &Header) -> Vec<String> {
    let mut notes = Vec::new();
    if header.channels.list.iter().any(|channel| channel.name.eq("A")) {
        notes.push("its alpha is ignored".into());
    }
    let (data, display) = (header.data_window(), header.shared_attributes.display_window);
    if data != display {
        notes.push(format!(
            "its data window of {} × {} is taken for the picture; its display window is another, of {} × {}",
            data.size.0, data.size.1, display.size.0, display.size.1
        ));
    }
    notes
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
