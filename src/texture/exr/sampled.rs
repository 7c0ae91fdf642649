//! Parts with channels that have a sample for some texels only, as chroma does. The library refuses them as a whole, but
//! unpacks their blocks when it is told how many bytes there are in each.

use super::choice::Choice;
use super::{Fault, fault};
use exr::block::chunk::{Chunk, CompressedBlock};
use exr::io::PeekRead;
use exr::meta::attribute::{ChannelDescription, IntegerBounds, SampleType};
use exr::meta::header::Header;
use exr::meta::{MetaData, Requirements, magic_number};
use exr::prelude::{Vec2, f16};
use std::fs::File;
use std::io::{BufReader, Seek};

type Input<'a> = PeekRead<BufReader<&'a File>>;

/// The headers of a file, and what follows them.
pub fn open(mut file: &File) -> Result<(MetaData, Input<'_>), Fault> {
    file.rewind().map_err(Fault::new)?;
    let mut input = PeekRead::new(BufReader::new(file));
    magic_number::validate_exr(&mut input).map_err(fault)?;
    let requirements = Requirements::read(&mut input).map_err(fault)?;
    let headers = Header::read_all(&mut input, &requirements, false).map_err(fault)?;
    let even = |header: &Header| {
        let (Vec2(x, y), size) = (header.own_attributes.layer_position, header.layer_size);
        header.channels.list.iter().map(|channel| channel.sampling).all(|Vec2(sx, sy)| {
            let divide = sx > 0 && sy > 0 && size.0 % sx == 0 && size.1 % sy == 0;
            divide && i64::from(x) % sx as i64 == 0 && i64::from(y) % sy as i64 == 0
        })
    };
    if headers.len() != 1 || headers[0].deep || !headers.iter().all(even) {
        return Err(Fault::new(
            "this kind of EXR is not read: channels of less resolution in several parts, or uneven ones",
        ));
    }
    Ok((MetaData { requirements, headers }, input))
}

/// The chosen channels at full resolution, linear between their samples.
pub fn planes(meta: &MetaData, mut input: Input, choice: &Choice) -> Result<Vec<Vec<f32>>, Fault> {
    let header = &meta.headers[choice.part];
    let mut planes: Vec<Plane> = header.channels.list.iter().map(|channel| Plane::new(channel, header)).collect();
    MetaData::skip_offset_tables(&mut input, &meta.headers).map_err(fault)?;
    for _ in 0..header.chunk_count {
        let chunk = Chunk::read(&mut input, meta).map_err(fault)?;
        let CompressedBlock::ScanLine(block) = chunk.compressed_block else {
            return Err(Fault::new("this kind of EXR is not read: tiles with channels of less resolution"));
        };
        let rows = Rows::of(header, block.y_coordinate)?;
        let bytes = rows.unpacked(header, block.compressed_pixels_le)?;
        rows.share_out(&bytes, &mut planes);
    }
    let full = |name: &String| {
        let plane = planes.iter().find(|plane| plane.channel.name.eq(name.as_str()));
        plane.map(|plane| plane.full(header.layer_size)).ok_or_else(|| Fault::new("it has lost a channel"))
    };
    choice.names.iter().map(full).collect()
}

/// The samples of one channel.
struct Plane<'a> {
    channel: &'a ChannelDescription,
    width: usize,
    samples: Vec<f32>,
}

impl<'a> Plane<'a> {
    fn new(channel: &'a ChannelDescription, header: &Header) -> Self {
        let Vec2(width, height) = channel.subsampled_resolution(header.layer_size);
        Self { channel, width, samples: vec![0.0; width * height] }
    }

    fn full(&self, Vec2(width, height): Vec2<usize>) -> Vec<f32> {
        let Vec2(sx, sy) = self.channel.sampling;
        let rows = self.samples.len() / self.width;
        let texel = |i: usize| {
            let [(x0, x1, tx), (y0, y1, ty)] = [near(i % width, sx, self.width), near(i / width, sy, rows)];
            let at = |x: usize, y: usize| self.samples[y * self.width + x];
            let row = |y: usize| at(x0, y) * (1.0 - tx) + at(x1, y) * tx;
            if ty == 0.0 { row(y0) } else { row(y0) * (1.0 - ty) + row(y1) * ty }
        };
        (0..width * height).map(texel).collect()
    }
}

/// The samples around a texel on an axis, and how near it is to the second.
fn near(texel: usize, step: usize, count: usize) -> (usize, usize, f32) {
    let first = texel / step;
    (first, (first + 1).min(count - 1), (texel % step) as f32 / step as f32)
}

/// The rows of a block, from the data window's first.
struct Rows {
    /// As the file counts.
    y: i32,
    first: usize,
    count: usize,
}

impl Rows {
    fn of(header: &Header, y: i32) -> Result<Self, Fault> {
        let lines = header.compression.scan_lines_per_block();
        let first = i64::from(y) - i64::from(header.own_attributes.layer_position.1);
        let height = header.layer_size.1 as i64;
        if !(0..height).contains(&first) || !(first as usize).is_multiple_of(lines) {
            return Err(Fault::new("a block of rows in it stands outside of the picture"));
        }
        Ok(Self { y, first: first as usize, count: lines.min((height - first) as usize) })
    }

    /// The channels that have samples in a row, with their sizes in bytes.
    fn channels(row: usize, header: &Header) -> impl Iterator<Item = (usize, usize)> + '_ {
        let all =
            header.channels.list.iter().enumerate().filter(move |(_, channel)| row.is_multiple_of(channel.sampling.1));
        all.map(|(i, channel)| (i, header.layer_size.0 / channel.sampling.0 * channel.sample_type.bytes_per_sample()))
    }

    fn unpacked(&self, header: &Header, packed: Vec<u8>) -> Result<Vec<u8>, Fault> {
        let rows = self.first..self.first + self.count;
        let bytes: usize = rows.flat_map(|row| Self::channels(row, header)).map(|(_, bytes)| bytes).sum();
        let texels = header.layer_size.0 * self.count;
        if !bytes.is_multiple_of(texels) {
            return Err(Fault::new("this kind of EXR is not read: channels of a fraction of a byte for each texel"));
        }
        let mut header = header.clone();
        header.channels.bytes_per_pixel = bytes / texels;
        let position = Vec2(header.own_attributes.layer_position.0, self.y);
        let section = IntegerBounds { position, size: Vec2(header.layer_size.0, self.count) };
        header.compression.decompress_image_section_from_le(&header, packed, section, false).map_err(fault)
    }

    fn share_out(&self, mut bytes: &[u8], planes: &mut [Plane]) {
        for row in self.first..self.first + self.count {
            for plane in planes.iter_mut().filter(|plane| row % plane.channel.sampling.1 == 0) {
                let kind = plane.channel.sample_type;
                let (line, rest) = bytes.split_at(plane.width * kind.bytes_per_sample());
                bytes = rest;
                let first = row / plane.channel.sampling.1 * plane.width;
                let samples = line.chunks_exact(kind.bytes_per_sample()).map(|sample| number(kind, sample));
                plane.samples[first..first + plane.width].iter_mut().zip(samples).for_each(|(to, from)| *to = from);
            }
        }
    }
}

/// A sample in the byte order of this machine.
fn number(kind: SampleType, bytes: &[u8]) -> f32 {
    let four = || bytes.try_into().unwrap_or_default();
    match kind {
        SampleType::F16 => f16::from_bits(u16::from_ne_bytes([bytes[0], bytes[1]])).to_f32(),
        SampleType::F32 => f32::from_ne_bytes(four()),
        SampleType::U32 => u32::from_ne_bytes(four()) as f32,
    }
}
