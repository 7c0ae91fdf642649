//! `spectrel fresnel curve`: reflectance against angle or wavelength, as numbers or as a figure.

use super::numbers::{Kind, list};
use super::subjects::{meter, subject};
use crate::cli::show;
use crate::cli::subjects::{DataArgs, Models};
use crate::report::fresnel::curve::{Angle, Grid, Lane, Over, Row, rows};
use crate::report::fresnel::curve_plot::{MOST_PANELS, figure, panel_count};
use crate::report::fresnel::{Subject, text};
use crate::report::markup;
use crate::scene::{Class, Optics, SceneError};
use crate::spectrum::Library;
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use std::path::PathBuf;

const AFTER_HELP: &str = "\
Examples:
  spectrel fresnel curve gold -o gold.svg
  spectrel fresnel curve gold aluminium --space srgb --models exact,schlick-rgb,f82 -o models.svg
  spectrel fresnel curve silver --over wavelength --angles 0,60
  spectrel fresnel curve diamond --from inside --wavelengths 550 --models exact,schlick-incident,schlick-transmitted

CSV columns and JSON keys: material, model, lane (nm, or r, g, b), cos_theta, theta_deg, Rs, Rp (empty or null for
models without polarisation), R.";

#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct CurveArgs {
    /// Materials or data sets of the index of refraction
    #[arg(value_name = "MATERIAL", required = true)]
    materials: Vec<String>,
    /// Fresnel models by name, separated by commas, or `all`
    #[arg(long, value_name = "LIST|all", default_value = "exact")]
    models: Models,
    /// What runs along a curve
    #[arg(long, value_enum, default_value = "angle")]
    over: Abscissa,
    /// Wavelengths, nm: numbers and ranges such as 380-780:5 [default: 450,550,650; over wavelength 380-780:5]
    #[arg(long, value_name = "LIST")]
    wavelengths: Option<String>,
    /// Colours instead of wavelengths: red, green and blue of linear sRGB under D65
    #[arg(long, value_enum, conflicts_with = "wavelengths")]
    space: Option<Space>,
    /// Angles of incidence, degrees [default: 0-90:1, as md 0-90:10, as svg 0-90:0.25; over wavelength 0]
    #[arg(long, value_name = "LIST")]
    angles: Option<String>,
    /// Cosines of the angles instead, such as 0-1:0.01
    #[arg(long, value_name = "LIST", conflicts_with = "angles")]
    cosines: Option<String>,
    /// Side that light comes from; `inside` is for dielectrics
    #[arg(long, value_enum, default_value = "outside")]
    from: Side,
    /// A clear medium outside, such as water [default: vacuum]
    #[arg(long, value_name = "MATERIAL")]
    outside: Option<String>,
    #[command(flatten)]
    data: DataArgs,
    /// Numbers, a figure, or a short table [default: what the output file's name ends in, or csv]
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Write to a file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Abscissa {
    Angle,
    Wavelength,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Space {
    Srgb,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Side {
    Outside,
    Inside,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    Csv,
    Json,
    Svg,
    Md,
}

const WAVELENGTHS: Kind = Kind { option: "--wavelengths", range: [10.0, 100_000.0], example: "380-780:5" };
const ANGLES: Kind = Kind { option: "--angles", range: [0.0, 90.0], example: "0-90:5" };
const COSINES: Kind = Kind { option: "--cosines", range: [0.0, 1.0], example: "0-1:0.01" };

pub fn run(args: &CurveArgs) -> Result<(), SceneError> {
    let format = args.format()?;
    let grid = args.grid(format)?;
    let library = args.data.open()?;
    let optics = args.data.named(&args.materials, &library)?;
    let outside = args.outside(&library)?;
    let subjects = args.subjects(&optics, outside.as_ref())?;
    let rows = curves(&subjects, &args.models, &grid, &library)?;
    args.models.note_left_out(&subjects, args.space.is_none());
    optics.iter().chain(&outside).for_each(|optics| warn_of_range(optics, &grid));
    let text = match format {
        Format::Csv => text::curve_full(&rows).csv().map_err(SceneError::new)?,
        Format::Json => markup::json(&rows).map_err(SceneError::new)? + "\n",
        Format::Md => text::curve_brief(&rows).markdown(),
        Format::Svg => drawn(&rows, grid.over)?,
    };
    show::answer_to(args.output.as_deref(), &text)
}

impl CurveArgs {
    fn format(&self) -> Result<Format, SceneError> {
        let extension = self.output.as_ref().and_then(|path| path.extension()).and_then(|name| name.to_str());
        match (self.format, extension) {
            (Some(format), _) => Ok(format),
            (None, None) => Ok(Format::Csv),
            (None, Some(extension)) => Format::from_str(extension, true).map_err(|_| {
                let message = format!("curves make no `.{extension}` file");
                SceneError::new(message).help("name it .svg, .csv, .json or .md, or say --format")
            }),
        }
    }

    fn grid(&self, format: Format) -> Result<Grid, SceneError> {
        let over = match self.over {
            Abscissa::Angle => Over::Angle,
            Abscissa::Wavelength => Over::Wavelength,
        };
        Ok(Grid { over, lanes: self.lanes(over)?, angles: self.angles(over, format)? })
    }

    fn lanes(&self, over: Over) -> Result<Vec<Lane>, SceneError> {
        if self.space.is_some() && over == Over::Wavelength {
            return Err(SceneError::new("--space srgb has no wavelengths for --over wavelength to run over"));
        }
        if let Some(Space::Srgb) = self.space {
            return Ok(Lane::RGB.to_vec());
        }
        let default = if over == Over::Angle { "450,550,650" } else { "380-780:5" };
        let wavelengths = list(self.wavelengths.as_deref().unwrap_or(default), WAVELENGTHS)?;
        Ok(wavelengths.into_iter().map(Lane::Nm).collect())
    }

    fn angles(&self, over: Over, format: Format) -> Result<Vec<Angle>, SceneError> {
        if let Some(cosines) = &self.cosines {
            return Ok(list(cosines, COSINES)?.into_iter().map(Angle::from_cosine).collect());
        }
        let default = match (over, format) {
            (Over::Wavelength, _) => "0",
            (Over::Angle, Format::Md) => "0-90:10",
            // What rises steeply at a critical angle is drawn as steep.
            (Over::Angle, Format::Svg) => "0-90:0.25",
            (Over::Angle, _) => "0-90:1",
        };
        let degrees = list(self.angles.as_deref().unwrap_or(default), ANGLES)?;
        Ok(degrees.into_iter().map(Angle::from_degrees).collect())
    }

    fn outside(&self, library: &Library) -> Result<Option<Optics>, SceneError> {
        let Some(name) = &self.outside else { return Ok(None) };
        let found = crate::scene::optics(name, None, library)?;
        match found.class {
            Class::Dielectric => Ok(Some(found)),
            Class::Conductor => {
                Err(SceneError::new(format!("--outside {name}: light does not come through a conductor")))
            }
        }
    }

    fn subjects<'a>(&self, inside: &'a [Optics], outside: Option<&'a Optics>) -> Result<Vec<Subject<'a>>, SceneError> {
        let one = |optics: &'a Optics| {
            let subject = subject(optics);
            let subject = match outside {
                Some(outside) => subject.in_medium(&outside.ior.n),
                None => subject,
            };
            match self.from {
                Side::Outside => Ok(subject),
                Side::Inside if subject.clear => Ok(subject.from_inside()),
                Side::Inside => Err(SceneError::new(format!(
                    "--from inside: `{}` is a conductor, no light comes out of it",
                    subject.name
                ))),
            }
        };
        inside.iter().map(one).collect()
    }
}

fn curves(subjects: &[Subject], models: &Models, grid: &Grid, library: &Library) -> Result<Vec<Row>, SceneError> {
    let wavelengths = grid.lanes.iter().any(|lane| matches!(lane, Lane::Nm(_)));
    let mut pairs = Vec::new();
    for subject in subjects {
        pairs.extend(models.of(subject, wavelengths)?.into_iter().map(|model| (subject, model)));
    }
    let meter = meter("D65", library)?;
    Ok(pairs.into_par_iter().map(|(subject, model)| rows(model, subject, &meter, grid)).collect::<Vec<_>>().concat())
}

fn drawn(rows: &[Row], over: Over) -> Result<String, SceneError> {
    let panels = panel_count(rows, over);
    if panels > MOST_PANELS {
        let message = format!("this would be a figure of {panels} panels: at most {MOST_PANELS} are drawn");
        let help = "with several models each material and wavelength has a panel; one model has all wavelengths in one";
        return Err(SceneError::new(message).help(help));
    }
    Ok(figure(rows, over).svg())
}

/// Beyond its data the ends of a table are held, and a formula is extrapolated.
fn warn_of_range(optics: &Optics, grid: &Grid) {
    let asked = grid.lanes.iter().filter_map(|lane| match lane {
        Lane::Nm(nm) => Some(*nm),
        Lane::Channel(_) => None,
    });
    let [low, high] = asked.fold([f64::INFINITY, 0.0], |[low, high], nm: f64| [low.min(nm), high.max(nm)]);
    let about = &optics.ior.about;
    if let (Some((first, last)), true) = (about.range_nm, low <= high && !about.covers_nm(low, high)) {
        show::warning(format_args!(
            "`{}` ({}) covers {first}–{last} nm: beyond, its ends are held or its formula is extrapolated",
            about.name, optics.name
        ));
    }
}
