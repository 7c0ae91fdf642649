//! What is compared: each model, then each material and each data set that is put in another's place.

use super::CompareArgs;
use crate::fresnel::{FresnelModel, RgbModel, SpectralModel};
use crate::scene::{Overrides, Scene, SceneError, Text, resolve};
use crate::spectrum::Library;

/// Models that part on metals, stones or both.
pub const DEFAULT_MODELS: &[FresnelModel] = &[
    FresnelModel::EXACT,
    FresnelModel::Spectral(SpectralModel::Schlick),
    FresnelModel::Rgb(RgbModel::SchlickRgb),
    FresnelModel::Rgb(RgbModel::F82),
];

/// One of the pictures.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Letters, digits and dashes: the stem of its files.
    pub id: String,
    /// For people.
    pub label: String,
    pub model: FresnelModel,
    pub ior: Vec<(String, String)>,
    pub vary: Vec<(String, String)>,
}

impl Variant {
    fn new(label: String, words: &str, model: FresnelModel) -> Self {
        Self { id: plain(words), label, model, ior: Vec::new(), vary: Vec::new() }
    }

    /// The scene as this variant has it.
    pub fn resolve(&self, text: &Text, library: &Library, args: &CompareArgs) -> Result<Scene, SceneError> {
        let overrides = Overrides {
            fresnel: Some(self.model),
            ior: self.ior.clone(),
            vary: self.vary.clone(),
            ..args.settings.overrides()
        };
        resolve(text.clone(), library, &overrides)
            .map_err(|error| SceneError { message: format!("variant `{}`: {}", self.label, error.message), ..error })
    }
}

/// The models that are asked for; without any, several if nothing else is varied.
pub fn models(args: &CompareArgs) -> Result<Vec<FresnelModel>, SceneError> {
    let models = match args.models.as_slice() {
        [] if args.vary.is_empty() && args.ior.is_empty() => DEFAULT_MODELS,
        [] => &DEFAULT_MODELS[..1],
        given => given,
    };
    let twice = (1..models.len()).find(|&i| models[..i].contains(&models[i]));
    match twice {
        Some(i) => Err(SceneError::new(format!("--models names `{}` twice", models[i]))),
        None => Ok(models.to_vec()),
    }
}

/// All variants, the reference first.
pub fn variants(args: &CompareArgs) -> Result<Vec<Variant>, SceneError> {
    let models = models(args)?;
    let by_model = models.iter().map(|model| Variant::new(model.name().into(), model.name(), *model));
    let vary = args.vary.iter().map(|(material, by)| Variant {
        vary: vec![(material.clone(), by.clone())],
        ..Variant::new(format!("{material} → {by}"), &format!("{material} as {by}"), models[0])
    });
    let ior = args.ior.iter().map(|(material, data)| Variant {
        ior: vec![(material.clone(), data.clone())],
        ..Variant::new(format!("{material}: {data}"), &format!("{material} by {data}"), models[0])
    });
    let mut all: Vec<Variant> = by_model.chain(vary).chain(ior).collect();
    if all.len() < 2 {
        let error = SceneError::new("there is nothing to compare: one variant only");
        return Err(error.help("name more --models, or add --vary material=NAME or --ior material=DATASET"));
    }
    if let Some(i) = (1..all.len()).find(|&i| all[..i].iter().any(|other| other.label == all[i].label)) {
        return Err(SceneError::new(format!("the variant `{}` is named twice", all[i].label)));
    }
    number_equal_names(&mut all);
    Ok(all)
}

/// Two names that differ in signs only would be one file.
fn number_equal_names(all: &mut [Variant]) {
    for i in 1..all.len() {
        let (before, variant) = all.split_at_mut(i);
        let plain = variant[0].id.clone();
        let mut number = 1;
        while before.iter().any(|other| other.id == variant[0].id) {
            number += 1;
            variant[0].id = format!("{plain}-{number}");
        }
    }
}

/// What is safe in a file's name and in a page's address.
fn plain(words: &str) -> String {
    let sign = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { ' ' };
    let signs: String = words.chars().map(sign).collect();
    let stem = signs.split_whitespace().collect::<Vec<_>>().join("-");
    if stem.is_empty() { "variant".into() } else { stem.chars().take(LONGEST).collect() }
}

/// File systems allow names of 255 bytes.
const LONGEST: usize = 120;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_plain_and_differ() {
        assert_eq!(plain("gold by Au/olmon-2012"), "gold-by-au-olmon-2012");
        assert_eq!(plain("../<é>"), "variant");
        let variant = |words: &str| Variant::new(words.into(), words, FresnelModel::EXACT);
        let mut all = [variant("a b"), variant("a/b"), variant("a.b"), variant("c")];
        number_equal_names(&mut all);
        assert_eq!(all.map(|variant| variant.id), ["a-b", "a-b-2", "a-b-3", "c"]);
    }
}
