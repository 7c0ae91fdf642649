//! `spectrel f0`: colour tables of materials, and tables of others against ours.

mod against;
mod subjects;

use crate::cli::show;
use crate::cli::subjects::DataArgs;
use crate::report::f0::formats::{self, Format, Report};
use crate::report::f0::{Conditions, Instrument, observer_name};
use crate::scene::SceneError;
use crate::spectrum::{Adaptation, Observer, RgbSpace, nearest};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct F0Args {
    /// Materials by name or alias, or data sets such as `Au/johnson-christy-1972` [default: every conductor]
    #[arg(conflicts_with_all = ["all", "check", "match_color"])]
    materials: Vec<String>,
    /// Every material that has an index of refraction
    #[arg(long, conflicts_with_all = ["check", "match_color"])]
    all: bool,
    /// A row for each published data set of each material, and how far apart they are (ΔE2000)
    #[arg(long, conflicts_with_all = ["check", "match_color"])]
    all_data_sets: bool,
    /// Judge a CSV table of colours (columns material or name, r, g, b and perhaps table and encoding, which is linear or sRGB; linear
    /// is assumed where it is not said) against every data
    /// set of each material: a match is ΔE2000 ≤ 1, near ≤ 2, and what matches only under the other encoding is mis-encoded
    #[arg(long, value_name = "FILE", conflicts_with = "match_color")]
    check: Option<PathBuf>,
    /// Name the metals that look most like a colour: `#ffd891`, or linear 1.0,0.78,0.34
    #[arg(long = "match", value_name = "COLOR")]
    match_color: Option<String>,
    /// Light, by its name in `spectrel list illuminants`, or a CSV or TOML file
    #[arg(long, value_name = "NAME", default_value = "D65")]
    illuminant: String,
    /// CIE observer: 1931-2, 1964-10 or 2015-2
    #[arg(long, value_name = "NAME", default_value = "1931-2", value_parser = observer)]
    observer: Observer,
    /// RGB space: srgb, display-p3, rec2020 or acescg; also that of the numbers of --check and --match
    #[arg(long, value_name = "NAME", default_value = "srgb", value_parser = space)]
    space: RgbSpace,
    /// Whether the light's white becomes that of the space: bradford or none
    #[arg(long, value_name = "HOW", default_value = "bradford", value_parser = adaptation)]
    adapt: Adaptation,
    /// What to print; csv, json and toml have every column, gltf (spheres) and mtlx (open_pbr_surface) are files to load
    #[arg(long, value_enum, default_value = "table")]
    format: FormatName,
    #[command(flatten)]
    data: DataArgs,
}

const AFTER_HELP: &str = "\
Examples:
  spectrel f0                                        every conductor
  spectrel f0 gold copper diamond --format json
  spectrel f0 --all --format html > f0.html          a page with swatches
  spectrel f0 gold --all-data-sets                   how far published sets are apart
  spectrel f0 gold silver --format mtlx > metals.mtlx
  spectrel f0 --check table.csv                      whose data a table was made from
  spectrel f0 --match '#ffd891'                      which metals look like this
  spectrel f0 silver --illuminant A --space acescg --adapt none";

#[derive(Clone, Copy, Debug, ValueEnum)]
enum FormatName {
    Table,
    Md,
    Csv,
    Json,
    Toml,
    Html,
    Gltf,
    Mtlx,
}

impl From<FormatName> for Format {
    fn from(name: FormatName) -> Self {
        match name {
            FormatName::Table => Self::Table,
            FormatName::Md => Self::Markdown,
            FormatName::Csv => Self::Csv,
            FormatName::Json => Self::Json,
            FormatName::Toml => Self::Toml,
            FormatName::Html => Self::Html,
            FormatName::Gltf => Self::Gltf,
            FormatName::Mtlx => Self::MaterialX,
        }
    }
}

pub fn run(args: &F0Args) -> Result<(), SceneError> {
    let library = args.data.open()?;
    let instrument = Instrument::new(args.conditions(), &library)?;
    match (&args.check, &args.match_color) {
        (Some(file), _) => answer(&against::checked(file, args, &library, &instrument)?, args.format),
        (_, Some(color)) => answer(&against::likenesses(color, args, &library, &instrument)?, args.format),
        _ => answer(&subjects::table(args, &library, &instrument)?, args.format),
    }
}

/// Everything is computed by now: half a table looks like a whole one.
fn answer(report: &impl Report, format: FormatName) -> Result<(), SceneError> {
    show::answer(formats::text(report, format.into()).map_err(SceneError::new)?)
}

impl F0Args {
    fn conditions(&self) -> Conditions {
        Conditions {
            illuminant: self.illuminant.clone(),
            observer: self.observer,
            space: self.space,
            adaptation: self.adapt,
        }
    }
}

fn observer(name: &str) -> Result<Observer, String> {
    let plain = name.trim_start_matches("cie-");
    one_of(plain, Observer::ALL, observer_name)
}

fn space(name: &str) -> Result<RgbSpace, String> {
    RgbSpace::from_name(name).map_or_else(|| one_of(name, RgbSpace::ALL, RgbSpace::name), Ok)
}

fn adaptation(name: &str) -> Result<Adaptation, String> {
    one_of(name, Adaptation::ALL, Adaptation::name)
}

/// The value of this name, or an error that lists all and names the nearest.
fn one_of<T: Copy>(wanted: &str, all: impl IntoIterator<Item = T>, name: fn(T) -> &'static str) -> Result<T, String> {
    let all: Vec<T> = all.into_iter().collect();
    if let Some(found) = all.iter().find(|value| name(**value) == wanted) {
        return Ok(*found);
    }
    let names: Vec<_> = all.iter().map(|value| name(*value)).collect();
    let hint = nearest(wanted, names.iter().copied()).map(|near| format!("; did you mean `{near}`?"));
    Err(format!("expected {}{}", names.join(", "), hint.unwrap_or_default()))
}
