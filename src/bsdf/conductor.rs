//! A metal surface: GGX facets of roughness α, each reflecting by a Fresnel curve; a mirror below [`MIRROR_ALPHA`].
//!
//! ```text
//! f(ωo, ωi) = F(ωo·h) D(h) G2(ωo, ωi)/(4 z_o z_i)
//! ```
//!
//! - Source: R. Cook & K. Torrance, "A reflectance model for computer graphics" (1982), with the parts of `ggx`.
//! - Single scattering only: what facets reflect into each other is lost: ln 2 = 69 % of a white surface at α = 1, ωo = z;
//!   1.2 % at α = 0.1.
//! - Conventions: local frame, z the normal; ωo·h = |ωo + ωi|/2, so no half-vector is normalised.
//! - Error: albedo by sampling against `albedo` to 1e-4 (`tests/it/bsdf/energy.rs`); samples follow the density by χ² from α = 1e-3 to 1, 0 to 89°
//!   (`tests/it/bsdf/chi_squared.rs`). D of directions rounded to f32, α = 1e-3: to 1e-4 at 60°, 2.5e-3 at 89°, 3e-2 at 89.9°, without bias.
//! - Cost (`benches/bsdf.rs`, eight lanes): sample 24 ns with Schlick, 40–50 ns exact; eval 8 and 23–27 ns; mirror 4 and 18–20 ns.

use super::{Draw, Eval, Lobe, Sample, Scatters, ggx};
use crate::fresnel::Fresnel;
use glam::Vec3;

/// Below this α the surface is a mirror.
///
/// At 1e-4 the highlight is 1.3e-4 rad wide from its centre to half its height: half an arc minute, less than a pixel of a
/// 40° camera 4,000 pixels wide. The albedo differs from the mirror's by 3e-7 up to 80° and 3e-5 at 89° (`tests/it/bsdf/energy.rs`), and f32
/// directions still resolve the lobe (steps of 6e-8). So nothing jumps at the switch; below it, resolution would be lost for nothing.
pub const MIRROR_ALPHA: f32 = 1e-4;

/// A metal whose facets reflect by a Fresnel curve, of roughness α in 0…1; 0 is a mirror.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor<const N: usize> {
    pub fresnel: Fresnel<N>,
    pub alpha: f32,
}

impl<const N: usize> Conductor<N> {
    fn mirror(&self, wo: Vec3) -> Sample<N> {
        let wi = Vec3::new(-wo.x, -wo.y, wo.z);
        Sample { wi, weight: self.fresnel.reflectance(wo.z.min(1.0)), pdf: 1.0, lobe: Lobe::Mirror }
    }
}

impl<const N: usize> Scatters<N> for Conductor<N> {
    #[inline]
    fn sample(&self, wo: Vec3, Draw { uv, .. }: Draw) -> Option<Sample<N>> {
        if self.is_delta() {
            return Some(self.mirror(wo));
        }
        let visible = ggx::Visible::new(wo, self.alpha);
        let normal = visible.sample_normal(uv);
        let length_squared = normal.length_squared();
        let projected = wo.dot(normal);
        let wi = normal * (2.0 * projected / length_squared) - wo;
        if !(wi.z > 0.0 && projected > 0.0) {
            return None;
        }
        let reflectance = self.fresnel.reflectance((projected / length_squared.sqrt()).min(1.0));
        let pdf = visible.pdf(ggx::density(normal, self.alpha));
        Some(Sample { wi, weight: reflectance * visible.weight(wi), pdf, lobe: Lobe::Reflection })
    }

    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Eval<N> {
        if self.is_delta() {
            return Eval::NONE;
        }
        let visible = ggx::Visible::new(wo, self.alpha);
        let half = wo + wi;
        let density = ggx::density(half, self.alpha);
        let reflectance = self.fresnel.reflectance((0.5 * half.length()).min(1.0));
        Eval { f_cos: reflectance * visible.reflected(wi, density), pdf: visible.pdf(density) }
    }

    #[inline]
    fn is_delta(&self) -> bool {
        self.alpha < MIRROR_ALPHA
    }
}
