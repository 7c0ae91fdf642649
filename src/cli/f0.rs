//! `spectrel f0`: colour tables of materials, and tables of others against ours.

use super::{LibraryArgs, show};
use crate::report::f0::formats::{self, Format, Report};
use crate::report::f0::{Conditions, Families, Instrument, Subject, Table, observer_name};
use crate::scene::describe::Material;
use crate::scene::{Class, Optics, SceneError, Text, optics};
use crate::spectrum::{Adaptation, Library, Observer, RgbSpace, nearest};
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct F0Args {
    /// Materials by name or alias, or data sets such as `Au/johnson-christy-1972` [default: every conductor]
    #[arg(conflicts_with = "all")]
    materials: Vec<String>,
    /// Every material that has an index of refraction
    #[arg(long)]
    all: bool,
    /// A row for each published data set of each material, and how far apart they are (ΔE2000)
    #[arg(long)]
    all_data_sets: bool,
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
    /// Another data set for a material, such as gold=Au/johnson-christy-1972; can be repeated
    #[arg(long, value_name = "MATERIAL=DATA", value_parser = replacement)]
    ior: Vec<(String, String)>,
    /// What to print; csv, json and toml have every column
    #[arg(long, value_enum, default_value = "table")]
    format: FormatName,
    #[command(flatten)]
    library: LibraryArgs,
}

const AFTER_HELP: &str = "\
Examples:
  spectrel f0                                        every conductor
  spectrel f0 gold copper diamond --format json
  spectrel f0 --all --format html > f0.html          a page with swatches
  spectrel f0 gold --all-data-sets                   how far published sets are apart
  spectrel f0 silver --illuminant A --space acescg --adapt none";

#[derive(Clone, Copy, Debug, ValueEnum)]
enum FormatName {
    Table,
    Md,
    Csv,
    Json,
    Toml,
    Html,
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
        }
    }
}

pub fn run(args: &F0Args) -> Result<(), SceneError> {
    let library = args.library.open()?;
    let instrument = Instrument::new(args.conditions(), &library)?;
    answer(&table(args, &library, &instrument)?, args.format)
}

/// Everything is computed by now: half a table looks like a whole one.
fn answer(report: &impl Report, format: FormatName) -> Result<(), SceneError> {
    show::answer(formats::text(report, format.into()).map_err(SceneError::new)?);
    Ok(())
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

fn table(args: &F0Args, library: &Library, instrument: &Instrument) -> Result<Table, SceneError> {
    let subjects = subjects(args, library)?;
    if !args.all_data_sets {
        return Ok(Table::new(&subjects, instrument));
    }
    let families = families(library, instrument)?;
    let member = |subject: &Subject, set: &str| {
        let ior = if set == subject.ior.about.name { subject.ior.clone() } else { library.ior(set, Path::new(""))? };
        Ok(Subject { ior, ..subject.clone() })
    };
    let sets = |subject: &Subject| {
        let sets = families.of(&subject.ior.about.name);
        sets.iter().map(|set| member(subject, set)).collect::<Result<Vec<_>, SceneError>>()
    };
    let materials = subjects.iter().map(sets).collect::<Result<Vec<_>, _>>()?;
    Ok(Table::with_all_data_sets(&materials, instrument))
}

/// What the table is about.
fn subjects(args: &F0Args, library: &Library) -> Result<Vec<Subject>, SceneError> {
    let named = !args.materials.is_empty();
    let mut found = if named { of_names(&args.materials, library)? } else { of_library(library)? };
    found.retain(|optics| named || args.all || optics.class == Class::Conductor);
    for (name, data) in &args.ior {
        let replaced = optics(name, Some(data), library)?;
        let Some(place) = found.iter_mut().find(|optics| optics.name == replaced.name) else {
            return Err(SceneError::new(format!("--ior {name}={data}: `{}` is not in this table", replaced.name)));
        };
        *place = replaced;
    }
    Ok(found.into_iter().map(subject).collect())
}

fn subject(optics: Optics) -> Subject {
    Subject { name: optics.name, conductor: optics.class == Class::Conductor, ior: optics.ior }
}

/// Each once, in the order of the names.
fn of_names(names: &[String], library: &Library) -> Result<Vec<Optics>, SceneError> {
    let mut found: Vec<Optics> = Vec::new();
    for name in names {
        let optics = optics(name, None, library)?;
        if found.iter().all(|other| other.name != optics.name) {
            found.push(optics);
        }
    }
    Ok(found)
}

/// Every material that has an index of refraction.
fn of_library(library: &Library) -> Result<Vec<Optics>, SceneError> {
    let names = library.material_names();
    let found = names.par_iter().map(|name| match has_index(name, library)? {
        true => optics(name, None, library).map(Some),
        false => Ok(None),
    });
    Ok(found.collect::<Result<Vec<_>, SceneError>>()?.into_iter().flatten().collect())
}

fn has_index(name: &str, library: &Library) -> Result<bool, SceneError> {
    let found = library.material(name)?;
    let material: Material = Text::new(found.origin, found.text).parse()?;
    Ok(material.conductor.is_some() || material.dielectric.is_some())
}

fn families(library: &Library, instrument: &Instrument) -> Result<Families, SceneError> {
    let primaries: Vec<_> = of_library(library)?.into_iter().map(|optics| optics.ior.about.name.clone()).collect();
    Ok(Families::new(&primaries, library, instrument)?)
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

fn replacement(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, data)) if !name.is_empty() && !data.is_empty() => Ok((name.trim().into(), data.trim().into())),
        _ => Err("expected MATERIAL=DATA, such as gold=Au/johnson-christy-1972".into()),
    }
}
