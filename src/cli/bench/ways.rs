//! The ways to render that are tried: the usual one, and the usual one with one thing changed.

use super::BenchArgs;
use crate::fresnel::{FresnelModel, RgbModel, SpectralModel};
use crate::report::bench::{self, Change};
use crate::scene::describe::SamplerName;
use crate::scene::{Overrides, Scene, SceneError, Text, resolve};
use crate::spectrum::{LANES, Library};

pub const DEFAULT_MODELS: &[FresnelModel] = &[
    FresnelModel::Spectral(SpectralModel::Schlick),
    FresnelModel::Rgb(RgbModel::F82),
    FresnelModel::Rgb(RgbModel::RgbExact),
];
pub const DEFAULT_LANES: &[u32] = &[4, 1];
pub const DEFAULT_SAMPLERS: &[SamplerName] = &[SamplerName::Independent];

/// One way to render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    change: Change,
    model: FresnelModel,
    lanes: u32,
    sampler: SamplerName,
    dispersion: bool,
}

impl Way {
    pub const USUAL: Self = Self {
        change: Change::Nothing,
        model: FresnelModel::EXACT,
        lanes: LANES as u32,
        sampler: SamplerName::Sobol,
        dispersion: true,
    };

    pub fn label(&self) -> String {
        match self.change {
            Change::Nothing => format!("{}, {} lanes, {}", self.model, self.lanes, sampler_name(self.sampler)),
            Change::Model => self.model.name().into(),
            Change::Lanes if self.lanes == 1 => "1 lane".into(),
            Change::Lanes => format!("{} lanes", self.lanes),
            Change::Sampler => sampler_name(self.sampler).into(),
            Change::Dispersion => "no dispersion".into(),
        }
    }

    /// As a report has it.
    pub fn described(&self) -> bench::Way {
        bench::Way {
            label: self.label(),
            change: self.change,
            model: self.model.name().into(),
            lanes: self.lanes,
            sampler: sampler_name(self.sampler).into(),
            dispersion: self.dispersion,
        }
    }

    /// The scene as it is rendered this way.
    pub fn resolve(&self, text: &Text, library: &Library, size: &Overrides) -> Result<Scene, SceneError> {
        let overrides = Overrides {
            fresnel: Some(self.model),
            lanes: Some(self.lanes),
            sampler: Some(self.sampler),
            without_dispersion: !self.dispersion,
            ..size.clone()
        };
        resolve(text.clone(), library, &overrides).map_err(|error| SceneError {
            message: format!("rendering with {}: {}", self.label(), error.message),
            ..error
        })
    }
}

/// The usual way, then what the options name, or what there is to see if they name nothing.
pub fn ways(args: &BenchArgs) -> Result<Vec<Way>, SceneError> {
    let models = named("models", &args.models, DEFAULT_MODELS)?;
    let lanes = named("lanes", &args.lanes, DEFAULT_LANES)?;
    let samplers = named("samplers", &args.samplers, DEFAULT_SAMPLERS)?;
    let usual = Way::USUAL;
    let models = models.iter().map(|&model| Way { change: Change::Model, model, ..usual });
    let lanes = lanes.iter().map(|&lanes| Way { change: Change::Lanes, lanes, ..usual });
    let samplers = samplers.iter().map(|&sampler| Way { change: Change::Sampler, sampler, ..usual });
    let flat = [false].iter().filter(|_| !args.keep_dispersion);
    let flat = flat.map(|&dispersion| Way { change: Change::Dispersion, dispersion, ..usual });
    let changed = models.chain(lanes).chain(samplers).chain(flat);
    // What is usual is there already.
    let is_usual = |way: &Way| Way { change: Change::Nothing, ..*way } == usual;
    Ok(std::iter::once(usual).chain(changed.filter(|way| !is_usual(way))).collect())
}

/// What an option names, each once, or its default.
fn named<'a, T: PartialEq + std::fmt::Debug>(
    option: &str,
    given: &'a [T],
    default: &'a [T],
) -> Result<&'a [T], SceneError> {
    match (1..given.len()).find(|&i| given[..i].contains(&given[i])) {
        Some(_) => Err(SceneError::new(format!("--{option} names one of its values twice"))),
        None if given.is_empty() => Ok(default),
        None => Ok(given),
    }
}

pub fn sampler_name(sampler: SamplerName) -> &'static str {
    match sampler {
        SamplerName::Sobol => "sobol",
        SamplerName::Independent => "independent",
    }
}

/// An option's sampler.
pub fn sampler(text: &str) -> Result<SamplerName, String> {
    let all = [SamplerName::Sobol, SamplerName::Independent];
    let found = all.into_iter().find(|&sampler| sampler_name(sampler) == text);
    found.ok_or_else(|| "a sampler is sobol or independent".into())
}
