//! The materials, data sets, models and lights that a command of `spectrel fresnel` is about.

use crate::cli::{LibraryArgs, show};
use crate::fresnel::FresnelModel;
use crate::report::fresnel::{Subject, Unfit, check};
use crate::scene::{Class, Optics, SceneError, optics};
use crate::spectrum::{Adaptation, Colorimeter, Library, Observer, RgbSpace};
use clap::Args;
use std::path::Path;

#[derive(Debug, Args)]
pub struct DataArgs {
    /// Another data set for a material, such as gold=Au/johnson-christy-1972; can be repeated
    #[arg(long, value_name = "NAME=DATASET")]
    ior: Vec<String>,
    #[command(flatten)]
    library: LibraryArgs,
}

impl DataArgs {
    pub fn library(&self) -> Result<Library, SceneError> {
        self.library.open()
    }

    /// What is known of each of these materials.
    pub fn optics(&self, names: &[String], library: &Library) -> Result<Vec<Optics>, SceneError> {
        let replaced = self.ior.iter().map(|text| replacement(text, names)).collect::<Result<Vec<_>, _>>()?;
        let data = |name: &str| replaced.iter().rev().find(|(of, _)| *of == name).map(|(_, data)| *data);
        names.iter().map(|name| optics(name, data(name), library)).collect()
    }
}

/// The material and the data set of `NAME=DATASET`.
fn replacement<'a>(text: &'a str, names: &[String]) -> Result<(&'a str, &'a str), SceneError> {
    let Some((name, data)) = text.split_once('=') else {
        let help = "NAME=DATASET, such as gold=Au/johnson-christy-1972; `spectrel list spectra` names the data sets";
        return Err(SceneError::new(format!("--ior {text}: no `=` in it")).help(help));
    };
    if !names.iter().any(|known| known == name) {
        let message = format!("--ior {text}: `{name}` is not among the materials ({})", names.join(", "));
        return Err(SceneError::new(message));
    }
    Ok((name, data))
}

pub fn subject(optics: &Optics) -> Subject<'_> {
    Subject::new(optics.name.clone(), &optics.ior, optics.class == Class::Dielectric)
}

/// Which models are asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Models {
    /// Those that apply.
    All,
    Listed(Vec<FresnelModel>),
}

impl std::str::FromStr for Models {
    type Err = SceneError;
    fn from_str(text: &str) -> Result<Self, SceneError> {
        if text.trim() == "all" {
            return Ok(Self::All);
        }
        let mut listed: Vec<FresnelModel> = Vec::new();
        for name in text.split(',') {
            let model = name.trim().parse().map_err(|error| SceneError::new(format!("--models: {error}")))?;
            if !listed.contains(&model) {
                listed.push(model);
            }
        }
        Ok(Self::Listed(listed))
    }
}

impl Models {
    /// Those for one material: all that apply, or an error about the first listed one that does not.
    pub fn of(&self, subject: &Subject, wavelengths: bool) -> Result<Vec<FresnelModel>, SceneError> {
        match self {
            Self::All => {
                let fits = |model: &FresnelModel| check(*model, subject, wavelengths).is_ok();
                Ok(FresnelModel::ALL.iter().copied().filter(fits).collect())
            }
            Self::Listed(models) => {
                models.iter().try_for_each(|&model| check(model, subject, wavelengths)).map_err(refusal)?;
                Ok(models.clone())
            }
        }
    }

    /// Says on standard error which of all models were left out of each material.
    pub fn note_left_out(&self, subjects: &[Subject], wavelengths: bool) {
        if *self != Self::All {
            return;
        }
        for &model in FresnelModel::ALL {
            let without: Vec<_> = subjects
                .iter()
                .filter_map(|subject| check(model, subject, wavelengths).err().map(|why| (subject, why)))
                .collect();
            let names: Vec<_> = without.iter().map(|(subject, _)| subject.name.as_str()).collect();
            if let Some((_, why)) = without.first() {
                show::note(format_args!("note: `{model}` left out of {}: {}", some(&names), reason(why)));
            }
        }
    }
}

/// At most four names.
fn some(names: &[&str]) -> String {
    match names {
        [first, second, third, _, _, ..] => format!("{first}, {second}, {third} and {} more", names.len() - 3),
        _ => names.join(", "),
    }
}

fn reason(why: &Unfit) -> &'static str {
    match why {
        Unfit::Conductor { .. } => "it is for dielectrics",
        Unfit::DenserSide { .. } => "its curve is that of the rarer side",
        Unfit::NoWavelengths { .. } => "it knows no wavelengths (--space srgb shows it)",
    }
}

fn refusal(why: Unfit) -> SceneError {
    let error = SceneError::new(&why);
    match why {
        Unfit::NoWavelengths { .. } => error.help("--space srgb compares models in red, green and blue"),
        _ => error,
    }
}

/// Colours in linear sRGB as the CIE 1931 observer sees them under a light of the library.
pub fn meter(light: &str, library: &Library) -> Result<Colorimeter, SceneError> {
    let light = library.illuminant(light, Path::new(""))?;
    let observer = library.observer(Observer::Cie1931)?;
    Ok(Colorimeter::new(&light.spectrum, &observer, RgbSpace::Srgb, Adaptation::Bradford)?)
}
