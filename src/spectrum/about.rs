//! Where a data set comes from and what it holds for: every spectrum that is loaded carries this.

use std::fmt;

use serde::Deserialize;

use super::Spectrum;

/// What a data set describes; each has its folder under `spectra/`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// Complex index of refraction, n + i k.
    Ior,
    /// Reflectance, 0…1.
    Reflectance,
    /// Absorption coefficient; m⁻¹ and natural base once loaded.
    Absorption,
    /// Relative spectral power of a light.
    Illuminant,
    /// Colour matching functions.
    Observer,
}

impl Quantity {
    pub const ALL: [Self; 5] = [Self::Ior, Self::Reflectance, Self::Absorption, Self::Illuminant, Self::Observer];

    /// The folder under `spectra/` and the word in the files.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Ior => "ior",
            Self::Reflectance => "reflectance",
            Self::Absorption => "absorption",
            Self::Illuminant => "illuminant",
            Self::Observer => "observer",
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// How far the numbers may be trusted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Confidence {
    High,
    Medium,
    Low,
    /// Not measured: built from published facts and fitted by eye.
    Modelled,
    /// A user's file that does not say.
    #[default]
    Unstated,
}

impl fmt::Display for Confidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::High => "high",
            Self::Medium => "medium",
            Self::Low => "low",
            Self::Modelled => "modelled",
            Self::Unstated => "unstated",
        })
    }
}

/// Who published the numbers.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    pub title: String,
    pub authors: String,
    pub journal: Option<String>,
    pub year: Option<i32>,
    pub doi: Option<String>,
    pub licence: String,
    /// Where the file was taken from.
    pub origin: String,
}

/// Who published, in short: first author and year.
pub fn citation(authors: &str, year: Option<i32>) -> String {
    let first = authors.split([',', ';']).next().and_then(|first| first.split(" and ").next()).unwrap_or_default();
    year.map_or_else(|| first.to_owned(), |year| format!("{first} {year}"))
}

/// What was measured and how.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sample {
    pub description: String,
    pub method: Option<String>,
    pub temperature_k: Option<f64>,
    pub thickness_nm: Option<f64>,
    pub confidence: Confidence,
    pub remarks: Option<String>,
}

/// The provenance of a data set.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct About {
    /// The name it is referred to by.
    pub name: String,
    pub source: Source,
    pub sample: Sample,
    /// Wavelengths that the data cover, nm; `None`: everywhere.
    pub range_nm: Option<(f64, f64)>,
    /// What was set right, guessed or passed over when the file was read, in words.
    pub notes: Vec<String>,
}

impl About {
    pub fn confidence(&self) -> Confidence {
        self.sample.confidence
    }

    /// Whether the data cover the range; outside, ends are held or a formula is extrapolated, which a caller should say.
    pub fn covers_nm(&self, low: f64, high: f64) -> bool {
        self.range_nm.is_none_or(|(first, last)| first <= low && high <= last)
    }
}

/// A complex index of refraction N = n + i k, k ≥ 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Ior {
    pub n: Spectrum,
    pub k: Spectrum,
    pub about: About,
}

impl Ior {
    /// The same index at every wavelength.
    pub fn constant(name: &str, n: f64, k: f64) -> Self {
        let about = About { name: name.to_owned(), ..About::default() };
        Self { n: Spectrum::Constant(n), k: Spectrum::Constant(k), about }
    }

    /// (n, k) at a vacuum wavelength.
    pub fn at(&self, nm: f64) -> (f64, f64) {
        (self.n.at(nm), self.k.at(nm))
    }
}

/// A spectrum with its provenance: a reflectance, an absorption coefficient (m⁻¹, natural base) or an illuminant.
#[derive(Clone, Debug, PartialEq)]
pub struct Dataset {
    pub spectrum: Spectrum,
    pub about: About,
}
