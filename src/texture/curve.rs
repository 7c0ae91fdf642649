//! How the codes of a picture become light: the curves that PNG files and their ICC profiles state.

use crate::spectrum::{RgbSpace, decode_srgb};

/// From a code over the largest one to a linear value.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// IEC 61966-2-1.
    Srgb,
    /// That of ITU-R BT.709 and BT.2020.
    Bt709,
    /// The code to this power.
    Power(f64),
    /// g, a, b, c, d, e, f of (a x + b)^g + e from d on and c x + f below (ICC.1:2022, 10.18).
    Parametric([f64; 7]),
    /// Values at evenly spaced codes from 0 to 1, at least two, linear in between.
    Table(Vec<f64>),
}

/// Curves this near to that of sRGB are meant to be it: half a code of eight bits, where it is steep.
const SAME: f64 = 4e-3;

impl Curve {
    pub fn decode(&self, code: f64) -> f64 {
        match self {
            Self::Srgb => decode_srgb(code),
            Self::Bt709 => RgbSpace::Rec2020.decode(code),
            Self::Power(exponent) => libm::pow(code, *exponent),
            Self::Parametric([g, a, b, c, d, e, f]) if code >= *d => libm::pow((a * code + b).max(0.0), *g) + e,
            Self::Parametric([_, _, _, c, _, _, f]) => c * code + f,
            Self::Table(values) => between(values, code),
        }
    }

    /// This curve, or that of sRGB where it differs from it by rounding alone.
    pub fn or_srgb(self) -> Self {
        let codes = (0..=255).map(|code| f64::from(code) / 255.0);
        let same = codes.map(|code| (self.decode(code) - decode_srgb(code)).abs()).all(|off| off < SAME);
        if same { Self::Srgb } else { self }
    }
}

fn between(values: &[f64], code: f64) -> f64 {
    let position = code.clamp(0.0, 1.0) * (values.len() - 1) as f64;
    let first = (position as usize).min(values.len() - 2);
    let t = position - first as f64;
    values[first] * (1.0 - t) + values[first + 1] * t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_of_profiles_are_their_formulas() {
        let srgb = [2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045, 0.0, 0.0];
        assert_eq!(Curve::Parametric(srgb).or_srgb(), Curve::Srgb);
        let shifted = Curve::Parametric([2.0, 0.5, 0.25, 0.1, 0.5, 0.125, 0.0625]);
        assert_eq!((shifted.decode(0.5), shifted.decode(0.25)), (0.375, 0.0875));
        let table = Curve::Table(vec![0.0, 0.25, 1.0]);
        assert_eq!((table.decode(0.25), table.decode(0.75), table.decode(1.0)), (0.125, 0.625, 1.0));
        assert!((Curve::Bt709.decode(0.5) - 0.2597).abs() < 1e-3);
        assert_eq!(Curve::Power(2.2).or_srgb(), Curve::Power(2.2), "2.2 is off by 0.006");
    }
}
