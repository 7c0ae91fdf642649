//! `spectrel f0`: colour tables of materials, and tables of others against ours.

use super::{LibraryArgs, show};
use crate::report::f0::check::{Checked, Claim, Known, judge};
use crate::report::f0::claims::{self, ClaimsError};
use crate::report::f0::formats::{self, Format, Report};
use crate::report::f0::{Conditions, Families, Instrument, Likenesses, Subject, Table, observer_name};
use crate::scene::describe::Material;
use crate::scene::{Class, Optics, SceneError, Text, optics};
use crate::spectrum::{Adaptation, Library, Observer, RgbSpace, encode_srgb, nearest, srgb_from_hex};
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

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
    /// Judge a CSV table of colours (columns material, r, g, b, encoding and perhaps table; encoding is linear or sRGB) against every data
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
    match (&args.check, &args.match_color) {
        (Some(file), _) => answer(&checked(file, args, &library, &instrument)?, args.format),
        (_, Some(color)) => answer(&likenesses(color, args, &library, &instrument)?, args.format),
        _ => answer(&table(args, &library, &instrument)?, args.format),
    }
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
    replace(&mut found, &args.ior, library)?;
    Ok(found.into_iter().map(subject).collect())
}

/// Other data sets for some of the materials.
fn replace(found: &mut [Optics], by: &[(String, String)], library: &Library) -> Result<(), SceneError> {
    for (name, data) in by {
        let replaced = optics(name, Some(data), library)?;
        let Some(place) = found.iter_mut().find(|optics| optics.name == replaced.name) else {
            return Err(SceneError::new(format!("--ior {name}={data}: `{}` is not in this table", replaced.name)));
        };
        *place = replaced;
    }
    Ok(())
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

/// Every material with F0 of all its data sets.
fn known(args: &F0Args, library: &Library, instrument: &Instrument) -> Result<Vec<(Known, Class)>, SceneError> {
    let mut materials = of_library(library)?;
    let families = families(library, instrument)?;
    replace(&mut materials, &args.ior, library)?;
    let known = |optics: Optics| {
        let own = &optics.ior.about.name;
        let candidate = |set: String| {
            let ior = if set == *own { optics.ior.clone() } else { library.ior(&set, Path::new(""))? };
            Ok((set, instrument.f0(&ior)))
        };
        let candidates = families.of(own).into_iter().map(candidate).collect::<Result<_, SceneError>>()?;
        Ok((Known { name: optics.name, candidates }, optics.class))
    };
    materials.into_iter().map(known).collect()
}

fn checked(file: &Path, args: &F0Args, library: &Library, instrument: &Instrument) -> Result<Checked, SceneError> {
    let shown = file.display();
    let text = std::fs::read(file).map_err(|error| SceneError::new(format!("cannot read {shown}: {error}")))?;
    let claims = claims::read(&text).map_err(|ClaimsError { line, message }| {
        let line = line.map(|line| format!(":{line}")).unwrap_or_default();
        SceneError::new(format!("{shown}{line}: {message}")).help(COLUMNS)
    })?;
    let known = known(args, library, instrument)?;
    let verdict = |claim: Claim| {
        let found = optics(&claim.material, None, library);
        // Others write `Stainless Steel` or `stainless_steel`.
        let found =
            found.or_else(|error| optics(&claim.material.replace([' ', '_'], "-"), None, library).map_err(|_| error));
        let own = found.as_ref().map_err(ToString::to_string).and_then(|optics| {
            let same = known.iter().map(|(known, _)| known).find(|known| known.name == optics.name);
            same.ok_or_else(|| format!("`{}` is a data set, not a material", optics.name))
        });
        judge(claim, own, instrument)
    };
    Ok(Checked::new(claims.into_iter().map(verdict).collect(), instrument))
}

const COLUMNS: &str = "the first line that is no comment names the columns, such as `table,material,r,g,b,encoding`";

/// How many metals --match names.
const LIKENESSES: usize = 5;

fn likenesses(
    color: &str,
    args: &F0Args,
    library: &Library,
    instrument: &Instrument,
) -> Result<Likenesses, SceneError> {
    let linear = color_of(color, args.space).map_err(|error| SceneError::new(format!("--match {color}: {error}")))?;
    let known = known(args, library, instrument)?;
    let metals: Vec<_> =
        known.into_iter().filter(|(_, class)| *class == Class::Conductor).map(|(metal, _)| metal).collect();
    Ok(Likenesses::new(linear, &metals, LIKENESSES, instrument))
}

/// Linear RGB of `#rrggbb`, encoded in the space, or of three linear numbers.
fn color_of(text: &str, space: RgbSpace) -> Result<[f64; 3], String> {
    let hex = || format!("expected #rrggbb or three linear numbers such as 1.0,0.78,0.34");
    if let Some(rgb) = srgb_from_hex(text) {
        return Ok(rgb.map(|linear| space.decode(encode_srgb(linear))));
    }
    let numbers: Vec<f64> =
        text.split(',').map(|number| number.trim().parse()).collect::<Result<_, _>>().map_err(|_| hex())?;
    match <[f64; 3]>::try_from(numbers) {
        Ok(rgb) if rgb.iter().all(|value| (0.0..=2.0).contains(value)) => Ok(rgb),
        Ok(_) => Err("a reflectance is about 0…1".into()),
        Err(_) => Err(hex()),
    }
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
