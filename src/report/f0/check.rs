//! Someone else's table of colours, row by row: which published data set it was made from, and whether its numbers are in the encoding that it states.
//!
//! A row is read as stated and under the other encoding, and each reading is held against F0 of every data set of the material (CIEDE2000).
//! A colour within 0…1 cannot say more than 1, so it is held against F0 clipped to 1, and, if its largest channel is 1 and that of F0 is
//! above, also against F0 divided by its largest channel: the other way to make it fit.
//!
//! - *match*: ΔE2000 ≤ 1 from a data set; about what an eye can just tell (`spectrum::ciede2000`).
//! - *near*: ≤ 2; told at close observation.
//! - *mis-encoded*: not near as stated, yet a match under the other encoding.
//! - *nothing*: neither. The limits are the same for every row.

use super::{Instrument, Labels};
use serde::Serialize;

/// What an eye can just tell.
pub const MATCH: f64 = 1.0;
/// What it tells at close observation.
pub const NEAR: f64 = 2.0;

/// How numbers stand for light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Encoding {
    Linear,
    /// By the transfer curve of the space: sRGB's for sRGB.
    Encoded,
}

/// A row of someone else's table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Claim {
    /// Whose table, where it says so.
    pub table: Option<String>,
    pub material: String,
    pub rgb: [f64; 3],
    pub encoding: Encoding,
    /// Whether the table does not state the encoding.
    #[serde(rename = "encoding_assumed")]
    pub assumed: bool,
    /// Its line in the file.
    pub line: u64,
}

/// A data set of the material: its name and F0 in linear RGB.
pub type Candidate = (String, [f64; 3]);

/// The material of a claim as this library knows it: the set that stands for it comes first.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    pub name: String,
    pub candidates: Vec<Candidate>,
}

/// What a row turns out to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    Match,
    Near,
    MisEncoded,
    Nothing,
    /// No material of the library has this name.
    Unknown,
}

/// How F0 was made to fit into 0…1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fit {
    /// It fits, or channels above 1 are cut.
    Clipped,
    /// Divided by its largest channel.
    Divided,
}

/// The data set nearest to a reading.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Nearest {
    pub ior: String,
    pub delta_e: f64,
    pub fit: Fit,
}

/// A row and what became of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    #[serde(flatten)]
    pub claim: Claim,
    pub outcome: Outcome,
    /// The material as the library calls it.
    pub name: Option<String>,
    /// The set nearest to the row as stated.
    pub as_stated: Option<Nearest>,
    /// The set nearest to it under the other encoding.
    pub other_encoding: Option<Nearest>,
    /// The distance, as stated, to the set that stands for the material.
    pub primary: Option<Nearest>,
    pub says: String,
}

/// A table's rows under the conditions that they were judged by.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Checked {
    #[serde(flatten)]
    pub conditions: Labels,
    /// Largest ΔE2000 of a match, and of what is near.
    pub limits: [f64; 2],
    pub rows: Vec<Verdict>,
}

impl Checked {
    pub fn new(rows: Vec<Verdict>, instrument: &Instrument) -> Self {
        Self { conditions: instrument.conditions.labels(), limits: [MATCH, NEAR], rows }
    }
}

impl Verdict {
    /// The row and what it turned out to be, in words.
    pub fn sentence(&self) -> String {
        let Claim { table, material, .. } = &self.claim;
        let whose = table.as_ref().map(|table| format!("{table} ")).unwrap_or_default();
        format!("{whose}{material} {}", self.says)
    }
}

impl Fit {
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Clipped => "clipped",
            Self::Divided => "divided",
        }
    }
}

impl Encoding {
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Encoded => "encoded",
        }
    }

    fn other(self) -> Self {
        match self {
            Self::Linear => Self::Encoded,
            Self::Encoded => Self::Linear,
        }
    }

    /// What numbers of this encoding are called where a space is in use.
    fn name(self, instrument: &Instrument) -> String {
        match self {
            Self::Linear => "linear".into(),
            Self::Encoded => format!("{}-encoded", instrument.conditions.space.name()),
        }
    }
}

/// Judges a row against the data sets of its material, or says why not.
pub fn judge(claim: Claim, known: Result<&Known, String>, instrument: &Instrument) -> Verdict {
    let known = match known {
        Ok(known) => known,
        Err(says) => return unknown(claim, says),
    };
    let reading = |encoding, candidates| nearest(read_as(encoding, claim.rgb, instrument), candidates, instrument);
    let stated = reading(claim.encoding, known.candidates.as_slice());
    let other = reading(claim.encoding.other(), known.candidates.as_slice());
    let primary = reading(claim.encoding, known.candidates.get(..1).unwrap_or_default());
    let distance = |nearest: &Option<Nearest>| nearest.as_ref().map_or(f64::INFINITY, |nearest| nearest.delta_e);
    let outcome = match (distance(&stated), distance(&other)) {
        (stated, _) if stated <= MATCH => Outcome::Match,
        (stated, _) if stated <= NEAR => Outcome::Near,
        (_, other) if other <= MATCH => Outcome::MisEncoded,
        _ => Outcome::Nothing,
    };
    let says = says(outcome, &claim, stated.as_ref(), other.as_ref(), instrument);
    Verdict { outcome, name: Some(known.name.clone()), as_stated: stated, other_encoding: other, primary, says, claim }
}

fn unknown(claim: Claim, says: String) -> Verdict {
    let outcome = Outcome::Unknown;
    Verdict { claim, outcome, name: None, as_stated: None, other_encoding: None, primary: None, says }
}

fn read_as(encoding: Encoding, rgb: [f64; 3], instrument: &Instrument) -> [f64; 3] {
    match encoding {
        Encoding::Linear => rgb,
        Encoding::Encoded => rgb.map(|value| instrument.conditions.space.decode(value)),
    }
}

/// The set nearest to a linear colour, with the fit that is nearer.
pub(super) fn nearest(rgb: [f64; 3], candidates: &[Candidate], instrument: &Instrument) -> Option<Nearest> {
    let fits = candidates.iter().flat_map(|(ior, f0)| fitted(rgb, *f0).map(move |(fit, f0)| (ior, fit, f0)));
    let distances = fits.map(|(ior, fit, f0)| (ior, fit, instrument.difference(rgb, f0)));
    let (ior, fit, delta_e) = distances.min_by(|a, b| a.2.total_cmp(&b.2))?;
    Some(Nearest { ior: ior.clone(), delta_e, fit })
}

/// Half a unit of the second decimal, to which most tables are printed.
const ROUNDING: f64 = 0.005;

/// F0 as a table could have made it fit a colour like `rgb`.
fn fitted(rgb: [f64; 3], f0: [f64; 3]) -> impl Iterator<Item = (Fit, [f64; 3])> {
    let largest = |rgb: [f64; 3]| rgb.into_iter().fold(f64::NEG_INFINITY, f64::max);
    let clipped = if largest(rgb) <= 1.0 { f0.map(|value| value.min(1.0)) } else { f0 };
    let divides = (largest(rgb) - 1.0).abs() <= ROUNDING && largest(f0) > 1.0;
    let divided = divides.then(|| (Fit::Divided, f0.map(|value| value / largest(f0))));
    std::iter::once((Fit::Clipped, clipped)).chain(divided)
}

fn says(
    outcome: Outcome,
    claim: &Claim,
    stated: Option<&Nearest>,
    other: Option<&Nearest>,
    instrument: &Instrument,
) -> String {
    let (Some(stated), Some(other)) = (stated, other) else { return "no data set to compare with".into() };
    let [own, swapped] = [claim.encoding, claim.encoding.other()].map(|encoding| encoding.name(instrument));
    match outcome {
        Outcome::Match => format!("is {stated}"),
        Outcome::Near => format!("is near {stated}"),
        Outcome::MisEncoded => {
            format!(
                "looks mis-encoded: as {swapped} values it is {other}; as {own} ones, as stated, nothing is nearer than {stated}"
            )
        }
        Outcome::Nothing | Outcome::Unknown => {
            format!("matches nothing: the nearest is {stated}; as {swapped} values {other}")
        }
    }
}

impl std::fmt::Display for Nearest {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let divided = if self.fit == Fit::Divided { " divided by its largest channel" } else { "" };
        write!(f, "{}{divided} (ΔE {:.2})", self.ior, self.delta_e)
    }
}
