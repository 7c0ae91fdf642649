//! Colour spaces by number: the primaries and curves of ITU-T H.273 (2021), tables 2 and 3, which the PNG chunk cICP names.

use super::curve::Curve;
use crate::spectrum::{Chromaticities, RgbSpace};

const D65: [f64; 2] = [0.3127, 0.3290];
/// CIE illuminant C.
const C: [f64; 2] = [0.310, 0.316];

pub fn primaries(number: u8) -> Option<Chromaticities> {
    let of = |red, green, blue, white_xy| Chromaticities { primaries_xy: [red, green, blue], white_xy };
    Some(match number {
        1 => RgbSpace::Srgb.chromaticities(),
        4 => of([0.67, 0.33], [0.21, 0.71], [0.14, 0.08], C),
        5 => of([0.64, 0.33], [0.29, 0.60], [0.15, 0.06], D65),
        6 | 7 => of([0.630, 0.340], [0.310, 0.595], [0.155, 0.070], D65),
        8 => of([0.681, 0.319], [0.243, 0.692], [0.145, 0.049], C),
        9 => RgbSpace::Rec2020.chromaticities(),
        10 => Chromaticities::XYZ,
        11 => Chromaticities { white_xy: [0.314, 0.351], ..RgbSpace::DisplayP3.chromaticities() },
        12 => RgbSpace::DisplayP3.chromaticities(),
        22 => of([0.630, 0.340], [0.295, 0.605], [0.155, 0.077], D65),
        _ => return None,
    })
}

/// Curves of surfaces and displays; those of HDR video (16 and 18) are of light, and no code of theirs is white.
pub fn curve(number: u8) -> Option<Curve> {
    match number {
        1 | 6 | 14 | 15 => Some(Curve::Bt709),
        4 => Some(Curve::Power(2.2)),
        5 => Some(Curve::Power(2.8)),
        8 => Some(Curve::Power(1.0)),
        13 => Some(Curve::Srgb),
        _ => None,
    }
}
