//! A rough interface between two clear media: GGX facets of roughness α that each reflect or refract, one direction for all lanes.
//!
//! ```text
//! reflection   h = ωo + ωi                       p_j = R_j D(h) / (2 (z_o + t_o))
//! refraction   h_j = ±(n1 ωo + n2 ωi)            p_j = (1 − R_j) D(h_j) 2 n2² c_o c_t / (|h_j|² (z_o + t_o))
//! f_i cos θ_i = p_i G2/G1(ωo)                    weight_i = p_i / mean_j p_j · G2/G1(ωo)
//! ```
//!
//! - n1 is the index on the side of ωo, n2 beyond; c_o, c_t are the cosines of ωo and ωi against lane j's own facet; z, t as in `ggx`.
//!   A lane for which ωo → ωi is no refraction has p = f = 0.
//! - A direction is that of one lane, chosen uniformly; its density is the mean over all lanes: A. Wilkie et al., "Hero wavelength
//!   spectral sampling" (2014). No weight exceeds N, and with one lane it is G2/G1 ≤ 1 without D.
//! - Sources: B. Walter et al., "Microfacet models for refraction through rough surfaces" (2007), eqs. 16, 17, 20, 21; normals visible
//!   from ωo by J. Dupuy & A. Benyoub (2023). G2 of reflection is height-correlated; seen from both sides of the surface heights are
//!   anti-correlated, G2 = B(1 + Λo, 1 + Λi): E. Heitz et al., "Multiple-scattering microfacet BSDFs with the Smith model" (2016), eq. 19.
//!   1/(1 + Λo + Λi), often used there too, is the form for one side and transmits too much.
//! - Radiance transport without compression: f conserves radiance over n², so a lossless surface keeps Σ weight ≤ 1 both ways and
//!   f(ωo → ωi)/n2² = f(ωi → ωo)/n1². The renderer divides by n² where light joins the path.
//! - Single scattering only: what facets send to other facets is lost (`albedo::dielectric` says how much).
//! - Error (`tests/it/bsdf/rough_dielectric.rs`): both lobes by sampling against `albedo::dielectric` to 5e-4 of the incident light, α 1e-3 to 1,
//!   0 to 85°; samples follow the mean density by χ² of one and of four lanes; differs from the smooth interface by 7e-6 at its threshold up to 80°.
//! - Cost (`benches/bsdf.rs`, eight lanes): sample 210 ns, eval 80 ns in the mean of both lobes; the Beta function in f64 is part of it.
//! - Valid for α from `conductor::MIRROR_ALPHA` to 1 (below it the smooth interface takes over) and for any n; see `part` for equal indices.

use super::dielectric::refract;
use super::{Draw, Eval, Lobe, Sample, Scatters, Sides, ggx};
use crate::fresnel::DielectricFresnel;
use crate::math::Lanes;
use glam::Vec3;

/// The interface as seen from one side, for the wavelengths of one path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughDielectric<const N: usize> {
    n1: Lanes<N>,
    n2: Lanes<N>,
    alpha: f32,
    fresnel: DielectricFresnel<N>,
}

impl<const N: usize> RoughDielectric<N> {
    /// From n1, where ωo is, to n2, with facets of roughness α.
    #[inline]
    pub fn new(fresnel: DielectricFresnel<N>, n1: &Lanes<N>, n2: &Lanes<N>, alpha: f32) -> Self {
        Self { n1: *n1, n2: n1.zip(*n2, |n1, n2| part(n1, n2, alpha)), alpha, fresnel }
    }

    /// Density of ωi for each lane if its own were always chosen.
    #[inline]
    fn densities(&self, visible: &ggx::Visible, wi: Vec3) -> Lanes<N> {
        if wi.z < 0.0 {
            return self.refracted(visible, wi);
        }
        let half = visible.wo() + wi;
        let r = self.fresnel.at(&self.n1, &self.n2, &Lanes::splat((0.5 * half.length()).min(1.0))).r;
        r * visible.pdf(ggx::density(half, self.alpha))
    }

    #[inline]
    fn refracted(&self, visible: &ggx::Visible, wi: Vec3) -> Lanes<N> {
        let (wo, unit) = (visible.wo(), visible.pdf(4.0));
        let (mut cos, mut density) = (Lanes::ZERO, Lanes::ZERO);
        for lane in 0..N {
            let (n1, n2) = (self.n1[lane], self.n2[lane]);
            let half = (wo * n1 + wi * n2) * if n1 > n2 { 1.0 } else { -1.0 };
            let inverse = 1.0 / (half.length_squared() + f32::MIN_POSITIVE).sqrt();
            let (c_o, c_t) = (wo.dot(half) * inverse, -wi.dot(half) * inverse);
            let n2 = n2 * inverse;
            let possible = half.z > 0.0 && c_o > 0.0 && c_t > 0.0;
            let value = unit * ggx::density(half, self.alpha) * c_o * c_t * n2 * n2;
            cos[lane] = c_o.clamp(0.0, 1.0);
            density[lane] = if possible { value } else { 0.0 };
        }
        let r = self.fresnel.at(&self.n1, &self.n2, &cos).r;
        (Lanes::ONE - r) * density
    }

    /// G2/G1(ωo): the share of light from facets seen from ωo that gets away to ωi.
    #[inline]
    fn kept(&self, visible: &ggx::Visible, wi: Vec3) -> f32 {
        if wi.z > 0.0 { visible.weight(wi) } else { visible.weight_below(wi) }
    }
}

impl<const N: usize> Scatters<N> for RoughDielectric<N> {
    /// Chooses the facet by `uv`, and by `lobe` the lane and whether that one reflects.
    #[inline]
    fn sample(&self, wo: Vec3, Draw { lobe, uv }: Draw) -> Option<Sample<N>> {
        let visible = ggx::Visible::all(wo, self.alpha);
        let normal = visible.sample_normal(uv).normalize();
        let projected = wo.dot(normal);
        let (lane, choice) = lane_of::<N>(lobe);
        let (n1, n2) = (self.n1[lane], self.n2[lane]);
        let facet = self.fresnel.lane(lane).at(&Lanes([n1]), &Lanes([n2]), &Lanes([projected.clamp(0.0, 1.0)]));
        let reflects = choice < facet.r[0];
        // What an absorbing medium keeps of total reflection.
        if !reflects && facet.cos_theta_t[0] == 0.0 {
            return None;
        }
        let wi = match reflects {
            true => normal * (2.0 * projected) - wo,
            false => refract(-wo, normal, n1 / n2, projected, facet.cos_theta_t[0]).normalize(),
        };
        if !(projected > 0.0 && if reflects { wi.z > 0.0 } else { wi.z < 0.0 }) {
            return None;
        }
        let densities = self.densities(&visible, wi);
        let pdf = densities.mean();
        let lobe = if reflects { Lobe::Reflection } else { Lobe::Transmission };
        (pdf > 0.0).then(|| Sample { wi, weight: densities * (self.kept(&visible, wi) / pdf), pdf, lobe })
    }

    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Eval<N> {
        let visible = ggx::Visible::all(wo, self.alpha);
        let densities = self.densities(&visible, wi);
        let pdf = densities.mean();
        if pdf == 0.0 {
            return Eval::NONE;
        }
        Eval { f_cos: densities * self.kept(&visible, wi), pdf }
    }

    fn sides(&self) -> Sides {
        Sides::Both
    }

    fn has_lobes(&self) -> bool {
        true
    }
}

/// n2 held apart from n1 as far as f32 needs to tell facets by the light they refract.
///
/// Media of one index let light pass straight on, a direction without density. They are parted until the refracted lobe is about
/// 1e-5 rad wide, but by no more than 1e-4: light turns by less than that, the width of what `conductor::MIRROR_ALPHA` calls a mirror.
#[inline]
fn part(n1: f32, n2: f32, alpha: f32) -> f32 {
    let least = n1 * (1e-5 / alpha).min(1e-4);
    let difference = n2 - n1;
    if difference.abs() < least { n1 + least.copysign(difference) } else { n2 }
}

/// The lane that a number in [0, 1) stands for, and the number again, uniform within it.
#[inline]
fn lane_of<const N: usize>(u: f32) -> (usize, f32) {
    let scaled = u * N as f32;
    let lane = (scaled as usize).min(N - 1);
    (lane, scaled - lane as f32)
}
