//! `spectrel list`: what scenes can name, and where it comes from.

use super::{LibraryArgs, show};
use crate::scene::describe::{IndexSource, Material, ReflectanceSource};
use crate::scene::{SceneError, Text};
use crate::spectrum::{About, Library, Observer, Quantity};
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::path::Path;

#[derive(Debug, Args)]
pub struct ListArgs {
    what: What,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    library: LibraryArgs,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum What {
    Materials,
    Spectra,
    Illuminants,
}

/// A material or a data set, as much as its kind has.
#[derive(Serialize)]
struct Entry {
    name: String,
    kind: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    aliases: Vec<String>,
    description: String,
    /// The data set that a material stands on.
    #[serde(skip_serializing_if = "Option::is_none")]
    data: Option<String>,
    range_nm: Option<(f64, f64)>,
    confidence: String,
    title: String,
    authors: String,
    year: Option<i32>,
    doi: Option<String>,
    licence: String,
}

pub fn run(args: &ListArgs) -> Result<(), SceneError> {
    let library = args.library.open()?;
    let entries = match args.what {
        What::Materials => materials(&library)?,
        What::Spectra => [Quantity::Ior, Quantity::Absorption, Quantity::Reflectance, Quantity::Observer]
            .map(|quantity| data_sets(&library, quantity))
            .into_iter()
            .collect::<Result<Vec<_>, _>>()?
            .into_iter()
            .flatten()
            .collect(),
        What::Illuminants => data_sets(&library, Quantity::Illuminant)?,
    };
    if args.json {
        show::answer(serde_json::to_string_pretty(&entries).map_err(SceneError::new)?);
    } else {
        show::answer(show::columns(&entries.iter().map(row).collect::<Vec<_>>()));
    }
    Ok(())
}

fn data_sets(library: &Library, quantity: Quantity) -> Result<Vec<Entry>, SceneError> {
    let entry = |name: &String| Ok(entry(about(library, quantity, name, Path::new(""))?, name, quantity.as_str()));
    library.names(quantity).iter().map(entry).collect()
}

fn about(library: &Library, quantity: Quantity, name: &str, base: &Path) -> Result<About, SceneError> {
    Ok(match quantity {
        Quantity::Ior => library.ior(name, base)?.about.clone(),
        Quantity::Reflectance => library.reflectance(name, base)?.about.clone(),
        Quantity::Absorption => library.absorption(name, base)?.about.clone(),
        Quantity::Illuminant => library.illuminant(name, base)?.about.clone(),
        Quantity::Observer => {
            let known = Observer::ALL.into_iter().find(|observer| observer.name() == name);
            library.observer(known.unwrap_or(Observer::Cie1931))?.about.clone()
        }
    })
}

fn entry(about: About, name: &str, kind: &str) -> Entry {
    Entry {
        name: name.to_owned(),
        kind: kind.to_owned(),
        aliases: Vec::new(),
        data: None,
        range_nm: about.range_nm,
        confidence: about.confidence().to_string(),
        description: about.sample.description,
        title: about.source.title,
        authors: about.source.authors,
        year: about.source.year,
        doi: about.source.doi,
        licence: about.source.licence,
    }
}

fn materials(library: &Library) -> Result<Vec<Entry>, SceneError> {
    library.material_names().iter().map(|name| material(library, name)).collect()
}

fn material(library: &Library, name: &str) -> Result<Entry, SceneError> {
    let found = library.material(name)?;
    let text = Text::new(found.origin, found.text);
    let material: Material = text.parse()?;
    let index = |source: &IndexSource| match source {
        IndexSource::Name(name) => Some((Quantity::Ior, name.clone())),
        IndexSource::Constant { .. } => None,
    };
    let (kind, data) = match (&material.conductor, &material.dielectric, &material.diffuse) {
        (Some(conductor), ..) => ("conductor", index(conductor.get_ref().ior.get_ref())),
        (_, Some(dielectric), _) => ("dielectric", index(dielectric.get_ref().ior.get_ref())),
        (.., Some(diffuse)) => match diffuse.get_ref().reflectance.get_ref() {
            ReflectanceSource::Name(name) => ("diffuse", Some((Quantity::Reflectance, name.clone()))),
            _ => ("diffuse", None),
        },
        _ => ("no kind", None),
    };
    let about = match &data {
        Some((quantity, name)) => about(library, *quantity, name, &found.base)?,
        None => About::default(),
    };
    Ok(Entry {
        aliases: material.aliases,
        description: material.description.unwrap_or_default(),
        data: data.map(|(_, name)| name),
        ..entry(about, name, kind)
    })
}

fn row(entry: &Entry) -> [String; 4] {
    let names = match entry.aliases.as_slice() {
        [] => entry.name.clone(),
        aliases => format!("{} ({})", entry.name, aliases.join(", ")),
    };
    let year = entry.year.map_or(String::new(), |year| format!(" {year}"));
    let first_author = entry.authors.split([',', ';']).next().unwrap_or_default();
    [names, entry.kind.clone(), entry.description.clone(), format!("{first_author}{year}")]
}
