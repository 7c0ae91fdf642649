//! ICC profiles of three primaries and three curves (ICC.1:2022), as far as pictures of a display have them.
//!
//! Profiles state colours as adapted to D50 by Bradford's transform. Where undoing that for D65 gives the primaries of a
//! known space, the space is meant: what differs is rounding.

use super::curve::Curve;
use crate::spectrum::{Chromaticities, bradford, xyz_from_xy};

/// What a profile says of R, G and B.
#[derive(Debug, PartialEq)]
pub struct Profile {
    pub curves: [Curve; 3],
    /// `None` of a grey one.
    pub chromaticities: Option<Chromaticities>,
}

/// The white that profiles are relative to (ICC.1:2022, 7.2.16).
const D50: [f64; 3] = [0.9642, 1.0, 0.8249];
const D65_XY: [f64; 2] = [0.3127, 0.3290];

/// Reads a profile; `None` if it is broken or of another kind.
pub fn read(bytes: &[u8]) -> Option<Profile> {
    if bytes.get(36..40)? != b"acsp" {
        return None;
    }
    if bytes.get(16..20)? == b"GRAY" {
        let curve = curve(tag(bytes, b"kTRC")?)?;
        return Some(Profile { curves: [curve.clone(), curve.clone(), curve], chromaticities: None });
    }
    if (bytes.get(16..20)?, bytes.get(20..24)?) != (b"RGB ", b"XYZ ") {
        return None;
    }
    let curve = |name| curve(tag(bytes, name)?);
    let color = |name| color(tag(bytes, name)?);
    let colors = [color(b"rXYZ")?, color(b"gXYZ")?, color(b"bXYZ")?];
    Some(Profile {
        curves: [curve(b"rTRC")?, curve(b"gTRC")?, curve(b"bTRC")?],
        chromaticities: Some(chromaticities(colors)),
    })
}

fn chromaticities(colors: [[f64; 3]; 3]) -> Chromaticities {
    let xy = |[x, y, z]: [f64; 3]| [x / (x + y + z), y / (x + y + z)];
    let undone = bradford(D50, xyz_from_xy(D65_XY));
    let known = Chromaticities { primaries_xy: colors.map(|color| xy(undone.apply(color))), white_xy: D65_XY };
    let white = std::array::from_fn(|i| colors.iter().map(|color| color[i]).sum());
    let stated = Chromaticities { primaries_xy: colors.map(xy), white_xy: xy(white) };
    known.space().map_or(stated, |space| space.chromaticities())
}

/// The bytes of a tag.
fn tag<'a>(bytes: &'a [u8], name: &[u8; 4]) -> Option<&'a [u8]> {
    let count = integer(bytes, 128)? as usize;
    let entry = bytes.get(132..)?.chunks_exact(12).take(count).find(|entry| entry.starts_with(name))?;
    let [offset, size] = [4, 8].map(|at| integer(entry, at).unwrap_or(0) as usize);
    bytes.get(offset..offset.checked_add(size)?)
}

fn color(tag: &[u8]) -> Option<[f64; 3]> {
    (tag.get(..4)? == b"XYZ ").then_some(())?;
    Some([fixed(tag, 8)?, fixed(tag, 12)?, fixed(tag, 16)?])
}

fn curve(tag: &[u8]) -> Option<Curve> {
    let read = match tag.get(..4)? {
        b"curv" => sampled(tag)?,
        b"para" => parametric(tag)?,
        _ => return None,
    };
    Some(read.or_srgb())
}

fn sampled(tag: &[u8]) -> Option<Curve> {
    let count = integer(tag, 8)? as usize;
    let values = tag.get(12..)?.chunks_exact(2).take(count).map(|b| f64::from(u16::from_be_bytes([b[0], b[1]])));
    let values: Vec<f64> = values.collect();
    match values[..] {
        _ if values.len() < count => None,
        [] => Some(Curve::Power(1.0)),
        [gamma] => Some(Curve::Power(gamma / 256.0)),
        _ => Some(Curve::Table(values.into_iter().map(|value| value / 65535.0).collect())),
    }
}

fn parametric(tag: &[u8]) -> Option<Curve> {
    let kind = u16::from_be_bytes(tag.get(8..10)?.try_into().ok()?);
    let number = |i: usize| fixed(tag, 12 + 4 * i);
    let g = number(0)?;
    let from = |a: f64, b: f64| if a == 0.0 { 0.0 } else { -b / a };
    let all = match kind {
        0 => return Some(Curve::Power(g)),
        1 => [g, number(1)?, number(2)?, 0.0, from(number(1)?, number(2)?), 0.0, 0.0],
        2 => [g, number(1)?, number(2)?, 0.0, from(number(1)?, number(2)?), number(3)?, number(3)?],
        3 => [g, number(1)?, number(2)?, number(3)?, number(4)?, 0.0, 0.0],
        4 => [g, number(1)?, number(2)?, number(3)?, number(4)?, number(5)?, number(6)?],
        _ => return None,
    };
    Some(Curve::Parametric(all))
}

fn integer(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
}

/// A number of 16 binary digits behind the point.
fn fixed(bytes: &[u8], at: usize) -> Option<f64> {
    Some(f64::from(integer(bytes, at)? as i32) / 65536.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::RgbSpace;

    /// A profile of tags, as its format puts them together.
    fn profile(space: &[u8; 4], tags: &[(&[u8; 4], Vec<u8>)]) -> Vec<u8> {
        let mut bytes = vec![0; 128];
        bytes[16..20].copy_from_slice(space);
        bytes[20..24].copy_from_slice(b"XYZ ");
        bytes[36..40].copy_from_slice(b"acsp");
        bytes.extend((tags.len() as u32).to_be_bytes());
        let mut at = 132 + 12 * tags.len();
        for (name, data) in tags {
            bytes.extend(*name);
            bytes.extend((at as u32).to_be_bytes());
            bytes.extend((data.len() as u32).to_be_bytes());
            at += data.len();
        }
        tags.iter().for_each(|(_, data)| bytes.extend(data));
        bytes
    }

    fn numbers(kind: &[u8; 8], values: &[f64]) -> Vec<u8> {
        let fixed = |value: &f64| ((value * 65536.0).round() as i32).to_be_bytes();
        kind.iter().copied().chain(values.iter().flat_map(fixed)).collect()
    }

    fn gamma(value: u16) -> Vec<u8> {
        [b"curv\0\0\0\0\0\0\0\x01".as_slice(), &value.to_be_bytes()].concat()
    }

    #[test]
    fn primaries_of_display_p3_and_of_adobe_rgb_are_read() {
        let srgb = numbers(b"para\0\0\0\0", &[3.0, 2.4, 0.94787, 0.05213, 0.0774, 0.04045]);
        let p3 = [[0.51512, 0.2412, -0.00105], [0.29198, 0.69225, 0.04189], [0.1571, 0.06657, 0.78407]];
        let colors = p3.map(|color| numbers(b"XYZ \0\0\0\0", &color));
        let [r, g, b] = colors;
        let curves = [(b"rTRC", srgb.clone()), (b"gTRC", srgb.clone()), (b"bTRC", srgb)];
        let tags = [vec![(b"rXYZ", r), (b"gXYZ", g), (b"bXYZ", b)], curves.to_vec()].concat();
        let read = read(&profile(b"RGB ", &tags)).expect("a profile");
        assert_eq!(read.chromaticities, Some(RgbSpace::DisplayP3.chromaticities()));
        assert_eq!(read.curves, [Curve::Srgb, Curve::Srgb, Curve::Srgb]);
        let adobe = [[0.60974, 0.31111, 0.01947], [0.20528, 0.62567, 0.06087], [0.14919, 0.06322, 0.74457]];
        let [r, g, b] = adobe.map(|color| numbers(b"XYZ \0\0\0\0", &color));
        let curves = [(b"rTRC", gamma(563)), (b"gTRC", gamma(563)), (b"bTRC", gamma(563))];
        let tags = [vec![(b"rXYZ", r), (b"gXYZ", g), (b"bXYZ", b)], curves.to_vec()].concat();
        let read = super::read(&profile(b"RGB ", &tags)).expect("a profile");
        assert_eq!(read.curves[1], Curve::Power(563.0 / 256.0));
        let matrix = read.chromaticities.and_then(|stated| stated.to(RgbSpace::Srgb)).expect("colours");
        // Adobe's green in linear sRGB, by the two standards' own matrices.
        for (found, expected) in matrix.apply([0.0, 1.0, 0.0]).into_iter().zip([-0.3984, 1.0, -0.0429]) {
            assert!((found - expected).abs() < 1e-3, "{found} {expected}");
        }
    }

    #[test]
    fn grey_profiles_have_a_curve_and_others_are_none() {
        let grey = profile(b"GRAY", &[(b"kTRC", b"curv\0\0\0\0\0\0\0\0".to_vec())]);
        let read = super::read(&grey).expect("a profile");
        assert_eq!((read.curves[0].clone(), read.chromaticities), (Curve::Power(1.0), None));
        assert!((0..grey.len()).all(|length| super::read(&grey[..length]).is_none()), "cut short");
        assert_eq!(super::read(&profile(b"CMYK", &[])), None);
    }
}
