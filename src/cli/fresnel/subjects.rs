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
        let mut all: Vec<Optics> = Vec::new();
        for name in names {
            let found = optics(name, data(name), library)?;
            // Whoever says gold and Au means one material.
            if all.iter().all(|other| other.name != found.name) {
                all.push(found);
            }
        }
        Ok(all)
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

    /// Says on standard error which of all models were left out, a line for each reason.
    pub fn note_left_out(&self, subjects: &[Subject], wavelengths: bool) {
        if *self != Self::All {
            return;
        }
        let mut left_out: Vec<(&'static str, Vec<&str>, Vec<&str>)> = Vec::new();
        for subject in subjects {
            for &model in FresnelModel::ALL {
                let Err(why) = check(model, subject, wavelengths) else { continue };
                let reason = reason(&why);
                let known = left_out.iter().position(|line| line.0 == reason).unwrap_or_else(|| {
                    left_out.push((reason, Vec::new(), Vec::new()));
                    left_out.len() - 1
                });
                let (_, models, names) = &mut left_out[known];
                add(models, model.name());
                add(names, &subject.name);
            }
        }
        for (reason, models, names) in left_out {
            show::note(format_args!("note: left out for {}: {} ({reason})", some(&names), models.join(", ")));
        }
    }
}

fn add<'a>(list: &mut Vec<&'a str>, name: &'a str) {
    if !list.contains(&name) {
        list.push(name);
    }
}

/// Four names, or three and the number of the others.
fn some(names: &[&str]) -> String {
    match names {
        [first, second, third, _, _, ..] => format!("{first}, {second}, {third} and {} more", names.len() - 3),
        _ => names.join(", "),
    }
}

fn reason(why: &Unfit) -> &'static str {
    match why {
        Unfit::Conductor { .. } => "models of dielectrics",
        Unfit::DenserSide { .. } => "RGB models, made for the rarer side",
        Unfit::NoWavelengths { .. } => "RGB models: --space srgb shows them",
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
