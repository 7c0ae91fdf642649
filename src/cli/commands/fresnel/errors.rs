//! `spectrel fresnel errors`: how far each model is from the exact one.

use super::subjects::{meter, subject};
use crate::cli::show;
use crate::cli::subjects::{DataArgs, Models};
use crate::fresnel::FresnelModel;
use crate::report::fresnel::errors::{Light, Row, rows};
use crate::report::fresnel::{Subject, text};
use crate::report::markup;
use crate::report::timing::{CAREFUL, nanoseconds};
use crate::scene::{Class, SceneError, optics};
use crate::spectrum::Library;
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use std::collections::HashMap;
use std::path::PathBuf;

const AFTER_HELP: &str = "\
JSON: an array of objects with the keys
  material, ior (the data set), model
  max_abs, cos_at_max, rms           linear sRGB under D65, over the cosines 0, 0.01 … 1
  de_mean, de_max, cos_at_de_max     CIEDE2000 of the colours
  f_avg_max_abs, f_avg_de            of F_avg = 2 ∫ F(c) c dc
  ns                                 nanoseconds of one evaluation, eight wavelengths, on this machine
  fitted                             of lazanyi a and alpha, of gulbrandsen g, for r, g and b
  colors                             for each light (D65, A, FL2) and count of bounces (1, 2, 3, 5):
                                     light, bounces, de_mean, de_max, cos_at_de_max, de_normal (at 0°)";

#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct ErrorsArgs {
    /// Materials or data sets [default: silver gold copper aluminium iron diamond]
    #[arg(value_name = "MATERIAL")]
    materials: Vec<String>,
    /// All conductors of the library
    #[arg(long, conflicts_with = "materials")]
    metals: bool,
    /// Fresnel models by name, separated by commas, or `all`
    #[arg(long, value_name = "LIST|all", default_value = "all")]
    models: Models,
    #[command(flatten)]
    data: DataArgs,
    /// `table` is for reading; csv and json hold every number, each light with each count of bounces
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
    /// Write to a file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    Table,
    Csv,
    Json,
    Md,
}

const MATERIALS: [&str; 6] = ["silver", "gold", "copper", "aluminium", "iron", "diamond"];

/// The first one is that of the fits.
const LIGHTS: [&str; 3] = ["D65", "A", "FL2"];

pub fn run(args: &ErrorsArgs) -> Result<(), SceneError> {
    let library = args.data.open()?;
    let optics = args.data.named(&args.names(&library), &library)?;
    let subjects: Vec<_> = optics.iter().map(subject).collect();
    let light = |name: &str| Ok(Light { name: name.to_owned(), meter: meter(name, &library)? });
    let lights = LIGHTS.into_iter().map(light).collect::<Result<Vec<_>, SceneError>>()?;
    let rows = errors(&subjects, &args.models, &lights)?;
    args.models.note_left_out(&subjects, false);
    let text = match args.format {
        Format::Table => text::errors_table(&rows),
        Format::Csv => text::errors_full(&rows).csv().map_err(SceneError::new)?,
        Format::Json => markup::json(&rows).map_err(SceneError::new)? + "\n",
        Format::Md => text::errors_markdown(&rows),
    };
    show::answer_to(args.output.as_deref(), &text)
}

impl ErrorsArgs {
    fn names(&self, library: &Library) -> Vec<String> {
        if self.metals {
            return metals(library);
        }
        if self.materials.is_empty() { MATERIALS.map(str::to_owned).to_vec() } else { self.materials.clone() }
    }
}

/// What has no index, or cannot be read, is no metal.
fn metals(library: &Library) -> Vec<String> {
    let is_metal = |name: &String| optics(name, None, library).is_ok_and(|optics| optics.class == Class::Conductor);
    library.material_names().into_iter().filter(is_metal).collect()
}

fn errors(subjects: &[Subject], models: &Models, lights: &[Light]) -> Result<Vec<Row>, SceneError> {
    let chosen = subjects.iter().map(|subject| models.of(subject, false)).collect::<Result<Vec<_>, _>>()?;
    // Timed first and one after the other, while nothing else runs.
    let mut costs: HashMap<(FresnelModel, bool), f64> = HashMap::new();
    for (subject, models) in subjects.iter().zip(&chosen) {
        for &model in models {
            let time = || nanoseconds(&subject.ready(model, &lights[0].meter), CAREFUL);
            costs.entry((model, subject.clear)).or_insert_with(time);
        }
    }
    let of = |(subject, models): (&Subject, &Vec<FresnelModel>)| {
        rows(subject, models, lights, |model| costs.get(&(model, subject.clear)).copied().unwrap_or(f64::NAN))
    };
    Ok(subjects.par_iter().zip(&chosen).map(of).collect::<Vec<_>>().concat())
}
