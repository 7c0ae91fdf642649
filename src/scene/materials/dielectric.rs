//! Clear and coloured solids: what a file says of one, and what becomes of its boundary.

use super::{IndexSource, RoughnessSource};
use crate::bsdf::conductor::MIRROR_ALPHA;
use crate::fresnel::FresnelModel;
use crate::scene::MediumId;
use serde::Deserialize;
use toml::Spanned;

/// A clear or coloured solid such as glass, water or a gem. Smooth unless one of the two words for
/// roughness is given. Solids may be in each other, however many. Faces that coincide are in
/// optical contact: two clear solids that touch have one boundary, and something opaque that lies
/// on a face (a sheet, or a solid with a face in common) covers it, whatever the order of the
/// objects. From outside it is seen in front of the glass, from within as in the glass; a lamp
/// shines into the glass from the side that faces it. A gap of 1e-5 of their size puts air between.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dielectric {
    /// Where its k exceeds 0.001 it shows in what is reflected, too.
    pub ior: Spanned<IndexSource>,
    /// From the k of `ior` unless given.
    pub absorption: Option<Spanned<AbsorptionSource>>,
    /// GGX α, 0…1.
    pub roughness: Option<Spanned<RoughnessSource>>,
    /// r with α = r².
    pub perceptual_roughness: Option<Spanned<RoughnessSource>>,
    /// `exact` unless given.
    pub fresnel: Option<FresnelModel>,
}

/// A data set's name or file, or one coefficient for all wavelengths.
#[derive(Debug)]
pub enum AbsorptionSource {
    Name(String),
    /// In m⁻¹, natural base.
    PerMetre(f64),
}

/// The boundary of a closed solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interface {
    /// What fills the solid.
    pub medium: MediumId,
    /// GGX α of its surface; of a picture, the largest.
    pub alpha: f32,
    pub model: FresnelModel,
}

impl Interface {
    /// Returns whether it scatters all lanes one way, instead of parting them into directions of their own.
    #[inline]
    pub fn is_rough(&self) -> bool {
        self.alpha >= MIRROR_ALPHA
    }

    /// Returns what it is, for people.
    pub fn describe(&self) -> String {
        let Self { alpha, model, .. } = self;
        match self.is_rough() {
            false => format!("dielectric, {model} Fresnel"),
            true => format!("dielectric of roughness {alpha}, {model} Fresnel"),
        }
    }
}
