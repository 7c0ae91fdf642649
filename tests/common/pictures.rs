//! Pictures for scenes to read, written by the tests: EXR, PNG, and Radiance HDR in each of its three forms.

use exr::prelude::*;
use std::path::Path;

/// The three ways in which rows of a Radiance HDR are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rows {
    Flat,
    OldRuns,
    NewRuns,
}

pub const ROWS: [Rows; 3] = [Rows::Flat, Rows::OldRuns, Rows::NewRuns];

/// Linear RGB in 32 bits, lossless.
pub fn write_exr(path: &Path, width: usize, pixels: &[[f32; 3]]) {
    write_exr_with(path, width, pixels, |_| {});
}

/// The same, with other attributes.
pub fn write_exr_with(path: &Path, width: usize, pixels: &[[f32; 3]], change: impl Fn(&mut ImageAttributes)) {
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| {
        let [r, g, b] = pixels[at.1 * width + at.0];
        (r, g, b)
    });
    let mut image = Image::from_channels((width, pixels.len() / width), channels);
    image.layer_data.encoding =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    change(&mut image.attributes);
    image.write().to_file(path).expect("a file");
}

/// The same, its data window at a place of a larger or smaller display window at the origin.
pub fn write_exr_window(path: &Path, width: usize, pixels: &[[f32; 3]], at: (i32, i32), display: [usize; 2]) {
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| {
        let [r, g, b] = pixels[at.1 * width + at.0];
        (r, g, b)
    });
    let mut image = Image::from_channels((width, pixels.len() / width), channels);
    image.layer_data.attributes.layer_position = Vec2(at.0, at.1);
    image.attributes.display_window = IntegerBounds::from_dimensions(Vec2(display[0], display[1]));
    image.write().to_file(path).expect("a file");
}

/// One channel of an EXR.
pub fn write_exr_channel(path: &Path, name: &str, width: usize, values: &[f32]) {
    write_exr_channels(path, width, &[(name, values.to_vec())]);
}

/// Channels of an EXR, by name.
pub fn write_exr_channels(path: &Path, width: usize, channels: &[(&str, Vec<f32>)]) {
    let size = (width, channels[0].1.len() / width);
    let channels = channels.iter().map(|(name, values)| AnyChannel::new(*name, FlatSamples::F32(values.clone())));
    let layer =
        Layer::new(size, LayerAttributes::default(), Encoding::FAST_LOSSLESS, AnyChannels::sort(channels.collect()));
    Image::from_layer(layer).write().to_file(path).expect("a file");
}

/// An EXR of Y at full resolution and of RY and BY at every second texel of every second row, as bytes: `packing` is the
/// number that the format gives it (0 none, 2 ZIP by rows, 3 ZIP by sixteen).
pub fn sampled_exr(
    [width, height]: [usize; 2],
    packing: u8,
    luminance: &[f32],
    chroma: impl Fn(usize, usize) -> [f32; 2],
) -> Vec<u8> {
    let mut bytes = vec![0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0];
    let mut attribute = |name: &str, kind: &str, value: Vec<u8>| {
        bytes.extend([name, "\0", kind, "\0"].concat().bytes());
        bytes.extend((value.len() as u32).to_le_bytes());
        bytes.extend(value);
    };
    let integers = |values: &[i32]| values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>();
    let channel = |name: &str, step: i32| [name.as_bytes(), &[0], &integers(&[2, 0, step, step])].concat();
    attribute("channels", "chlist", [channel("BY", 2), channel("RY", 2), channel("Y", 1), vec![0]].concat());
    attribute("compression", "compression", vec![packing]);
    let window = integers(&[0, 0, width as i32 - 1, height as i32 - 1]);
    attribute("dataWindow", "box2i", window.clone());
    attribute("displayWindow", "box2i", window);
    attribute("lineOrder", "lineOrder", vec![0]);
    attribute("pixelAspectRatio", "float", 1.0f32.to_le_bytes().to_vec());
    attribute("screenWindowCenter", "v2f", vec![0; 8]);
    attribute("screenWindowWidth", "float", 1.0f32.to_le_bytes().to_vec());
    bytes.push(0);
    let lines = if packing == 3 { 16 } else { 1 };
    let blocks = (0..height).step_by(lines).map(|first| {
        let mut block = Vec::new();
        for y in first..(first + lines).min(height) {
            if y % 2 == 0 {
                let line = |i: usize| (0..width).step_by(2).map(move |x| (x, i)).collect::<Vec<_>>();
                for (x, i) in [line(1), line(0)].concat() {
                    block.extend(chroma(x, y)[i].to_le_bytes());
                }
            }
            luminance[y * width..(y + 1) * width].iter().for_each(|value| block.extend(value.to_le_bytes()));
        }
        let packed = if packing == 0 { block } else { zipped(&block) };
        [integers(&[first as i32, packed.len() as i32]), packed].concat()
    });
    let blocks: Vec<Vec<u8>> = blocks.collect();
    let mut at = bytes.len() + 8 * blocks.len();
    for block in &blocks {
        bytes.extend((at as u64).to_le_bytes());
        at += block.len();
    }
    [bytes, blocks.concat()].concat()
}

/// As OpenEXR zips a block: halves of the bytes apart, differences, and one stored block of zlib.
fn zipped(block: &[u8]) -> Vec<u8> {
    let apart: Vec<u8> = block.iter().step_by(2).chain(block.iter().skip(1).step_by(2)).copied().collect();
    let before = std::iter::once(None).chain(apart.iter().map(Some));
    let difference =
        |(now, before): (&u8, Option<&u8>)| before.map_or(*now, |b| now.wrapping_sub(*b).wrapping_add(128));
    stored(&apart.iter().zip(before).map(difference).collect::<Vec<u8>>())
}

/// One stored block of zlib.
pub fn stored(data: &[u8]) -> Vec<u8> {
    let length = (data.len() as u16).to_le_bytes();
    let (a, b) = data.iter().fold((1u32, 0u32), |(a, b), byte| {
        let a = (a + u32::from(*byte)) % 65521;
        (a, (b + a) % 65521)
    });
    let checksum = (b << 16 | a).to_be_bytes();
    [&[0x78, 0x01, 1], &length[..], &length.map(|byte| !byte), data, &checksum].concat()
}

/// An 8-bit or 16-bit PNG of the given samples.
pub fn write_png(path: &Path, width: u32, color: png::ColorType, depth: png::BitDepth, samples: &[u8]) {
    write_png_with(path, width, color, depth, samples, &[]);
}

/// The same, with chunks before its pixels.
pub fn write_png_with(
    path: &Path,
    width: u32,
    color: png::ColorType,
    depth: png::BitDepth,
    samples: &[u8],
    chunks: &[(&[u8; 4], Vec<u8>)],
) {
    let bits = color.samples() * depth as usize;
    let height = (samples.len() / ((width as usize * bits).div_ceil(8))) as u32;
    let mut encoder = png::Encoder::new(std::fs::File::create(path).expect("a file"), width, height);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == png::ColorType::Indexed {
        encoder.set_palette(vec![0, 0, 0, 255, 0, 0, 0, 128, 255, 255, 255, 255]);
    }
    let mut writer = encoder.write_header().expect("a header");
    chunks.iter().for_each(|(name, data)| writer.write_chunk(png::chunk::ChunkType(**name), data).expect("a chunk"));
    writer.write_image_data(samples).expect("pixels");
}

/// A colour in four bytes; exact where its channels have eight bits in common.
pub fn rgbe(rgb: [f32; 3]) -> [u8; 4] {
    let largest = rgb.into_iter().fold(0.0, f32::max);
    if largest < 1e-30 {
        return [0; 4];
    }
    let (_, exponent) = libm::frexp(f64::from(largest));
    let mantissas = rgb.map(|channel| (f64::from(channel) * libm::ldexp(1.0, 8 - exponent)) as u8);
    [mantissas[0], mantissas[1], mantissas[2], (exponent + 128) as u8]
}

/// A Radiance HDR, with more lines in its header.
pub fn hdr(width: usize, pixels: &[[f32; 3]], rows: Rows, more: &str) -> Vec<u8> {
    let mut bytes =
        format!("#?RADIANCE\n# a test\nFORMAT=32-bit_rle_rgbe\n{more}\n-Y {} +X {width}\n", pixels.len() / width)
            .into_bytes();
    for row in pixels.chunks(width) {
        let row: Vec<_> = row.iter().map(|rgb| rgbe(*rgb)).collect();
        match rows {
            Rows::Flat => bytes.extend(row.concat()),
            Rows::OldRuns => old_runs(&mut bytes, &row),
            Rows::NewRuns => {
                bytes.extend([2, 2, (width >> 8) as u8, width as u8]);
                (0..4).for_each(|channel| {
                    new_runs(&mut bytes, &row.iter().map(|texel| texel[channel]).collect::<Vec<_>>())
                });
            }
        }
    }
    bytes
}

fn old_runs(bytes: &mut Vec<u8>, row: &[[u8; 4]]) {
    for run in row.chunk_by(|a, b| a == b) {
        bytes.extend(run[0]);
        let mut more = run.len() - 1;
        while more > 0 {
            bytes.extend([1, 1, 1, (more & 255) as u8]);
            more >>= 8;
        }
    }
}

fn new_runs(bytes: &mut Vec<u8>, row: &[u8]) {
    for run in row.chunk_by(|a, b| a == b) {
        for part in run.chunks(127) {
            // Short ones as they are.
            match part.len() {
                1 | 2 => {
                    bytes.push(part.len() as u8);
                    bytes.extend(part);
                }
                count => bytes.extend([128 + count as u8, part[0]]),
            }
        }
    }
}
