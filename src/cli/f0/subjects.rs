//! Which materials a table is about, and the data sets of each.

use super::F0Args;
use crate::report::f0::{Families, Instrument, Subject, Table};
use crate::scene::describe::Material;
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
pub fn replace(found: &mut [Optics], by: &[(String, String)], library: &Library) -> Result<(), SceneError> {
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
    Ok(material.conductor.is_some() || material.dielectric.is_some())
}

/// Which data sets belong to which material of the library.
pub fn families(library: &Library, instrument: &Instrument) -> Result<Families, SceneError> {
    let primaries: Vec<_> = of_library(library)?.into_iter().map(|optics| optics.ior).collect();
    Ok(Families::new(&primaries, library, instrument)?)
}
