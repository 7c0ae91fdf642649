//! A Lambertian surface: as bright from everywhere, sampled by the cosine.
//!
//! ```text
//! f = ρ/π        pdf = cos θ_i/π        f cos θ_i / pdf = ρ
//! ```
//!
//! - Source: J. H. Lambert, *Photometria* (1760). The sample is a disk point lifted onto the hemisphere (N. Malley, 1988).
//! - Valid for 0 ≤ ρ ≤ 1; conserves energy and is reciprocal exactly.

use super::{Eval, Sample};
use crate::math::Lanes;
use crate::math::cos_sin;
use glam::Vec3;
use std::f32::consts::FRAC_1_PI;

/// `u` in [0, 1)² to a direction around z.
#[inline]
pub(super) fn sample<const N: usize>(reflectance: &Lanes<N>, u: [f32; 2]) -> Option<Sample<N>> {
    let (cos, sin) = cos_sin(u[0]);
    let radius = u[1].sqrt();
    let wi = Vec3::new(radius * cos, radius * sin, (1.0 - u[1]).sqrt());
    (wi.z > 0.0).then_some(Sample { wi, weight: *reflectance, pdf: wi.z * FRAC_1_PI, delta: false })
}

#[inline]
pub(super) fn eval<const N: usize>(reflectance: &Lanes<N>, wi: Vec3) -> Eval<N> {
    let pdf = wi.z * FRAC_1_PI;
    Eval { f_cos: *reflectance * pdf, pdf }
}
