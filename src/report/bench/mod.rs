//! Speed against error: what renders of a scene cost, how far they are from a reference, and which of them are worth it.
//!
//! A *variant* is a way to render: the usual one (exact Fresnel, eight lanes, Sobol points, dispersion) or the usual one with one thing
//! changed, or several. Each is rendered a few times with equal seeds in all variants, at several samples a pixel. Of every count:
//!
//! - time: the median of the renders, of all threads together (processor) and on the clock (wall);
//! - error from the reference, as it is displayed, nothing subtracted ([`error`]): MSE and relMSE of linear sRGB, the mean of (x − r)² and
//!   of (x − r)² / (r² + 0.01) over pixels and channels (F. Rousselle, C. Knaus & M. Zwicker, ACM Transactions on Graphics 30
//!   (2011)), mean ΔE2000; beside it the reference's own error, below [`CLEAR`] × which nothing can be told;
//! - noise: the mean ΔE2000 of a render from the variant's own mean ([`error::noise`]);
//! - efficiency 1 / (MSE × processor seconds): what does not fall with more samples, but where the MSE is bias.
//!
//! Bias is what more samples do not cure: the ΔE2000 of a variant's mean from the usual variant's at equal seeds, as far as independent
//! replicates agree on it ([`super::difference`]); of the usual variant itself, from the reference.
//! Called different are 2 of 160 ways that are not (40 seeds of a small scene, 4 renders each), where 4 were to be expected.
//! A ratio of times is the median of the ratios of renders of equal seed, which were made one after the other ([`ratio`]).
//!
//! Numbers in, text out: who renders hands the pictures in as [`Measured`].

pub mod error;
mod figure;
mod findings;
mod html;
mod measure;
mod pareto;
mod picture;
pub mod ratio;

pub use figure::figure;
pub use html::page;
pub use measure::{Measured, Renders, Scale, Standard, measure};
pub use picture::picture;
pub use ratio::Ratio;

use super::Verdict;
use super::comparison::short;
use serde::Serialize;

/// Names of the files in a report's folder.
pub const JSON_FILE: &str = "bench.json";
pub const SVG_FILE: &str = "bench.svg";
pub const HTML_FILE: &str = "bench.html";

/// An MSE that is not above this × the reference's own says little.
pub const CLEAR: f64 = 3.0;

/// A whole report. Field names are the keys of `bench.json`.
#[derive(Clone, Debug, Serialize)]
pub struct Bench {
    /// Of spectrel.
    pub version: String,
    /// As it was typed.
    pub command: String,
    /// Threads that rendered.
    pub threads: usize,
    /// Where processor time comes from.
    pub clock: String,
    /// What the whole run may take.
    pub time_budget_seconds: f64,
    /// What it took until this was written.
    pub seconds: f64,
    pub seed: u64,
    /// Renders of each variant and count of samples.
    pub repeats: usize,
    pub scenes: Vec<Scene>,
}

/// What was found of one scene.
#[derive(Clone, Debug, Serialize)]
pub struct Scene {
    /// The scene's file, or the name of the built-in one.
    pub scene: String,
    /// The same in short.
    pub name: String,
    /// Pixels.
    pub width: u32,
    pub height: u32,
    /// Display white is 2^this cd/m².
    pub exposure_ev: f64,
    pub white_balance: String,
    pub reference: Reference,
    /// The usual one first.
    pub variants: Vec<Variant>,
    /// What was not rendered, and why.
    pub left_out: Vec<String>,
    /// What the numbers say, in sentences.
    pub findings: Vec<String>,
}

/// What errors are measured from.
#[derive(Clone, Debug, Serialize)]
pub struct Reference {
    /// The file; null if it was rendered.
    pub file: Option<String>,
    /// A pixel, all replicates together; null if a file does not say.
    pub samples: Option<u64>,
    /// Renders with seeds of their own that it is the mean of; null for a file.
    pub replicates: Option<usize>,
    /// Its own error.
    pub mse: f64,
    /// Mean ΔE2000 of its own noise; null for a file.
    pub delta_e2000: Option<f64>,
}

/// In what a way differs from the usual one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Change {
    Model,
    Lanes,
    Sampler,
    Adaptive,
    Dispersion,
}

/// A way to render.
#[derive(Clone, Debug, Serialize)]
pub struct Way {
    /// What is changed, or all of the usual one.
    pub label: String,
    /// From the usual one; nothing for that one.
    pub changes: Vec<Change>,
    /// Fresnel model.
    pub model: String,
    /// Wavelengths a path.
    pub lanes: u32,
    pub sampler: String,
    /// What samples are shared out for; null if all pixels get as many.
    pub adaptive: Option<String>,
    pub dispersion: bool,
}

#[derive(Clone, Debug, Serialize)]
pub struct Variant {
    #[serde(flatten)]
    pub way: Way,
    /// Processor time over that of the usual variant; null for that one.
    pub time: Option<Ratio>,
    /// Null where a reference file leaves nothing to compare with.
    pub bias: Option<Bias>,
    /// The fewest samples first.
    pub runs: Vec<Run>,
}

/// What a variant gets wrong in the mean.
#[derive(Clone, Debug, Serialize)]
pub struct Bias {
    pub verdict: Verdict,
    /// Mean ΔE2000 on which independent replicates agree; without a bias about 0, of either sign.
    pub delta_e2000: f64,
    pub interval_95: [f64; 2],
}

/// Renders of one variant with so many samples.
#[derive(Clone, Debug, Serialize)]
pub struct Run {
    /// A pixel.
    pub samples: u32,
    pub cpu_seconds: f64,
    pub wall_seconds: f64,
    /// Before the first sample: spectra tabulated; part of neither time.
    pub setup_seconds: f64,
    /// By the wall clock, of all threads together.
    pub samples_per_second: f64,
    /// Questions to the scene, by the wall clock; in a stone, ways of one wavelength from facet to facet.
    pub rays_per_second: f64,
    pub mse: f64,
    pub rel_mse: f64,
    /// Mean, of the difference from the reference.
    pub delta_e2000: f64,
    /// Mean, of the difference from the variant's own mean.
    pub noise_delta_e2000: f64,
    /// 1 / (MSE × processor seconds).
    pub efficiency: f64,
    /// Whether the MSE is below [`CLEAR`] × that of the reference: it is then known to no more than that.
    pub near_reference: bool,
    /// Whether no other run has less MSE in less processor time.
    pub pareto: bool,
}

impl Bench {
    /// The text of `bench.json`.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self)
    }
}

impl Way {
    pub fn is_usual(&self) -> bool {
        self.changes.is_empty()
    }

    /// Whether it differs from the usual one in more than one thing.
    pub fn changes_several(&self) -> bool {
        self.changes.len() > 1
    }

    /// Whether it differs in one of these.
    pub fn changes_any(&self, of: &[Change]) -> bool {
        self.changes.iter().any(|change| of.contains(change))
    }
}

impl Variant {
    /// Whether it changes what is rendered, and not only how.
    pub fn may_be_biased(&self) -> bool {
        self.way.changes_any(&[Change::Model, Change::Dispersion])
    }

    /// Whether nothing beats some of its runs.
    pub fn on_front(&self) -> bool {
        self.runs.iter().any(|run| run.pareto)
    }

    /// Its bias as a table shows it; a bound where there may be one that noise hides, nothing where none is looked for.
    pub fn bias_text(&self) -> String {
        let none = || "–".to_owned();
        self.bias.as_ref().map_or_else(none, |bias| match bias.verdict {
            Verdict::Different => short(bias.delta_e2000),
            Verdict::Indistinguishable if self.may_be_biased() => format!("< {}", short(bias.interval_95[1])),
            Verdict::Identical if self.may_be_biased() => "0".into(),
            _ => none(),
        })
    }
}

impl Scene {
    /// The usual variant and the others.
    pub fn usual(&self) -> Option<(&Variant, &[Variant])> {
        self.variants.split_first()
    }

    /// All runs of all variants.
    pub fn runs(&self) -> impl Iterator<Item = (&Variant, &Run)> {
        self.variants.iter().flat_map(|variant| variant.runs.iter().map(move |run| (variant, run)))
    }
}
