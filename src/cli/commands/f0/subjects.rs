//! Which materials a table is about, and the data sets of each.

use super::F0Args;
use crate::report::f0::{Families, Instrument, Subject, Table};
use crate::scene::materials::Material;
use crate::scene::{Class, Optics, SceneError, Text, optics};
use crate::spectrum::Library;
use rayon::prelude::*;
use std::path::Path;

/// The table that was asked for.
pub fn table(args: &F0Args, library: &Library, instrument: &Instrument) -> Result<Table, SceneError> {
    let subjects = subjects(args, library)?;
    if !args.all_data_sets {
        return Ok(Table::new(&subjects, instrument));
    }
    let families = families(library, instrument)?;
    let member = |subject: &Subject, set: &str| {
        let ior = if set == subject.ior.about.name { subject.ior.clone() } else { library.ior(set, Path::new(""))? };
        Ok(Subject { ior, why: library.why(set), ..subject.clone() })
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
    if !args.materials.is_empty() {
        return Ok(args
            .data
            .named(&args.materials, library)?
            .into_iter()
            .map(|optics| subject(optics, library))
            .collect());
    }
    let mut found = of_library(library)?;
    found.retain(|optics| args.all || optics.class == Class::Conductor);
    args.data.replace(&mut found, library)?;
    Ok(found.into_iter().map(|optics| subject(optics, library)).collect())
}

fn subject(optics: Optics, library: &Library) -> Subject {
    let why = library.why(&optics.ior.about.name);
    Subject { name: optics.name, conductor: optics.class == Class::Conductor, ior: optics.ior, why }
}

/// Every material that has an index of refraction.
pub fn of_library(library: &Library) -> Result<Vec<Optics>, SceneError> {
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
    Ok(material.index().is_some())
}

/// Which data sets belong to which material of the library.
pub fn families(library: &Library, instrument: &Instrument) -> Result<Families, SceneError> {
    let primaries: Vec<_> = of_library(library)?.into_iter().map(|optics| optics.ior).collect();
    Ok(Families::new(&primaries, library, instrument)?)
}
