//! A smooth reflectance with three numbers: a sigmoid of a parabola (W. Jakob & J. Hanika, "A low-dimensional function
//! space for efficient spectral upsampling", Computer Graphics Forum 38 (2019), equations 3–4).
//!
//! It is between 0 and 1 for any three numbers, so it always is a reflectance; `upsample` finds the numbers of a colour.

use super::{LAMBDA_MAX_NM, LAMBDA_MIN_NM};

/// f = 1/2 + x / (2 √(1 + x²)), x = c0 t² + c1 t + c2, where t runs from 0 at 360 nm to 1 at 830 nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sigmoid(pub [f64; 3]);

impl Sigmoid {
    /// The constant one of a grey between 0 and 1, both excluded: f = 1/2 + x / (2 √(1 + x²)) solved for x.
    pub(super) fn grey(value: f64) -> Self {
        let shift = 2.0 * value - 1.0;
        Self([0.0, 0.0, shift / libm::sqrt(1.0 - shift * shift)])
    }

    pub fn at(&self, nm: f64) -> f64 {
        let x = self.argument(nm);
        // For large x the quotient is ±1 to the last digit; keep ∞/∞ out.
        if x.abs() > 1e9 {
            return if x > 0.0 { 1.0 } else { 0.0 };
        }
        0.5 + 0.5 * x / libm::sqrt(1.0 + x * x)
    }

    /// x, the parabola.
    pub(super) fn argument(&self, nm: f64) -> f64 {
        let t = Self::position(nm);
        (self.0[0] * t + self.0[1]) * t + self.0[2]
    }

    /// t, 0…1 over the visible range.
    pub(super) fn position(nm: f64) -> f64 {
        (nm - LAMBDA_MIN_NM) / (LAMBDA_MAX_NM - LAMBDA_MIN_NM)
    }
}
