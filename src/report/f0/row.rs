//! One data set of a material, measured: its colours at four kinds of incidence, and what stands behind them.
//!
//! ```text
//! F0 = F(c = 1)   F82 = F(cos 82°)   F(1/7), where Hoffman's and Adobe's models have their second colour   F_avg = 2 ∫₀¹ F(c) c dc
//! ```
//!
//! - Source: `fresnel::exact` from vacuum, for every wavelength that the instrument counts.
//! - F_avg by 16-point Gauss–Legendre in t with c = t², which gathers points where metals dip. Error against the adaptive rule
//!   (`tests/it/report/f0_tables.rs`): 4e-10 in linear sRGB for every data set of the library but air, 4e-8 there, whose F rises within 1° of grazing.

use super::{Color, Engines, Instrument};
use crate::fresnel::{COS_82, exact};
use crate::math::quadrature;
use crate::spectrum::{About, Confidence, HELIUM_D_NM, Ior, citation};
use serde::Serialize;
use std::sync::Arc;

/// The largest share of what the eye sees that may lie outside a data set before that is said.
const UNCOVERED: f64 = 1e-3;

/// A material and the data set that stands for it.
#[derive(Clone, Debug)]
pub struct Subject {
    pub name: String,
    /// Whether what enters is lost; otherwise it goes on.
    pub conductor: bool,
    pub ior: Arc<Ior>,
    /// Why this data set was chosen, where that is known.
    pub why: Option<String>,
}

/// A row of an F0 table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    pub name: String,
    /// The name of the data set.
    pub ior: String,
    pub class: &'static str,
    /// n and k at [`HELIUM_D_NM`].
    pub n_d: f64,
    pub k_d: f64,
    pub f0: Color,
    pub f82: Color,
    pub f_mu17: Color,
    pub f_avg: Color,
    /// Y of F0; a perfect reflector has 1.
    pub luminance: f64,
    /// For dielectrics.
    pub specular: Option<Specular>,
    pub engines: Engines,
    pub source: Provenance,
}

/// What the renderers' scalars for a dielectric would be without their limits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Specular {
    /// F0 / 0.08: `Specular` of Unreal, `specular` of Disney.
    pub level: f64,
    /// √(F0 / 0.16): `reflectance` of Filament.
    pub reflectance: f64,
    /// n_d: `ior` of glTF, `specular_ior` of OpenPBR.
    pub ior: f64,
}

/// Who measured, and how far it reaches.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Provenance {
    pub title: String,
    pub authors: String,
    pub journal: Option<String>,
    pub year: Option<i32>,
    pub doi: Option<String>,
    pub sample: String,
    pub confidence: String,
    /// Wavelengths that the data cover, nm; `None`: everywhere.
    pub range_nm: Option<(f64, f64)>,
    /// Whether less than 0.1 % of what the eye sees lies outside of it, where ends are held or a formula is extrapolated.
    pub covers_visible: bool,
    /// Why this set stands for its material, where that was a choice.
    pub why: Option<String>,
}

impl Row {
    pub fn new(subject: &Subject, instrument: &Instrument) -> Self {
        let Subject { name, conductor, ior, why } = subject;
        let curves: Vec<Curve> = instrument.wavelengths_nm().map(|nm| Curve::new(ior.at(nm))).collect();
        let color = |pick: fn(&Curve) -> f64| instrument.color(instrument.rgb(curves.iter().map(pick)));
        let (f0, f_mu17) = (color(|curve| curve.f0), color(|curve| curve.f_mu17));
        let luminance = instrument.luminance(curves.iter().map(|curve| curve.f0));
        let (n_d, k_d) = ior.at(HELIUM_D_NM);
        let specular = (!conductor).then(|| Specular::new(luminance, n_d));
        Self {
            engines: Engines::new(&f0, &f_mu17, specular, instrument.conditions.space),
            name: name.clone(),
            ior: ior.about.name.clone(),
            class: if *conductor { "conductor" } else { "dielectric" },
            n_d,
            k_d,
            f0,
            f82: color(|curve| curve.f82),
            f_mu17,
            f_avg: color(|curve| curve.f_avg),
            luminance,
            specular,
            source: Provenance::new(&ior.about, why.clone(), instrument),
        }
    }
}

/// The reflectances of one wavelength.
struct Curve {
    f0: f64,
    f82: f64,
    f_mu17: f64,
    f_avg: f64,
}

impl Curve {
    fn new((n, k): (f64, f64)) -> Self {
        let f = |cos: f64| exact::reflect(1.0, n, k, cos).r;
        let weighted = |t: f64| 4.0 * t * t * t * f(t * t);
        Self {
            f0: f(1.0),
            f82: f(libm::cos(82.0_f64.to_radians())),
            f_mu17: f(COS_82),
            f_avg: quadrature::gauss(&mut { weighted }, 0.0, 1.0),
        }
    }
}

impl Specular {
    fn new(f0: f64, ior: f64) -> Self {
        Self { level: f0 / 0.08, reflectance: (f0 / 0.16).sqrt(), ior }
    }
}

impl Provenance {
    fn new(about: &About, why: Option<String>, instrument: &Instrument) -> Self {
        let About { source, sample, range_nm, .. } = about.clone();
        Self {
            title: source.title,
            authors: source.authors,
            journal: source.journal,
            year: source.year,
            doi: source.doi,
            sample: sample.description,
            confidence: sample.confidence.to_string(),
            covers_visible: instrument.share_outside(range_nm) <= UNCOVERED,
            range_nm,
            why,
        }
    }
}

impl Provenance {
    /// First author and year.
    pub fn citation(&self) -> String {
        citation(&self.authors, self.year)
    }

    /// Whether its numbers are known to be poor.
    pub fn is_doubtful(&self) -> bool {
        [Confidence::Low, Confidence::Modelled].iter().any(|poor| poor.to_string() == self.confidence)
    }
}
