//! What an interface needs to know of a material, without a scene around it: for tables and curves.

use super::materials::{IndexSource, Kind, Material};
use super::{SceneError, Text};
use crate::spectrum::{Ior, LAMBDA_MAX_NM, LAMBDA_MIN_NM, Library, SpectrumError};
use std::path::Path;
use std::sync::Arc;
use toml::Spanned;

/// Which side of an interface light goes on to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Class {
    /// What enters is lost.
    Conductor,
    /// What enters goes on.
    Dielectric,
}

impl Class {
    pub fn name(self) -> &'static str {
        match self {
            Self::Conductor => "conductor",
            Self::Dielectric => "dielectric",
        }
    }
}

/// A material's index of refraction and what it is.
#[derive(Clone, Debug)]
pub struct Optics {
    /// The material's own name, whichever alias was asked for, or that of the data set.
    pub name: String,
    pub class: Class,
    pub ior: Arc<Ior>,
}

/// A k above this somewhere in the visible makes a data set that no material names a conductor's: a millimetre of it is black.
const OPAQUE_K: f64 = 1e-3;

/// A material of the library by name or alias, or a data set of it by its own name.
///
/// `data` is a data set in place of the material's.
pub fn optics(name: &str, data: Option<&str>, library: &Library) -> Result<Optics, SceneError> {
    let found = match library.material(name) {
        Ok(found) => found,
        Err(unknown) if data.is_none() => return data_set(name, library).map_err(|error| nearer(unknown, error)),
        Err(unknown) => return Err(SceneError::new(unknown)),
    };
    let text = Text::new(found.origin, found.text);
    let material: Material = text.parse()?;
    let (class, source) = match material.kind() {
        Ok(Kind::Conductor(conductor)) => (Class::Conductor, &conductor.ior),
        Ok(Kind::Dielectric(dielectric)) => (Class::Dielectric, &dielectric.ior),
        _ => {
            let message = format!("`{name}` has no index of refraction: it is neither a conductor nor a dielectric");
            return Err(SceneError::new(message));
        }
    };
    let ior = match data {
        Some(data) => library.ior(data, Path::new("")).map_err(SceneError::new)?,
        None => index(source, &found.name, &text, library)?,
    };
    Ok(Optics { name: found.name, class, ior })
}

fn index(source: &Spanned<IndexSource>, name: &str, text: &Text, library: &Library) -> Result<Arc<Ior>, SceneError> {
    match source.get_ref() {
        IndexSource::Name(data) => library.ior(data, text.base()).map_err(|error| text.error(&source.span(), error)),
        &IndexSource::Constant { n, k } => Ok(Arc::new(Ior::constant(name, n, k))),
        IndexSource::Own(own) => own.ior(name).map(Arc::new).map_err(|error| text.error(&source.span(), error)),
    }
}

fn data_set(name: &str, library: &Library) -> Result<Optics, SpectrumError> {
    let ior = library.ior(name, Path::new(""))?;
    Ok(Optics { name: ior.about.name.clone(), class: class_of(&ior), ior })
}

/// What data of which no material is known are taken for.
pub fn class_of(ior: &Ior) -> Class {
    let mut visible = (LAMBDA_MIN_NM as u32..=LAMBDA_MAX_NM as u32).map(f64::from);
    if visible.any(|nm| ior.k.at(nm) > OPAQUE_K) { Class::Conductor } else { Class::Dielectric }
}

/// Of two ways to miss a name, the one that knows what was meant; a file that cannot be read is told in any case.
fn nearer(unknown: SpectrumError, data: SpectrumError) -> SceneError {
    match (&unknown, &data) {
        (
            SpectrumError::UnknownMaterial { suggestion: None, .. },
            SpectrumError::UnknownData { suggestion: Some(_), .. },
        ) => SceneError::new(data),
        (_, SpectrumError::UnknownData { .. }) => SceneError::new(unknown),
        _ => SceneError::new(data),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str) -> Result<Optics, SceneError> {
        optics(name, None, &Library::default())
    }

    #[test]
    fn materials_aliases_and_data_sets_are_found() {
        let gold = of("gold").unwrap();
        assert_eq!((gold.name.as_str(), gold.class), ("gold", Class::Conductor));
        assert_eq!(of("Au").unwrap().ior.about.name, gold.ior.about.name);
        assert_eq!(of("diamond").unwrap().class, Class::Dielectric);
        let other = of("Au/johnson-christy-1972").unwrap();
        assert_eq!((other.name.as_str(), other.class), ("Au/johnson-christy-1972", Class::Conductor));
        assert_ne!(other.ior, gold.ior);
        let replaced = optics("gold", Some("Au/johnson-christy-1972"), &Library::default()).unwrap();
        assert_eq!((replaced.name.as_str(), &replaced.ior), ("gold", &other.ior));
    }

    #[test]
    fn what_is_not_there_is_told_with_what_is_near() {
        assert!(of("gould").unwrap_err().to_string().contains("did you mean `gold`"));
        let data = of("Au/jonson-christy-1972").unwrap_err().to_string();
        assert!(data.contains("Au/johnson-christy-1972"), "{data}");
        assert!(optics("gold", Some("Au/jonson"), &Library::default()).is_err());
    }
}
