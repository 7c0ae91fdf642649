//! Radiance HDR: three mantissas and one exponent in four bytes, in run-length or flat rows.
//!
//! G. Ward, "Real pixels", Graphics Gems II (1991), and the description of the format that comes with Radiance. A byte m with
//! exponent e is m · 2^(e − 136), as nearly all programs write and read it; Radiance itself adds half a step to m. The row
//! formats are told apart as Radiance does: a row of 8 to 32767 texels may begin with 2, 2 and its length, and then holds
//! each of the four bytes for itself, in runs; any other is texels one by one, where 1, 1, 1, n repeats the one before n
//! times (and the next such 256 n times).

use super::error::{Fault, array, room_for};
use super::{Raster, Samples};
use crate::spectrum::Chromaticities;
use std::fs::File;
use std::io::Read;

/// What else a file may be called for: nobody writes more before a picture.
const LONGEST_HEADER: usize = 1 << 16;

pub(super) fn read(mut file: File, beside: usize) -> Result<Raster, Fault> {
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(Fault::new)?;
    decode(&bytes, beside)
}

fn decode(bytes: &[u8], beside: usize) -> Result<Raster, Fault> {
    let mut input = Input { bytes };
    let header = header(&mut input)?;
    let [width, height] = header.size;
    let texels = room_for(width, height, 12 + 4 + beside)?;
    let (width, mut pixels) = (width as usize, array([0.0f32; 3], texels, header.size)?);
    let mut row = array([0u8; 4], width, [header.size[0], 1])?;
    for y in 0..height as usize {
        input.row(&mut row)?;
        let y = if header.from_bottom { height as usize - 1 - y } else { y };
        for (x, texel) in row.iter().enumerate() {
            let x = if header.from_right { width - 1 - x } else { x };
            let color = color(*texel);
            pixels[y * width + x] = std::array::from_fn(|channel| color[channel] * header.factors[channel]);
        }
    }
    let notes = match header.factors {
        [1.0, 1.0, 1.0] => Vec::new(),
        [r, g, b] if r == g && g == b => {
            vec![format!("its header states an exposure: its values are multiplied by {r}")]
        }
        [r, g, b] => {
            vec![format!("its header states a colour correction: R, G and B are multiplied by {r}, {g} and {b}")]
        }
    };
    Ok(Raster {
        width: width as u32,
        height: height as u32,
        samples: Samples::Rgb(pixels),
        curves: None,
        chromaticities: header.chromaticities,
        white_luminance: None,
        notes,
    })
}

fn color([r, g, b, exponent]: [u8; 4]) -> [f32; 3] {
    if exponent == 0 {
        return [0.0; 3];
    }
    let step = libm::ldexp(1.0, i32::from(exponent) - 136);
    [r, g, b].map(|mantissa| (f64::from(mantissa) * step) as f32)
}

struct Header {
    size: [u64; 2],
    from_bottom: bool,
    from_right: bool,
    /// What brings R, G and B back to the scene's: one over all exposures and colour corrections stated.
    factors: [f32; 3],
    chromaticities: Option<Chromaticities>,
}

fn header(input: &mut Input) -> Result<Header, Fault> {
    if !input.line()?.starts_with("#?") {
        return Err(Fault::new("this is no Radiance HDR: it does not begin with #?RADIANCE"));
    }
    let (mut exposures, mut chromaticities) = ([1.0f64; 3], None);
    loop {
        let line = input.line()?;
        let (key, value) = line.split_once('=').unwrap_or((&line, ""));
        match (key.trim(), value.trim()) {
            ("", _) => break,
            ("FORMAT", "32-bit_rle_rgbe") => {}
            ("FORMAT", "32-bit_rle_xyze") => chromaticities = Some(Chromaticities::XYZ),
            ("FORMAT", other) => {
                return Err(Fault::new(format!("the format `{other}` is not known: it is 32-bit_rle_rgbe")));
            }
            ("EXPOSURE", value) => {
                let exposure = value.parse::<f64>().map_err(|_| odd("EXPOSURE", value))?;
                multiply(&mut exposures, [exposure; 3]).ok_or_else(|| odd("EXPOSURE", value))?;
            }
            ("COLORCORR", value) => {
                let correction = numbers(value).ok_or_else(|| odd("COLORCORR", value))?;
                multiply(&mut exposures, correction).ok_or_else(|| odd("COLORCORR", value))?;
            }
            ("PRIMARIES", value) => chromaticities = Some(primaries(value).ok_or_else(|| odd("PRIMARIES", value))?),
            _ => {}
        }
    }
    let (size, from_bottom, from_right) = resolution(&input.line()?)?;
    Ok(Header { size, from_bottom, from_right, factors: exposures.map(|all| (1.0 / all) as f32), chromaticities })
}

/// `None` if the products are nothing that values can be divided by.
fn multiply(products: &mut [f64; 3], by: [f64; 3]) -> Option<()> {
    products.iter_mut().zip(by).for_each(|(product, by)| *product *= by);
    products.iter().all(|product| *product > 0.0 && product.is_finite()).then_some(())
}

fn odd(key: &str, value: impl std::fmt::Display) -> Fault {
    Fault::new(format!("{key}={value} in the header makes no sense"))
}

/// Eight numbers: x and y of red, green, blue and white.
fn primaries(value: &str) -> Option<Chromaticities> {
    let [rx, ry, gx, gy, bx, by, wx, wy] = numbers(value)?;
    Some(Chromaticities { primaries_xy: [[rx, ry], [gx, gy], [bx, by]], white_xy: [wx, wy] })
}

fn numbers<const N: usize>(value: &str) -> Option<[f64; N]> {
    let numbers = value.split_whitespace().map(|number| number.parse().ok());
    numbers.collect::<Option<Vec<f64>>>()?.try_into().ok()
}

/// "-Y 512 +X 1024": size, and whether rows begin below or at the right.
fn resolution(line: &str) -> Result<([u64; 2], bool, bool), Fault> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let parsed = match words[..] {
        [y @ ("-Y" | "+Y"), height, x @ ("-X" | "+X"), width] => {
            let side = |text: &str| text.parse::<u32>().map(u64::from).ok();
            side(width).zip(side(height)).map(|(width, height)| ([width, height], y == "+Y", x == "-X"))
        }
        ["-X" | "+X", _, "-Y" | "+Y", _] => {
            return Err(Fault::new("its rows are columns: turn it with another program"));
        }
        _ => None,
    };
    parsed.ok_or_else(|| Fault::new(format!("`{}` is no size such as -Y 512 +X 1024", line.trim())))
}

fn ended() -> Fault {
    Fault::new("the HDR ends in the middle")
}

/// What is left to read.
struct Input<'a> {
    bytes: &'a [u8],
}

impl Input<'_> {
    fn line(&mut self) -> Result<String, Fault> {
        let end = self.bytes.iter().take(LONGEST_HEADER).position(|&byte| byte == b'\n').ok_or_else(ended)?;
        let line = String::from_utf8_lossy(&self.bytes[..end]).trim_end_matches('\r').to_owned();
        self.bytes = &self.bytes[end + 1..];
        Ok(line)
    }

    fn byte(&mut self) -> Result<u8, Fault> {
        let (&byte, rest) = self.bytes.split_first().ok_or_else(ended)?;
        self.bytes = rest;
        Ok(byte)
    }

    fn texel(&mut self) -> Result<[u8; 4], Fault> {
        let (&texel, rest) = self.bytes.split_first_chunk::<4>().ok_or_else(ended)?;
        self.bytes = rest;
        Ok(texel)
    }

    fn row(&mut self, row: &mut [[u8; 4]]) -> Result<(), Fault> {
        let length = u16::try_from(row.len()).unwrap_or(0).to_be_bytes();
        let by_channel = (8..0x8000).contains(&row.len()) && self.bytes.starts_with(&[2, 2, length[0], length[1]]);
        if !by_channel {
            return self.texels(row);
        }
        self.texel()?;
        (0..4).try_for_each(|channel| self.channel(row, channel))
    }

    /// Runs of one byte of each texel: a count above 128 repeats the next byte, one up to 128 copies so many.
    fn channel(&mut self, row: &mut [[u8; 4]], channel: usize) -> Result<(), Fault> {
        let mut x = 0;
        while x < row.len() {
            let count = self.byte()?;
            let (repeats, count) = (count > 128, usize::from(if count > 128 { count - 128 } else { count }));
            if count == 0 || count > row.len() - x {
                return Err(Fault::new("a run in it is longer than its row"));
            }
            let repeated = if repeats { Some(self.byte()?) } else { None };
            for texel in &mut row[x..x + count] {
                texel[channel] = match repeated {
                    Some(byte) => byte,
                    None => self.byte()?,
                };
            }
            x += count;
        }
        Ok(())
    }

    /// Texels one by one, with the old form of repetition.
    fn texels(&mut self, row: &mut [[u8; 4]]) -> Result<(), Fault> {
        let (mut x, mut shift) = (0, 0);
        while x < row.len() {
            let texel = self.texel()?;
            let [1, 1, 1, count] = texel else {
                (row[x], x, shift) = (texel, x + 1, 0);
                continue;
            };
            let count = usize::from(count) << shift;
            if x == 0 || shift > 16 || count > row.len() - x {
                return Err(Fault::new("a run in it is longer than its row"));
            }
            let before = row[x - 1];
            row[x..x + count].fill(before);
            (x, shift) = (x + count, shift + 8);
        }
        Ok(())
    }
}
