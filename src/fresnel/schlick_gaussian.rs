//! Schlick's approximation in RGB with its fifth power replaced by a power of two, which old graphics processors had in hardware.
//!
//! ```text
//! F(θ) = F0 + (1 − F0) 2^((−5.55473 c − 6.98316) c),   c = cos θ;   F0 the exact colour at normal incidence
//! ```
//!
//! - Source: B. Karis, "Real Shading in Unreal Engine 4" (SIGGRAPH 2013 course notes), from S. Lagarde, "Spherical Gaussian approximation for
//!   Blinn-Phong, Phong and Fresnel" (2012).
//! - 2^(−12.54) of 1 − F0 is left at normal incidence: 1.7e-4.
//! - Error against `exact` (`tests/it/fresnel/errors.rs`; mean and largest ΔE2000 over the angles): that of `schlick-rgb` within 0.02
//!   for metals, 0.1 less for diamond.
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids): 13 ns for eight lanes at a hit: the power of two costs more than Schlick's.

use super::schlick_rgb::single;
use super::{Rgb, Target};
use crate::math::Lanes;

/// The curve of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SchlickGaussian {
    pub f0: Lanes<3>,
}

impl Rgb for SchlickGaussian {
    fn fit(target: &Target) -> Self {
        Self { f0: single(target.f0()) }
    }

    #[inline]
    fn reflectance(&self, cos_theta_i: f32) -> Lanes<3> {
        let rise = libm::exp2f((-5.55473 * cos_theta_i - 6.98316) * cos_theta_i);
        self.f0.map(|f0| f0 + (1.0 - f0) * rise)
    }
}
