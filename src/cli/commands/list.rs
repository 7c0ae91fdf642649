//! `spectrel list`: what scenes can name, and where it comes from.

use crate::cli::scene_file::LibraryArgs;
use crate::cli::show;
use crate::report::markup;
use crate::scene::materials::{Kind, Material};
use crate::scene::{SceneError, Text};
use crate::spectrum::{About, Library, Observer, Quantity, citation};
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::path::Path;

#[derive(Debug, Args)]
pub struct ListArgs {
    /// What to list
    what: What,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    library: LibraryArgs,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum What {
    /// Names for `material = "…"`
    Materials,
    /// Names for `ior`, `absorption` and `reflectance`, and the observers
    Spectra,
    /// Names for `spectrum` and `white_balance`
    Illuminants,
}

/// A material or a data set, as much as its kind has.
#[derive(Clone, Serialize)]
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
        What::Spectra => {
            let quantities = [Quantity::Ior, Quantity::Absorption, Quantity::Reflectance, Quantity::Observer];
            let sets = quantities.map(|quantity| data_sets(&library, quantity));
            sets.into_iter().collect::<Result<Vec<_>, _>>()?.concat()
        }
        What::Illuminants => data_sets(&library, Quantity::Illuminant)?,
    };
    show::answer(if args.json { markup::json(&entries).map_err(SceneError::new)? } else { text(args.what, &entries) })
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
    let kind = material.kind().map_or("no kind", Kind::name);
    let data = material.data().map(|(quantity, name)| (quantity, name.to_owned()));
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

fn text(what: What, entries: &[Entry]) -> String {
    let source = |entry: &Entry| citation(&entry.authors, entry.year);
    let range = |entry: &Entry| show::range_nm(entry.range_nm);
    match what {
        What::Materials => {
            let row =
                |e: &Entry| [e.name.clone(), e.aliases.join(", "), e.kind.clone(), e.description.clone(), source(e)];
            show::table(["Material", "Other names", "Kind", "Description", "Data from"], entries.iter().map(row))
        }
        What::Spectra => {
            let row = |e: &Entry| [e.name.clone(), e.kind.clone(), range(e), e.description.clone(), source(e)];
            show::table(["Spectrum", "Quantity", "Range", "Sample", "Source"], entries.iter().map(row))
        }
        What::Illuminants => {
            let row = |e: &Entry| [e.name.clone(), range(e), e.description.clone(), source(e)];
            show::table(["Illuminant", "Range", "Description", "Source"], entries.iter().map(row))
        }
    }
}
