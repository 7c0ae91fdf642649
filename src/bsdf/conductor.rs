//! A metal surface: GGX facets of roughness α, each reflecting by a Fresnel curve; a mirror below [`MIRROR_ALPHA`].
//!
//! ```text
//! f(ωo, ωi) = F(ωo·h) D(h) G2(ωo, ωi)/(4 z_o z_i)
//! ```
//!
//! - Source: R. Cook & K. Torrance, "A reflectance model for computer graphics" (1982), with the parts of `ggx`.
//! - Single scattering only: what facets reflect into each other is lost, MEASURED_LOSS at α = 1.
//! - Conventions: local frame, z the normal; ωo·h = |ωo + ωi|/2, so no half-vector is normalised.
//! - Error: TBD
//! - Cost (`benches/bsdf.rs`): TBD

use super::{Eval, Sample, ggx};
use crate::fresnel::Fresnel;
use crate::spectrum::Lanes;
use glam::Vec3;

/// Below this α the surface is a mirror.
pub const MIRROR_ALPHA: f32 = 1e-4;

#[inline]
pub(super) fn sample<const N: usize>(fresnel: &Fresnel<N>, alpha: f32, wo: Vec3, u: [f32; 2]) -> Option<Sample<N>> {
    if alpha < MIRROR_ALPHA {
        return Some(mirror(fresnel, wo));
    }
    let visible = ggx::Visible::new(wo, alpha);
    let normal = visible.sample_normal(u);
    let length_squared = normal.length_squared();
    let projected = wo.dot(normal);
    let wi = normal * (2.0 * projected / length_squared) - wo;
    if !(wi.z > 0.0 && projected > 0.0) {
        return None;
    }
    let reflectance = fresnel.reflectance((projected / length_squared.sqrt()).min(1.0));
    let pdf = visible.pdf(ggx::density(normal, alpha));
    Some(Sample { wi, weight: reflectance * visible.weight(wi), pdf, delta: false })
}

fn mirror<const N: usize>(fresnel: &Fresnel<N>, wo: Vec3) -> Sample<N> {
    let wi = Vec3::new(-wo.x, -wo.y, wo.z);
    Sample { wi, weight: fresnel.reflectance(wo.z.min(1.0)), pdf: 1.0, delta: true }
}

#[inline]
pub(super) fn eval<const N: usize>(fresnel: &Fresnel<N>, alpha: f32, wo: Vec3, wi: Vec3) -> Eval<N> {
    if alpha < MIRROR_ALPHA {
        return Eval { f_cos: Lanes::ZERO, pdf: 0.0 };
    }
    let visible = ggx::Visible::new(wo, alpha);
    let half = wo + wi;
    let density = ggx::density(half, alpha);
    let reflectance = fresnel.reflectance((0.5 * half.length()).min(1.0));
    Eval { f_cos: reflectance * visible.reflected(wi, density), pdf: visible.pdf(density) }
}
