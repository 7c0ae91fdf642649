//! Schlick's approximation in RGB, as engines and most renderers have it.
//!
//! ```text
//! F(θ) = F0 + (1 − F0)(1 − c)⁵,   c = cos θ;   F0 the exact colour at normal incidence, linear sRGB under D65
//! ```
//!
//! - Source: C. Schlick, "An inexpensive BRDF model for physically-based rendering" (1994), eq. 15, for each channel.
//! - F0 is neither clipped nor rounded: gold's red is 1.04.
//! - After one bounce under D65 its colours are those of `schlick`, which is linear in F0 too; after more, and under other lights, they part.
//! - Error against `exact` (`tests/it/fresnel/errors.rs`; mean and largest ΔE2000 over the angles): silver 0.09 and 0.27, copper 0.62 and 1.5,
//!   gold 0.87 and 2.4, aluminium 0.89 and 3.0, iron 2.1 and 6.2.
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids): 11 ns for eight lanes at a hit.

use super::{Rgb, Target};
use crate::math::Lanes;

/// The curve of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SchlickRgb {
    pub f0: Lanes<3>,
}

impl Rgb for SchlickRgb {
    fn fit(target: &Target) -> Self {
        Self { f0: single(target.f0()) }
    }

    #[inline]
    fn reflectance(&self, cos_theta_i: f32) -> Lanes<3> {
        let x = 1.0 - cos_theta_i;
        let x2 = x * x;
        let rise = x2 * x2 * x;
        self.f0.map(|f0| f0 + (1.0 - f0) * rise)
    }
}

/// A colour of tables in the precision of rendering.
pub(super) fn single(rgb: [f64; 3]) -> Lanes<3> {
    Lanes(rgb.map(|channel| channel as f32))
}

/// Schlick's curve in double precision, for fits.
pub(super) fn curve(f0: f64, cos: f64) -> f64 {
    let x = 1.0 - cos;
    f0 + (1.0 - f0) * (x * x * x * x * x)
}
