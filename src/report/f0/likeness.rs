//! Which metals look like a colour.

use super::check::{Candidate, Known, nearest};
use super::{Color, Instrument, Labels};
use serde::Serialize;

/// Metals by their distance from a colour, the nearest first.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Likenesses {
    #[serde(flatten)]
    pub conditions: Labels,
    pub color: Color,
    pub metals: Vec<Likeness>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Likeness {
    pub name: String,
    /// The set that stands for the metal.
    pub ior: String,
    pub f0: Color,
    pub delta_e: f64,
    /// Another set of it that is nearer still.
    pub nearer: Option<Nearer>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Nearer {
    pub ior: String,
    pub f0: Color,
    pub delta_e: f64,
}

impl Likenesses {
    /// The nearest `count` metals to a colour in linear RGB, by the sets that stand for them. A colour within 0…1 is held against F0 clipped
    /// to 1, as in [`super::check`].
    pub fn new(linear: [f64; 3], metals: &[Known], count: usize, instrument: &Instrument) -> Self {
        let mut found: Vec<_> = metals.iter().filter_map(|metal| Likeness::of(linear, metal, instrument)).collect();
        found.sort_by(|a, b| a.delta_e.total_cmp(&b.delta_e));
        found.truncate(count);
        Self { conditions: instrument.conditions.labels(), color: instrument.color(linear), metals: found }
    }
}

impl Likeness {
    fn of(linear: [f64; 3], metal: &Known, instrument: &Instrument) -> Option<Self> {
        let (primary, others) = metal.candidates.split_first()?;
        let distance = |candidate: &Candidate| nearest(linear, std::slice::from_ref(candidate), instrument);
        let delta_e = distance(primary)?.delta_e;
        let distances = others.iter().filter_map(|other| Some((other, distance(other)?.delta_e)));
        let nearest = distances.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, distance)| *distance < delta_e);
        Some(Self {
            name: metal.name.clone(),
            ior: primary.0.clone(),
            f0: instrument.color(primary.1),
            delta_e,
            nearer: nearest.map(|((ior, f0), delta_e)| Nearer { ior: ior.clone(), f0: instrument.color(*f0), delta_e }),
        })
    }
}
