//! How an RGB model acts on the wavelengths of a path.
//!
//! ```text
//! F(λ, θ) = F_r(θ) b_r(λ) + F_g(θ) b_g(λ) + F_b(θ) b_b(λ)
//! ```
//!
//! - b are three reflectances whose colours under D65 are the primaries of linear sRGB, smooth, within 0…1 and with the sum 1 at every wavelength
//!   (`spectrum::srgb_primaries`; I. Mallett & C. Yuksel, "Spectral primary decomposition for rendering with sRGB reflectance", 2019).
//!   The sum is linear in the colour, so that after one bounce under D65 the picture holds the very RGB of the model at every angle, and grey
//!   is grey. Under other lights and after more bounces it is one of the many spectra of that colour, not that of the material.
//! - A colour above 1, such as gold's red, reflects more light than falls on it; so does an RGB engine with that colour. At a lossless
//!   interface, where what is not reflected goes on, shares are kept within 0…1.
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids, eight lanes): `schlick-rgb` takes 11 ns at a hit, of which its three
//!   channels are 2; the rest is spreading them.

use super::absorbing::Absorbing;
use super::{Dielectric, RgbCurve, SpectralCurve, SpectralModel, dielectric};
use crate::math::Lanes;

/// The reflectance curve at a hit: one model, all lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fresnel<const N: usize> {
    Spectral(SpectralCurve<N>),
    Rgb(RgbFresnel<N>),
}

impl<const N: usize> Fresnel<N> {
    /// Unpolarised reflectance of all lanes at one cos θ_i.
    #[inline]
    pub fn reflectance(&self, cos_theta_i: f32) -> Lanes<N> {
        match self {
            Self::Spectral(curve) => curve.reflectance(cos_theta_i),
            Self::Rgb(rgb) => rgb.reflectance(cos_theta_i),
        }
    }
}

impl<const N: usize> From<SpectralCurve<N>> for Fresnel<N> {
    #[inline]
    fn from(curve: SpectralCurve<N>) -> Self {
        Self::Spectral(curve)
    }
}

/// An RGB model at the wavelengths of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RgbFresnel<const N: usize> {
    pub curve: RgbCurve,
    /// b_r, b_g and b_b.
    pub primaries: [Lanes<N>; 3],
}

impl<const N: usize> RgbFresnel<N> {
    /// Not below 0.
    #[inline]
    pub fn reflectance(&self, cos_theta_i: f32) -> Lanes<N> {
        let rgb = self.curve.reflectance(cos_theta_i);
        let [r, g, b] = self.primaries;
        (r * rgb[0] + g * rgb[1] + b * rgb[2]).map(|value| value.max(0.0))
    }

    pub(super) fn lane(&self, lane: usize) -> RgbFresnel<1> {
        RgbFresnel { curve: self.curve, primaries: self.primaries.map(|primary| Lanes([primary[lane]])) }
    }

    /// As [`super::Model::dielectric`]; the curve is fitted on the rarer side.
    fn dielectric(&self, n1: &Lanes<N>, n2: &Lanes<N>, cos_theta_i: &Lanes<N>) -> Dielectric<N> {
        let cos_theta_t = dielectric::cos_theta_t(n1, n2, cos_theta_i);
        let rarer = dielectric::on_the_rarer_side(n1, n2, cos_theta_i, &cos_theta_t);
        // From the rarer side, and before lanes part, one angle is that of all.
        let curve = match rarer.0.iter().all(|cos| *cos == rarer[0]) {
            true => self.reflectance(rarer[0]),
            false => Lanes::from_fn(|lane| self.lane(lane).reflectance(rarer[lane])[0]),
        };
        dielectric::bounded(n1, n2, &curve, cos_theta_t)
    }
}

/// A model at the interface of two media.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DielectricFresnel<const N: usize> {
    Spectral(SpectralModel),
    Rgb(RgbFresnel<N>),
    /// One of the media absorbs so much that it shows in what is reflected.
    Absorbing(Absorbing<N>),
}

impl<const N: usize> From<SpectralModel> for DielectricFresnel<N> {
    fn from(model: SpectralModel) -> Self {
        Self::Spectral(model)
    }
}

impl<const N: usize> DielectricFresnel<N> {
    /// Reflectance and refraction angle from n1 to n2, cosines lane by lane.
    #[inline]
    pub fn at(&self, n1: &Lanes<N>, n2: &Lanes<N>, cos_theta_i: &Lanes<N>) -> Dielectric<N> {
        match self {
            Self::Spectral(model) => model.dielectric(n1, n2, cos_theta_i),
            Self::Rgb(rgb) => rgb.dielectric(n1, n2, cos_theta_i),
            Self::Absorbing(absorbing) => absorbing.at(n1, n2, cos_theta_i),
        }
    }

    /// The same for one lane alone.
    #[inline]
    pub fn lane(&self, lane: usize) -> DielectricFresnel<1> {
        match self {
            Self::Spectral(model) => DielectricFresnel::Spectral(*model),
            Self::Rgb(rgb) => DielectricFresnel::Rgb(rgb.lane(lane)),
            Self::Absorbing(absorbing) => DielectricFresnel::Absorbing(absorbing.lane(lane)),
        }
    }
}
