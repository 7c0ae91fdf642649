//! What a command line puts in the place of a scene's materials, and of the data that they stand on.

use super::Resolver;
use crate::scene::{Overrides, SceneError};
use crate::spectrum::{Ior, nearest};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// By the names that the scene has for its materials.
#[derive(Debug, Default)]
pub struct Substitutes {
    materials: BTreeMap<String, String>,
    indices: BTreeMap<String, String>,
}

impl Substitutes {
    pub fn new(overrides: &Overrides) -> Result<Self, SceneError> {
        Ok(Self { materials: by_name(&overrides.vary, "vary")?, indices: by_name(&overrides.ior, "ior")? })
    }

    /// The material that stands for `name`; itself unless replaced.
    pub fn material<'a>(&'a self, name: &'a str) -> &'a str {
        self.materials.get(name).map_or(name, String::as_str)
    }

    pub fn is_replaced(&self, name: &str) -> bool {
        self.materials.contains_key(name)
    }

    /// The index of refraction that `material` is to have in place of its own.
    pub fn index(&self, material: &str) -> Option<&str> {
        self.indices.get(material).map(String::as_str)
    }

    /// The option and the name of every material that is to change.
    fn names(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let replaced = self.materials.keys().map(|name| ("vary", name.as_str()));
        replaced.chain(self.indices.keys().map(|name| ("ior", name.as_str())))
    }
}

fn by_name(pairs: &[(String, String)], option: &str) -> Result<BTreeMap<String, String>, SceneError> {
    let mut found = BTreeMap::new();
    for (name, by) in pairs {
        if found.insert(name.clone(), by.clone()).is_some() {
            return Err(SceneError::new(format!("--{option} names the material `{name}` twice")));
        }
    }
    Ok(found)
}

impl Resolver<'_> {
    /// The data set of the command line for a material, if it names one; relative file names start where the program runs.
    pub fn substitute_index(&mut self, material: &str, used_by: &str) -> Result<Option<Arc<Ior>>, SceneError> {
        let Some(name) = self.substitutes.index(material) else { return Ok(None) };
        let found = self.library.ior(name, Path::new(""));
        let found = found.map_err(|error| SceneError::new(format!("--ior {material}={name}: {error}")))?;
        self.note_data(used_by, &found.about);
        Ok(Some(found))
    }

    /// A material of a kind that has no index of refraction cannot be given one.
    pub fn refuse_index(&self, material: &str, kind: &str) -> Result<(), SceneError> {
        let Some(name) = self.substitutes.index(material) else { return Ok(()) };
        let message = format!(
            "--ior {material}={name}: the material `{material}` is {kind}: it has no index of refraction that `{name}` could replace"
        );
        Err(SceneError::new(message))
    }

    /// Everything that the command line changes must be there.
    pub fn check_substitutes(&self) -> Result<(), SceneError> {
        let known = || self.by_name.keys().chain(&self.outside_name).map(String::as_str);
        let Some((option, name)) = self.substitutes.names().find(|(_, name)| !known().any(|known| known == *name))
        else {
            return Ok(());
        };
        let error = SceneError::new(format!("--{option} {name}=…: this scene has no material `{name}`"));
        Err(error.help(match nearest(name, known()) {
            Some(nearest) => format!("did you mean `{nearest}`?"),
            None => format!("its materials are {}", known().collect::<Vec<_>>().join(", ")),
        }))
    }
}
