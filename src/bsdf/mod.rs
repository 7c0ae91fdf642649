//! Light at a surface, in the local frame: z is the normal, ωo the direction to the viewer, ωi to the light.
//!
//! A `Bsdf` is made per hit from the material and the wavelengths of the path, then asked three verbs: `sample`, `eval`, and
//! whether it `is_delta`. Smooth dielectrics, where lanes part, are not a lobe but directions (`dielectric`) and a choice (`branch`);
//! rough ones (`rough_dielectric`) send all lanes one way, to either side.

pub mod albedo;
pub mod branch;
pub mod conductor;
pub mod dielectric;
mod diffuse;
mod ggx;
pub mod rough_dielectric;

pub use branch::{Choice, choose, keep_refracted};
pub use rough_dielectric::RoughDielectric;

use crate::fresnel::Fresnel;
use crate::math::Lanes;
use glam::Vec3;

/// How a surface scatters, for the wavelengths of one path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bsdf<const N: usize> {
    /// Lambert, reflectance 0…1.
    Diffuse { reflectance: Lanes<N> },
    /// GGX facets of roughness α in 0…1; 0 is a mirror.
    Conductor { fresnel: Fresnel<N>, alpha: f32 },
}

/// A direction chosen by the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<const N: usize> {
    pub wi: Vec3,
    /// f cos θ_i/pdf.
    pub weight: Lanes<N>,
    /// In sr⁻¹; 1 for a delta lobe.
    pub pdf: f32,
    /// A single direction: `eval` knows nothing of it.
    pub delta: bool,
}

/// Scattering between two given directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eval<const N: usize> {
    /// f cos θ_i in sr⁻¹.
    pub f_cos: Lanes<N>,
    /// Density in sr⁻¹ with which `sample` chooses ωi.
    pub pdf: f32,
}

impl<const N: usize> Bsdf<N> {
    /// A direction for `u` in [0, 1)², given ωo with z > 0. None where the facet met would send light into the surface:
    /// that sample weighs zero.
    #[inline]
    pub fn sample(&self, wo: Vec3, u: [f32; 2]) -> Option<Sample<N>> {
        if wo.z <= 0.0 {
            return None;
        }
        match self {
            Self::Diffuse { reflectance } => diffuse::sample(reflectance, u),
            Self::Conductor { fresnel, alpha } => conductor::sample(fresnel, *alpha, wo, u),
        }
    }

    /// What is scattered from ωi to ωo; zero below the surface and for delta lobes.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Eval<N> {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return Eval { f_cos: Lanes::ZERO, pdf: 0.0 };
        }
        match self {
            Self::Diffuse { reflectance } => diffuse::eval(reflectance, wi),
            Self::Conductor { fresnel, alpha } => conductor::eval(fresnel, *alpha, wo, wi),
        }
    }

    /// Whether all of it is a single direction, so that lights cannot be aimed at through it.
    #[inline]
    pub fn is_delta(&self) -> bool {
        match self {
            Self::Diffuse { .. } => false,
            Self::Conductor { alpha, .. } => *alpha < conductor::MIRROR_ALPHA,
        }
    }
}
