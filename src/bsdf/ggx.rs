//! The GGX distribution of facets: density, shadowing and visible normals, isotropic, for reflection.
//!
//! With the unnormalised half-vector h = ωo + ωi, L² = |h|² and z the cosine against the macroscopic normal:
//!
//! ```text
//! D  = (α L²/(α² h_z² + h_x² + h_y²))²/π          t(ω) = √(α²(ω_x² + ω_y²) + ω_z²)
//! G2 = 2 z_o z_i/(z_i t_o + z_o t_i)              (height-correlated Smith)
//! pdf(ωi) = D/(2 (k z_o + t_o))                   k = (1 − α²) s²/(s² + α² z_o²),  s = 1 + √(ω_x² + ω_y²)
//! f cos θ_i = F D z_i/(2 (z_i t_o + z_o t_i))     f cos θ_i/pdf = F z_i (k z_o + t_o)/(z_i t_o + z_o t_i) ≤ F
//! ```
//!
//! - Sources: B. Walter et al., "Microfacet models for refraction through rough surfaces" (2007), eq. 33; E. Heitz, "Understanding
//!   the masking-shadowing function in microfacet-based BRDFs" (2014), eq. 99; J. Dupuy & A. Benyoub, "Sampling visible GGX normals
//!   with spherical caps" (2023), listing 1; Y. Tokuyoshi & K. Eto, "Bounded VNDF sampling for Smith–GGX reflections" (2024), eqs. 5, 6, 8.
//! - Valid for α in (0, 1]. The bound cuts normals that would reflect below the horizon (α = 1 at 89°: 50 % of them without it).
//! - D uses the tangential components of h, never 1 − cos²: at α = 1e-3 in f32 the latter has no correct digit.
//!   The sampler forms 1 − b, 1 − k and 1 ± z from sums of positive terms for the same reason.

use super::turn::cos_sin;
use glam::Vec3;
use std::f32::consts::FRAC_1_PI;

/// What depends on ωo alone.
#[derive(Clone, Copy)]
pub(super) struct Visible {
    wo: Vec3,
    alpha: f32,
    /// t(ωo).
    t: f32,
    /// ω_x² + ω_y² of ωo.
    tangential: f32,
    /// 1 − k: how much of the cap is cut is told by k.
    one_minus_k: f32,
}

impl Visible {
    #[inline]
    pub fn new(wo: Vec3, alpha: f32) -> Self {
        let tangential = wo.x * wo.x + wo.y * wo.y;
        let (alpha2, z2) = (alpha * alpha, wo.z * wo.z);
        let s = 1.0 + tangential.sqrt();
        let s2 = s * s;
        let one_minus_k = alpha2 * (s2 + z2) / (s2 + alpha2 * z2);
        Self { wo, alpha, t: (alpha2 * tangential + z2).sqrt(), tangential, one_minus_k }
    }

    /// k z_o + t_o.
    #[inline]
    fn bound(&self) -> f32 {
        (1.0 - self.one_minus_k) * self.wo.z + self.t
    }

    /// A facet normal seen from ωo, unnormalised, for `u` in [0, 1)².
    #[inline]
    pub fn sample_normal(&self, u: [f32; 2]) -> Vec3 {
        let inverse = 1.0 / self.t;
        let (x, y, z) = (self.alpha * self.wo.x * inverse, self.alpha * self.wo.y * inverse, self.wo.z * inverse);
        let one_minus_z = self.alpha * self.alpha * self.tangential * inverse * inverse / (1.0 + z);
        let one_minus_b = one_minus_z + self.one_minus_k * z;
        // The cap: cosine −b + v (1 + b) with 1 + b = 2 − (1 − b).
        let v = u[1];
        let height = 2.0 - one_minus_b;
        let (above, below) = ((1.0 - v) * height, one_minus_b + v * height);
        let radius = (above * below).sqrt();
        let (cos, sin) = cos_sin(u[0]);
        let up = self.one_minus_k * z + v * height;
        Vec3::new(self.alpha * (x + radius * cos), self.alpha * (y + radius * sin), up)
    }

    /// Density of ωi = reflection of ωo at a facet of density D.
    #[inline]
    pub fn pdf(&self, density: f32) -> f32 {
        density / (2.0 * self.bound())
    }

    /// f cos θ_i/(F pdf), at most 1.
    #[inline]
    pub fn weight(&self, wi: Vec3) -> f32 {
        wi.z * self.bound() / self.smith(wi)
    }

    /// f cos θ_i/F for a facet of density D.
    #[inline]
    pub fn reflected(&self, wi: Vec3, density: f32) -> f32 {
        density * wi.z / (2.0 * self.smith(wi))
    }

    /// z_i t_o + z_o t_i.
    #[inline]
    fn smith(&self, wi: Vec3) -> f32 {
        let t = (self.alpha * self.alpha * (wi.x * wi.x + wi.y * wi.y) + wi.z * wi.z).sqrt();
        wi.z * self.t + self.wo.z * t
    }
}

/// D in sr⁻¹ for a half-vector of any length.
#[inline]
pub(super) fn density(half: Vec3, alpha: f32) -> f32 {
    let tangential = half.x * half.x + half.y * half.y;
    let z2 = half.z * half.z;
    let root = alpha * (tangential + z2) / (alpha * alpha * z2 + tangential);
    root * root * FRAC_1_PI
}
