//! The ways to render that are tried: the usual one, the usual one with one thing changed, and on demand with several.

use super::BenchArgs;
use crate::adaptive::Aim;
use crate::cli::effort::{self, Sharing};
use crate::fresnel::{FresnelModel, RgbModel, SpectralModel};
use crate::math::LANES;
use crate::report::bench::{self, Change};
use crate::scene::describe::SamplerName;
use crate::scene::{Overrides, Scene, SceneError, Text, resolve};
use crate::spectrum::Library;

pub const DEFAULT_MODELS: &[FresnelModel] = &[
    FresnelModel::Spectral(SpectralModel::Schlick),
    FresnelModel::Rgb(RgbModel::F82),
    FresnelModel::Rgb(RgbModel::RgbExact),
];
pub const DEFAULT_LANES: &[u32] = &[4, 1];
pub const DEFAULT_SAMPLERS: &[SamplerName] = &[SamplerName::Independent];
pub const DEFAULT_ADAPTIVE: &[Option<Aim>] = &[Some(Aim::Rmse)];
pub const DEFAULT_DISPERSION: &[bool] = &[false];

/// One way to render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    model: FresnelModel,
    lanes: u32,
    sampler: SamplerName,
    aim: Option<Aim>,
    dispersion: bool,
}

impl Way {
    pub const USUAL: Self = Self {
        model: FresnelModel::EXACT,
        lanes: LANES as u32,
        sampler: SamplerName::Sobol,
        aim: None,
        dispersion: true,
    };

    /// What samples are shared out for.
    pub fn aim(&self) -> Option<Aim> {
        self.aim
    }

    /// What is not as usual.
    pub fn changes(&self) -> Vec<Change> {
        let usual = Self::USUAL;
        let all = [
            (self.model != usual.model, Change::Model),
            (self.lanes != usual.lanes, Change::Lanes),
            (self.sampler != usual.sampler, Change::Sampler),
            (self.aim != usual.aim, Change::Adaptive),
            (self.dispersion != usual.dispersion, Change::Dispersion),
        ];
        all.into_iter().filter(|(changed, _)| *changed).map(|(_, change)| change).collect()
    }

    /// Made of what is not as usual.
    pub fn label(&self) -> String {
        let changes = self.changes();
        let all = [Change::Model, Change::Lanes, Change::Sampler];
        let named = if changes.is_empty() { &all[..] } else { &changes };
        named.iter().map(|change| self.part(*change)).collect::<Vec<_>>().join(", ")
    }

    fn part(&self, change: Change) -> String {
        match change {
            Change::Model => self.model.name().into(),
            Change::Lanes if self.lanes == 1 => "1 lane".into(),
            Change::Lanes => format!("{} lanes", self.lanes),
            Change::Sampler => sampler_name(self.sampler).into(),
            Change::Adaptive => format!("adaptive for {}", self.aim.map_or("nothing", Aim::name)),
            Change::Dispersion => "no dispersion".into(),
        }
    }

    /// As a report has it.
    pub fn described(&self) -> bench::Way {
        bench::Way {
            label: self.label(),
            changes: self.changes(),
            model: self.model.name().into(),
            lanes: self.lanes,
            sampler: sampler_name(self.sampler).into(),
            adaptive: self.aim.map(|aim| aim.name().into()),
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

/// The usual way, then what the options name, or what there is to see if they name nothing: what changes fewer things goes first, for
/// its numbers say more by themselves.
pub fn ways(args: &BenchArgs) -> Result<Vec<Way>, SceneError> {
    let usual = Way::USUAL;
    let models = axis(usual.model, named("models", &args.models, DEFAULT_MODELS)?);
    let lanes = axis(usual.lanes, named("lanes", &args.lanes, DEFAULT_LANES)?);
    let samplers = axis(usual.sampler, named("samplers", &args.samplers, DEFAULT_SAMPLERS)?);
    let dispersion = axis(usual.dispersion, named("dispersion", &args.dispersion, DEFAULT_DISPERSION)?);
    let aims = axis(usual.aim, named("adaptive", &args.adaptive, DEFAULT_ADAPTIVE)?);
    // The last of these turns fastest.
    let all = dispersion.iter().map(|&dispersion| Way { dispersion, ..usual });
    let all = all.flat_map(|way| aims.iter().map(move |&aim| Way { aim, ..way }));
    let all = all.flat_map(|way| samplers.iter().map(move |&sampler| Way { sampler, ..way }));
    let all = all.flat_map(|way| lanes.iter().map(move |&lanes| Way { lanes, ..way }));
    let all = all.flat_map(|way| models.iter().map(move |&model| Way { model, ..way }));
    let most = if args.product { usize::MAX } else { 1 };
    let mut ways: Vec<Way> = all.filter(|way| way.changes().len() <= most).collect();
    ways.sort_by_key(|way| way.changes().len());
    Ok(ways)
}

/// The usual value and the others.
fn axis<T: Copy + PartialEq>(usual: T, named: &[T]) -> Vec<T> {
    std::iter::once(usual).chain(named.iter().copied().filter(|value| *value != usual)).collect()
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

/// What an option's samples are shared out for.
pub fn sharing(text: &str) -> Result<Option<Aim>, String> {
    effort::sharing(text).map(|Sharing(aim)| aim)
}

/// Whether an option's dispersion is on.
pub fn switch(text: &str) -> Result<bool, String> {
    match text {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err("dispersion is on or off".into()),
    }
}
