//! RGB spaces: matrices derived from primaries and white in f64, never the rounded ones of the standards, and the sRGB
//! transfer curve.

use super::color::{Matrix3, Xyz, bradford, xyz_from_xy};

/// The RGB spaces that pictures are written in. All linear; encoding is separate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum RgbSpace {
    /// IEC 61966-2-1, the primaries of ITU-R BT.709.
    #[default]
    Srgb,
    /// SMPTE EG 432-1 primaries with D65.
    DisplayP3,
    /// ITU-R BT.2020.
    Rec2020,
    /// ACEScg: AP1 primaries, the ACES white near D60 (S-2014-004).
    AcesCg,
}

impl RgbSpace {
    pub const ALL: [Self; 4] = [Self::Srgb, Self::DisplayP3, Self::Rec2020, Self::AcesCg];

    pub fn name(self) -> &'static str {
        match self {
            Self::Srgb => "srgb",
            Self::DisplayP3 => "display-p3",
            Self::Rec2020 => "rec2020",
            Self::AcesCg => "acescg",
        }
    }

    /// By name, case and separators aside; `rec709` is linear sRGB.
    pub fn from_name(name: &str) -> Option<Self> {
        let plain: String = name.chars().filter(char::is_ascii_alphanumeric).collect::<String>().to_lowercase();
        match plain.as_str() {
            "srgb" | "rec709" | "bt709" => Some(Self::Srgb),
            "displayp3" | "p3" => Some(Self::DisplayP3),
            "rec2020" | "bt2020" => Some(Self::Rec2020),
            "acescg" | "ap1" => Some(Self::AcesCg),
            _ => None,
        }
    }

    /// Chromaticities (x, y) of red, green, blue.
    pub fn primaries_xy(self) -> [[f64; 2]; 3] {
        match self {
            Self::Srgb => [[0.640, 0.330], [0.300, 0.600], [0.150, 0.060]],
            Self::DisplayP3 => [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060]],
            Self::Rec2020 => [[0.708, 0.292], [0.170, 0.797], [0.131, 0.046]],
            Self::AcesCg => [[0.713, 0.293], [0.165, 0.830], [0.128, 0.044]],
        }
    }

    /// Chromaticity (x, y) of its white.
    pub fn white_xy(self) -> [f64; 2] {
        match self {
            Self::AcesCg => [0.32168, 0.33767],
            Self::Srgb | Self::DisplayP3 | Self::Rec2020 => [0.3127, 0.3290],
        }
    }

    /// XYZ of its white, Y = 1.
    pub fn white_xyz(self) -> Xyz {
        xyz_from_xy(self.white_xy())
    }

    pub fn chromaticities(self) -> Chromaticities {
        Chromaticities { primaries_xy: self.primaries_xy(), white_xy: self.white_xy() }
    }

    /// Linear RGB to XYZ: (1, 1, 1) to the white.
    pub fn xyz_from_rgb(self) -> Matrix3 {
        self.chromaticities().xyz_from_rgb().unwrap_or(Matrix3::IDENTITY)
    }

    /// XYZ relative to its white to linear RGB.
    pub fn rgb_from_xyz(self) -> Matrix3 {
        self.xyz_from_rgb().inverse().unwrap_or(Matrix3::IDENTITY)
    }

    /// A linear value by the space's own transfer curve; ACEScg has none.
    pub fn encode(self, linear: f64) -> f64 {
        match self {
            Self::Srgb | Self::DisplayP3 => encode_srgb(linear),
            Self::Rec2020 => encode_bt2020(linear),
            Self::AcesCg => linear,
        }
    }

    /// The inverse of [`Self::encode`].
    pub fn decode(self, encoded: f64) -> f64 {
        match self {
            Self::Srgb | Self::DisplayP3 => decode_srgb(encoded),
            Self::Rec2020 => decode_bt2020(encoded),
            Self::AcesCg => encoded,
        }
    }
}

/// What a file may say of its RGB: chromaticities (x, y) of red, green and blue, and of (1, 1, 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chromaticities {
    pub primaries_xy: [[f64; 2]; 3],
    pub white_xy: [f64; 2],
}

/// Files state chromaticities with three or four digits.
const SAME_XY: f64 = 2e-3;

impl Chromaticities {
    /// X, Y and Z themselves. Their white ⅓ is that of the numbers, and no light to adapt from.
    pub const XYZ: Self = Self { primaries_xy: [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]], white_xy: [1.0 / 3.0, 1.0 / 3.0] };

    /// ACES2065-1: AP0 primaries, the ACES white (SMPTE ST 2065-1:2012). Its green and its blue are no light.
    pub const ACES2065_1: Self =
        Self { primaries_xy: [[0.7347, 0.2653], [0.0, 1.0], [0.0001, -0.0770]], white_xy: [0.32168, 0.33767] };

    /// Adobe RGB (1998), version 2005-05.
    pub const ADOBE_RGB: Self =
        Self { primaries_xy: [[0.64, 0.33], [0.21, 0.71], [0.15, 0.06]], white_xy: [0.3127, 0.3290] };

    /// Linear RGB to XYZ (SMPTE RP 177-1993): the primaries, scaled so that (1, 1, 1) is the white, Y = 1. `None` if they
    /// are no three colours, or make no white.
    pub fn xyz_from_rgb(&self) -> Option<Matrix3> {
        // A primary without luminance, as in files that hold XYZ, has no Y to divide by, and with less than none, as the
        // blue of ACES2065-1, it would be turned around.
        let xyz = |[x, y]: [f64; 2]| if y <= 0.0 { [x, y, 1.0 - x - y] } else { xyz_from_xy([x, y]) };
        let primaries = Matrix3(self.primaries_xy.map(xyz)).transposed();
        let scales = primaries.inverse()?.apply(xyz_from_xy(self.white_xy));
        let matrix = primaries.after(&Matrix3::diagonal(scales));
        (scales.iter().all(|scale| *scale > 0.0) && matrix.inverse().is_some()).then_some(matrix)
    }

    /// The space that these are the chromaticities of.
    pub fn space(&self) -> Option<RgbSpace> {
        RgbSpace::ALL.into_iter().find(|space| self.are(&space.chromaticities()))
    }

    fn are(&self, others: &Self) -> bool {
        let points = |c: &Self| c.primaries_xy.into_iter().chain([c.white_xy]).flatten();
        points(others).zip(points(self)).all(|(a, b)| (a - b).abs() < SAME_XY)
    }

    /// Linear RGB of these to linear RGB of a space, white to white; XYZ as it is.
    pub fn to(&self, space: RgbSpace) -> Option<Matrix3> {
        if self.are(&Self::XYZ) {
            return Some(space.rgb_from_xyz());
        }
        let adapted = bradford(xyz_from_xy(self.white_xy), space.white_xyz());
        Some(space.rgb_from_xyz().after(&adapted).after(&self.xyz_from_rgb()?))
    }
}

/// The sRGB curve (IEC 61966-2-1, equations 8–9): linear to encoded. Odd beyond 0, so that colours outside the gamut survive.
pub fn encode_srgb(linear: f64) -> f64 {
    let size = linear.abs();
    let encoded = if size <= 0.0031308 { 12.92 * size } else { 1.055 * libm::pow(size, 1.0 / 2.4) - 0.055 };
    encoded.copysign(linear)
}

/// Encoded to linear.
pub fn decode_srgb(encoded: f64) -> f64 {
    let size = encoded.abs();
    let linear = if size <= 0.04045 { size / 12.92 } else { libm::pow((size + 0.055) / 1.055, 2.4) };
    linear.copysign(encoded)
}

/// α and β of the curve of ITU-R BT.2020 (2015), table 4, for 12-bit systems.
const BT2020: (f64, f64) = (1.0993, 0.0181);

/// The curve of BT.2020: linear to encoded, odd as [`encode_srgb`].
fn encode_bt2020(linear: f64) -> f64 {
    let ((alpha, beta), size) = (BT2020, linear.abs());
    let encoded = if size < beta { 4.5 * size } else { alpha * libm::pow(size, 0.45) - (alpha - 1.0) };
    encoded.copysign(linear)
}

fn decode_bt2020(encoded: f64) -> f64 {
    let ((alpha, beta), size) = (BT2020, encoded.abs());
    let linear = if size < 4.5 * beta { size / 4.5 } else { libm::pow((size + (alpha - 1.0)) / alpha, 1.0 / 0.45) };
    linear.copysign(encoded)
}

/// Linear sRGB as `#rrggbb`, clipped to 0…1: for people to read, the caller says if something was clipped.
pub fn hex_from_srgb(linear: [f64; 3]) -> String {
    let [r, g, b] = linear.map(|value| (encode_srgb(value).clamp(0.0, 1.0) * 255.0).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Linear sRGB of `#rrggbb`, with or without the #; `None` if it is no such colour.
pub fn srgb_from_hex(hex: &str) -> Option<[f64; 3]> {
    let digits = hex.strip_prefix('#').unwrap_or(hex);
    if digits.len() != 6 || !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    let number = u32::from_str_radix(digits, 16).ok()?;
    Some([16, 8, 0].map(|shift| decode_srgb(f64::from(number >> shift & 0xff) / 255.0)))
}

#[cfg(test)]
mod tests {
    use palette::convert::IntoColorUnclamped;

    use super::*;

    #[test]
    fn matrices_take_ones_to_white_and_match_the_standard() {
        for space in RgbSpace::ALL {
            let white = space.xyz_from_rgb().apply([1.0; 3]);
            assert!(white.iter().zip(space.white_xyz()).all(|(a, b)| (a - b).abs() < 1e-15), "{space:?}");
            assert_eq!(RgbSpace::from_name(space.name()), Some(space));
        }
        // IEC 61966-2-1 prints four digits.
        let printed = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
        for (row, printed) in RgbSpace::Srgb.xyz_from_rgb().0.iter().zip(printed) {
            assert!(row.iter().zip(printed).all(|(a, b)| (a - b).abs() < 6e-5));
        }
        assert_eq!(RgbSpace::from_name("Rec.709"), Some(RgbSpace::Srgb));
        assert_eq!(RgbSpace::from_name("adobe"), None);
    }

    #[test]
    fn colours_of_wide_primaries_are_those_of_their_standards() {
        let seen = |stated: Chromaticities, rgb| stated.to(RgbSpace::Srgb).expect("colours").apply(rgb);
        let near = |found: [f64; 3], expected: [f64; 3]| found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 6e-4);
        let aces = seen(Chromaticities::ACES2065_1, [0.5, 0.4, 0.2]);
        assert!(near(aces, [0.730, 0.392, 0.165]), "{aces:?}");
        assert!(near(seen(Chromaticities::ACES2065_1, [1.0; 3]), [1.0; 3]));
        // XYZ has no white to adapt from: what sRGB wrote comes back.
        let xyz = RgbSpace::Srgb.xyz_from_rgb().apply([0.60, 0.20, 0.10]);
        assert!(near(seen(Chromaticities::XYZ, xyz), [0.60, 0.20, 0.10]));
        let p3 = [200.0, 60.0, 40.0].map(|code| decode_srgb(code / 255.0));
        let shown = seen(RgbSpace::DisplayP3.chromaticities(), p3);
        assert!(near(shown, [0.697, 0.023, 0.008]), "{shown:?}");
        // Its blue turned around, or its white outside of them: no colours.
        let [red, green, blue] = RgbSpace::Srgb.primaries_xy();
        let odd = |primaries_xy, white_xy| Chromaticities { primaries_xy, white_xy }.to(RgbSpace::Srgb);
        assert_eq!(odd([red, green, green], [0.3127, 0.3290]), None);
        assert_eq!(odd([red, green, blue], [0.7, 0.2]), None);
    }

    #[test]
    fn palette_agrees() {
        for rgb in [[0.2, 0.5, 0.8], [1.0, 0.0, 0.0], [0.01, 0.02, 0.9]] {
            let [r, g, b] = rgb;
            let theirs: palette::Xyz<palette::white_point::D65, f64> =
                palette::LinSrgb::new(r, g, b).into_color_unclamped();
            let ours = RgbSpace::Srgb.xyz_from_rgb().apply(rgb);
            // Its white is rounded elsewhere.
            for (a, b) in ours.iter().zip([theirs.x, theirs.y, theirs.z]) {
                assert!((a - b).abs() < 3e-4, "{ours:?} {theirs:?}");
            }
            let encoded: palette::Srgb<f64> = palette::Srgb::from_linear(palette::LinSrgb::new(r, g, b));
            assert!((encode_srgb(r) - encoded.red).abs() < 1e-12);
        }
    }

    #[test]
    fn encoding_round_trips() {
        for i in -40..=60 {
            let linear = f64::from(i) / 40.0;
            assert!((decode_srgb(encode_srgb(linear)) - linear).abs() < 3e-7 + 1e-12);
        }
        for space in RgbSpace::ALL {
            assert!((-40..=60).map(|i| f64::from(i) / 40.0).all(|x| (space.decode(space.encode(x)) - x).abs() < 1e-4));
            assert!((space.encode(1.0) - 1.0).abs() < 1e-12 && space.encode(0.0) == 0.0);
        }
        // BT.2020, table 4: 0.5 is 1.0993 · 0.5^0.45 − 0.0993.
        assert!((RgbSpace::Rec2020.encode(0.5) - 0.705435).abs() < 1e-5);
        assert_eq!(hex_from_srgb([1.5, 0.0, -1.0]), "#ff0000");
        let gold = srgb_from_hex("#FFD700").unwrap();
        assert_eq!(hex_from_srgb(gold), "#ffd700");
        assert_eq!((srgb_from_hex("#ffd70"), srgb_from_hex("ggggg0"), srgb_from_hex("é1234")), (None, None, None));
    }
}
