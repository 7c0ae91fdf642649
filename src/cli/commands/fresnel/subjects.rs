//! Interfaces, the models that apply to them, and the light they are seen in.

use crate::cli::show;
use crate::cli::subjects::{Models, some};
use crate::fresnel::FresnelModel;
use crate::report::fresnel::{Subject, Unfit, check};
use crate::scene::{Class, Optics, SceneError};
use crate::spectrum::{Adaptation, Colorimeter, Library, Observer, RgbSpace};
use std::path::Path;

pub fn subject(optics: &Optics) -> Subject<'_> {
    Subject::new(optics.name.clone(), &optics.ior, optics.class == Class::Dielectric)
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
