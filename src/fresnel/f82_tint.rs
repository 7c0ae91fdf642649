//! F82 as a colour that multiplies Schlick's at cos θ = 1/7: what artists set in Standard Surface, OpenPBR and MaterialX.
//!
//! ```text
//! F(θ) = S(θ) − b c (1 − c)⁶,   S(θ) = F0 + (1 − F0)(1 − c)⁵,   c = cos θ
//! b = S(1/7)(1 − t) / ((1/7)(6/7)⁶);   F0 and t = F(1/7)/S(1/7) clipped to 0…1
//! ```
//!
//! - Source: P. Kutz, M. Hašan & D. Edmondson, "Novel aspects of the Adobe Standard Material" (2021), section 2.4; OpenPBR 1.1, `specular_color`.
//! - The bounds keep it within 0…1 and lose colours: gold's red, 1.04, becomes 1.
//! - Error against `exact` (`tests/it/fresnel/errors.rs`; mean and largest ΔE2000 over the angles): that of `f82` where the colour is within
//!   0…1; gold 1.1 and 1.4, copper 1.4 and 1.8.
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids): that of `f82`.

use super::f82::F82;
use super::schlick_rgb::curve;
use super::target::COS_82;
use super::{Rgb, Target};
use crate::math::Lanes;

/// The curve of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct F82Tint(pub F82);

impl Rgb for F82Tint {
    fn fit(target: &Target) -> Self {
        let (f0, tint) = f82_tint(target.f0(), target.f82());
        Self(F82::through(f0, std::array::from_fn(|i| tint[i] * curve(f0[i], COS_82))))
    }

    #[inline]
    fn reflectance(&self, cos_theta_i: f32) -> Lanes<3> {
        self.0.reflectance(cos_theta_i)
    }
}

/// (F0, t) of two exact colours: at normal incidence and at c = 1/7.
pub fn f82_tint(f0: [f64; 3], f82: [f64; 3]) -> ([f64; 3], [f64; 3]) {
    let f0 = f0.map(|channel| channel.clamp(0.0, 1.0));
    (f0, std::array::from_fn(|i| (f82[i] / curve(f0[i], COS_82)).clamp(0.0, 1.0)))
}
