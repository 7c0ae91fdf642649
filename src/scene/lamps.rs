//! Spectra of lamps, as scenes give them.

use super::numbers::{Number, Numbers};
use serde::Deserialize;
use toml::Spanned;

/// An illuminant's name or file, or a spectrum of its own.
#[derive(Debug)]
pub enum LightSpectrum {
    Name(String),
    Own(OwnLight),
}

/// A spectrum that the scene states itself.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OwnLight {
    /// Colour temperature in K.
    Blackbody(Number),
    /// CIE daylight of this correlated colour temperature in K.
    Daylight(Number),
    Table(OwnTable),
    /// Emission lines as [wavelength in nm, relative power].
    Lines(Vec<Spanned<Numbers<2>>>),
}

/// Linear between its points and without light outside them.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OwnTable {
    /// Growing.
    pub wavelength_nm: Vec<Spanned<f64>>,
    /// As many as wavelengths; in W m⁻² sr⁻¹ nm⁻¹ if `scale` is given, in any unit otherwise.
    pub value: Vec<Spanned<f64>>,
}
