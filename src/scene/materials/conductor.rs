//! Metals: what a file says of one, and what becomes of it.

use super::{IndexSource, RoughnessSource};
use crate::bsdf::conductor::MIRROR_ALPHA;
use crate::fresnel::FresnelModel;
use crate::spectrum::SpectrumId;
use serde::Deserialize;
use toml::Spanned;

/// A metal: it reflects at its surface, and what enters is lost. Smooth unless one of the two words for roughness is given.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Conductor {
    pub ior: Spanned<IndexSource>,
    /// GGX α, 0…1.
    pub roughness: Option<Spanned<RoughnessSource>>,
    /// r with α = r².
    pub perceptual_roughness: Option<Spanned<RoughnessSource>>,
    /// `exact` unless given.
    pub fresnel: Option<Spanned<FresnelModel>>,
}

/// The surface of a metal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metal {
    pub n: SpectrumId,
    pub k: SpectrumId,
    /// GGX α; of a picture, the largest.
    pub alpha: f32,
    pub model: FresnelModel,
}

impl Metal {
    /// Returns whether it is a mirror.
    pub fn is_smooth(&self) -> bool {
        self.alpha < MIRROR_ALPHA
    }

    /// Returns what it is, for people.
    pub fn describe(&self) -> String {
        let Self { alpha, model, .. } = self;
        match self.is_smooth() {
            true => format!("smooth conductor, {model} Fresnel"),
            false => format!("conductor of roughness {alpha}, {model} Fresnel"),
        }
    }
}
