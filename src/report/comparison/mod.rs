//! Variants of a scene beside each other: what is known of them, as numbers for JSON and for the page (`html`).

mod html;
mod words;

pub(in crate::report) use html::filled;
pub use html::{Pictures, page};
pub(in crate::report) use words::seconds;
pub use words::short;

use super::{Difference, Noise};
use crate::spectrum::About;
use serde::Serialize;

/// Names of the files in a report's folder.
pub const JSON_FILE: &str = "report.json";
pub const HTML_FILE: &str = "report.html";

/// A place of the page's template that nothing is known for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("the report's template asks for `{0}`")]
pub struct PageError(String);

/// A whole report. Field names are the keys of `report.json`.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// Of spectrel.
    pub version: String,
    /// The scene's file, or the name of the built-in one.
    pub scene: String,
    pub settings: Settings,
    /// The first one is the reference of all differences.
    pub variants: Vec<Variant>,
    /// Of the reference's own picture.
    pub reference_noise: Noise,
    /// All variants together.
    pub rendering_seconds: f64,
    /// Comparing and encoding, until this was written.
    pub report_seconds: f64,
    /// Whether it was ended before all samples were taken.
    pub interrupted: bool,
    pub data: Vec<Data>,
    pub curves: Vec<Curves>,
    /// Which light comes by ways that nothing aims at, so that paths may not have found it; empty if none does.
    pub by_chance: String,
}

/// What it takes to make the same report again.
#[derive(Clone, Debug, Serialize)]
pub struct Settings {
    /// With every default written out.
    pub command: String,
    /// Pixels.
    pub width: u32,
    pub height: u32,
    /// A pixel, all replicates together.
    pub samples: u64,
    pub seed: u64,
    /// Seeds of the replicates that were rendered: `spectrel render --seed` with its share of the samples is one of them.
    pub replicate_seeds: Vec<u64>,
    /// Display white is 2^this cd/m² in every picture.
    pub exposure_ev: f64,
    pub white_balance: String,
    pub observer: String,
    /// Threads that rendered: times are those of all together.
    pub threads: usize,
}

#[derive(Clone, Debug, Serialize)]
pub struct Variant {
    /// The stem of its files.
    pub id: String,
    pub label: String,
    /// Its Fresnel model.
    pub model: String,
    /// Materials that are replaced, and by what.
    pub vary: Vec<(String, String)>,
    /// Materials whose data are replaced, and by what.
    pub ior: Vec<(String, String)>,
    pub render_seconds: f64,
    /// Of eight wavelengths at one angle, the mean of the scene's interfaces; null if it has none.
    pub ns_per_evaluation: Option<f64>,
    /// From the reference; null for the reference itself.
    pub difference: Option<Difference>,
    pub files: Files,
}

/// Names in the report's folder.
#[derive(Clone, Debug, Serialize)]
pub struct Files {
    pub png: String,
    pub exr: String,
    /// The map of ΔE2000; null for the reference.
    pub delta_e_png: Option<String>,
    /// The map of luminance less the reference's; null for the reference.
    pub luminance_png: Option<String>,
}

impl Files {
    pub fn new(id: &str, is_reference: bool) -> Self {
        let map = |name: &str| (!is_reference).then(|| format!("{id}.{name}.png"));
        Self {
            png: format!("{id}.png"),
            exr: format!("{id}.exr"),
            delta_e_png: map("delta-e"),
            luminance_png: map("luminance"),
        }
    }
}

/// A data set, and what it is used for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Data {
    pub name: String,
    pub used_by: Vec<String>,
    pub title: String,
    pub authors: String,
    pub journal: Option<String>,
    pub year: Option<i32>,
    pub doi: Option<String>,
    pub licence: String,
    pub confidence: String,
    pub range_nm: Option<(f64, f64)>,
}

impl Data {
    pub fn new(about: &About, used_by: Vec<String>) -> Self {
        let source = &about.source;
        Self {
            name: about.name.clone(),
            used_by,
            title: source.title.clone(),
            authors: source.authors.clone(),
            journal: source.journal.clone(),
            year: source.year,
            doi: source.doi.clone(),
            licence: source.licence.clone(),
            confidence: about.confidence().to_string(),
            range_nm: about.range_nm,
        }
    }
}

/// Reflectances of one material against the angle of incidence, weighted by the observer's ȳ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curves {
    pub title: String,
    pub lines: Vec<Line>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line {
    /// Index of the variant.
    pub variant: usize,
    pub label: String,
    /// Degrees, reflectance.
    pub points: Vec<[f64; 2]>,
}
