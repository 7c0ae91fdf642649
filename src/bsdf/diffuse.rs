//! A Lambertian surface: as bright from everywhere, sampled by the cosine.
//!
//! ```text
//! f = ρ/π        pdf = cos θ_i/π        f cos θ_i / pdf = ρ
//! ```
//!
//! - Source: J. H. Lambert, *Photometria* (1760). The sample is a disk point lifted onto the hemisphere (N. Malley, 1988).
//! - Valid for 0 ≤ ρ ≤ 1; conserves energy and is reciprocal exactly.

use super::{Draw, Eval, Lobe, Sample, Scatters};
use crate::math::{Lanes, cos_sin};
use glam::Vec3;
use std::f32::consts::FRAC_1_PI;

/// A Lambertian surface of reflectance 0…1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diffuse<const N: usize> {
    pub reflectance: Lanes<N>,
}

impl<const N: usize> Scatters<N> for Diffuse<N> {
    #[inline]
    fn sample(&self, _: Vec3, Draw { uv: u, .. }: Draw) -> Option<Sample<N>> {
        let (cos, sin) = cos_sin(u[0]);
        let radius = u[1].sqrt();
        let wi = Vec3::new(radius * cos, radius * sin, (1.0 - u[1]).sqrt());
        let pdf = wi.z * FRAC_1_PI;
        (wi.z > 0.0).then_some(Sample { wi, weight: self.reflectance, pdf, lobe: Lobe::Reflection })
    }

    #[inline]
    fn eval(&self, _: Vec3, wi: Vec3) -> Eval<N> {
        let pdf = wi.z * FRAC_1_PI;
        Eval { f_cos: self.reflectance * pdf, pdf }
    }

    fn softens_terminator(&self) -> bool {
        true
    }
}
