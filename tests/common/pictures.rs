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

/// One channel of an EXR.
pub fn write_exr_channel(path: &Path, name: &str, width: usize, values: &[f32]) {
    let channel = AnyChannel::new(name, FlatSamples::F32(values.to_vec()));
    let size = (width, values.len() / width);
    let layer = Layer::new(
        size,
        LayerAttributes::default(),
        Encoding::FAST_LOSSLESS,
        AnyChannels::sort([channel].into_iter().collect()),
    );
    Image::from_layer(layer).write().to_file(path).expect("a file");
}

/// An 8-bit or 16-bit PNG of the given samples.
pub fn write_png(path: &Path, width: u32, color: png::ColorType, depth: png::BitDepth, samples: &[u8]) {
    let bits = color.samples() * depth as usize;
    let height = (samples.len() / ((width as usize * bits).div_ceil(8))) as u32;
    let mut encoder = png::Encoder::new(std::fs::File::create(path).expect("a file"), width, height);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == png::ColorType::Indexed {
        encoder.set_palette(vec![0, 0, 0, 255, 0, 0, 0, 128, 255, 255, 255, 255]);
    }
    encoder.write_header().expect("a header").write_image_data(samples).expect("pixels");
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
