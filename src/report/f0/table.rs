//! An F0 table: rows under common conditions, and how far apart published sets of a material are.

use super::{Instrument, Labels, Row, Subject};
use rayon::prelude::*;
use serde::Serialize;

/// Rows with the conditions that they hold under.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Table {
    #[serde(flatten)]
    pub conditions: Labels,
    pub materials: Vec<Row>,
    /// One for each material, where all its data sets were asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub spread: Vec<Spread>,
}

/// How far apart published sets of one material are, by the CIEDE2000 of their F0.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Spread {
    pub name: String,
    /// The data set that stands for the material.
    pub ior: String,
    pub sets: Vec<Distance>,
    /// Mean distance of the others to that set; `None` without others.
    pub mean_to_primary: Option<f64>,
    /// The two that are furthest apart.
    pub widest: Option<Widest>,
}

/// One set's distance to the one that stands for the material.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Distance {
    pub ior: String,
    pub delta_e: f64,
    /// A set that does not cover the visible is listed, but is left out of mean and maximum.
    pub counted: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Widest {
    pub delta_e: f64,
    pub between: [String; 2],
}

impl Table {
    /// One row for each subject.
    pub fn new(subjects: &[Subject], instrument: &Instrument) -> Self {
        Self {
            conditions: instrument.conditions.labels(),
            materials: subjects.par_iter().map(|subject| Row::new(subject, instrument)).collect(),
            spread: Vec::new(),
        }
    }

    /// A row for each data set of each material, the one that stands for it first, and their spread.
    pub fn with_all_data_sets(materials: &[Vec<Subject>], instrument: &Instrument) -> Self {
        let mut table = Self::new(&materials.concat(), instrument);
        let mut rows = table.materials.as_slice();
        for sets in materials {
            let (own, rest) = rows.split_at(sets.len());
            table.spread.extend(Spread::of(own, instrument));
            rows = rest;
        }
        table
    }
}

impl Spread {
    /// Of the rows of one material, of which the first stands for it; `None` without rows.
    fn of(rows: &[Row], instrument: &Instrument) -> Option<Self> {
        let (primary, others) = rows.split_first()?;
        let between = |a: &Row, b: &Row| instrument.difference(a.f0.linear, b.f0.linear);
        let distance = |row: &Row| Distance {
            ior: row.ior.clone(),
            delta_e: between(primary, row),
            counted: row.source.covers_visible,
        };
        let sets: Vec<Distance> = others.iter().map(distance).collect();
        let counted: Vec<f64> = sets.iter().filter(|set| set.counted).map(|set| set.delta_e).collect();
        let mean = counted.iter().sum::<f64>() / counted.len() as f64;
        let covering: Vec<&Row> = rows.iter().filter(|row| row.source.covers_visible).collect();
        let pairs = covering.iter().enumerate().flat_map(|(i, a)| covering[..i].iter().map(move |b| (*b, *a)));
        let widest = pairs
            .map(|(a, b)| Widest { delta_e: between(a, b), between: [a.ior.clone(), b.ior.clone()] })
            .max_by(|a, b| a.delta_e.total_cmp(&b.delta_e));
        Some(Self {
            name: primary.name.clone(),
            ior: primary.ior.clone(),
            sets,
            mean_to_primary: (!counted.is_empty()).then_some(mean),
            widest,
        })
    }
}

impl Spread {
    /// In words.
    pub fn sentence(&self) -> String {
        let Self { name, ior, .. } = self;
        let left_out: Vec<_> = self.sets.iter().filter(|set| !set.counted).map(|set| set.ior.as_str()).collect();
        let left_out = match left_out.as_slice() {
            [] => String::new(),
            sets => format!("; not counted, as it ends inside the visible: {}", sets.join(", ")),
        };
        let spread = match (self.mean_to_primary, &self.widest) {
            (Some(mean), Some(Widest { delta_e, between: [a, b] })) => {
                format!("ΔE2000 {mean:.2} on average from {ior}, {delta_e:.2} at most ({a} and {b})")
            }
            (Some(mean), None) => format!("ΔE2000 {mean:.2} on average from {ior}"),
            (None, _) => format!("nothing to compare {ior} with"),
        };
        format!("{name}: {spread}{left_out}")
    }
}
