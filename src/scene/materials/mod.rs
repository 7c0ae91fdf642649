//! The kinds of material: one file each, with what a file says of one and what becomes of its surface.
//!
//! A new kind is a file here, its line in [`Material`] and [`Kind`], and its line in [`Surface`].

mod conductor;
mod dielectric;
mod diffuse;

pub use conductor::{Conductor, Metal};
pub use dielectric::{AbsorptionSource, Dielectric, Interface};
pub use diffuse::{Diffuse, Matt, ReflectanceSource};

use super::own_index::OwnIndex;
use super::pictures::ImageTexture;
use crate::fresnel::FresnelModel;
use crate::spectrum::Quantity;
use serde::Deserialize;
use toml::Spanned;

/// A material: a file of `materials/` or an entry of a scene's `[materials]`. It is of exactly one kind.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// For people.
    pub description: Option<String>,
    /// Other names; the library looks materials up by them.
    #[serde(default)]
    pub aliases: Vec<String>,
    pub conductor: Option<Spanned<Conductor>>,
    pub dielectric: Option<Spanned<Dielectric>>,
    pub diffuse: Option<Spanned<Diffuse>>,
}

/// A data set's name or file, or plain numbers.
#[derive(Debug)]
pub enum IndexSource {
    Name(String),
    Constant { n: f64, k: f64 },
    Own(Box<OwnIndex>),
}

/// One value for the whole surface, or a picture of values.
#[derive(Debug)]
pub enum RoughnessSource {
    Constant(f64),
    Image(ImageTexture),
}

/// The kind of a material.
#[derive(Clone, Copy, Debug)]
pub enum Kind<'a> {
    Conductor(&'a Conductor),
    Dielectric(&'a Dielectric),
    Diffuse(&'a Diffuse),
}

/// What is wrong with the kind of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum KindError {
    #[error("of no kind")]
    None,
    #[error("of more than one kind")]
    Several,
}

impl Material {
    /// Returns what kind of material it is, which is exactly one.
    pub fn kind(&self) -> Result<Kind<'_>, KindError> {
        let Self { conductor, dielectric, diffuse, description: _, aliases: _ } = self;
        let kinds = [
            conductor.as_ref().map(|kind| Kind::Conductor(kind.get_ref())),
            dielectric.as_ref().map(|kind| Kind::Dielectric(kind.get_ref())),
            diffuse.as_ref().map(|kind| Kind::Diffuse(kind.get_ref())),
        ];
        let mut given = kinds.into_iter().flatten();
        match (given.next(), given.next()) {
            (None, _) => Err(KindError::None),
            (Some(kind), None) => Ok(kind),
            (Some(_), Some(_)) => Err(KindError::Several),
        }
    }

    /// Returns where its index of refraction comes from, if it has one.
    pub fn index(&self) -> Option<&Spanned<IndexSource>> {
        match self.kind().ok()? {
            Kind::Conductor(conductor) => Some(&conductor.ior),
            Kind::Dielectric(dielectric) => Some(&dielectric.ior),
            Kind::Diffuse(_) => None,
        }
    }

    /// Returns the data set that it is made of, if that has a name.
    pub fn data(&self) -> Option<(Quantity, &str)> {
        match self.kind().ok()? {
            Kind::Conductor(Conductor { ior, .. }) | Kind::Dielectric(Dielectric { ior, .. }) => match ior.get_ref() {
                IndexSource::Name(name) => Some((Quantity::Ior, name)),
                IndexSource::Constant { .. } | IndexSource::Own(_) => None,
            },
            Kind::Diffuse(Diffuse { reflectance }) => match reflectance.get_ref() {
                ReflectanceSource::Name(name) => Some((Quantity::Reflectance, name)),
                _ => None,
            },
        }
    }
}

impl Kind<'_> {
    /// Returns the word for it in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Conductor(_) => "conductor",
            Self::Dielectric(_) => "dielectric",
            Self::Diffuse(_) => "diffuse",
        }
    }
}

/// What happens to light at an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// What only shines.
    Black,
    Diffuse(Matt),
    Conductor(Metal),
    Dielectric(Interface),
}

impl Surface {
    /// Returns its Fresnel model, if light is reflected by one.
    pub fn model(&self) -> Option<FresnelModel> {
        match self {
            Self::Black | Self::Diffuse(_) => None,
            Self::Conductor(metal) => Some(metal.model),
            Self::Dielectric(interface) => Some(interface.model),
        }
    }

    /// Returns whether all light leaves it in single directions, as those of a mirror.
    pub fn is_smooth(&self) -> bool {
        match self {
            Self::Black | Self::Diffuse(_) => false,
            Self::Conductor(metal) => metal.is_smooth(),
            Self::Dielectric(interface) => !interface.is_rough(),
        }
    }

    /// Returns whether it sends light of one direction into many.
    pub fn scatters(&self) -> bool {
        *self != Self::Black && !self.is_smooth()
    }

    /// Returns whether its facets make it rough.
    pub fn is_rough(&self) -> bool {
        self.model().is_some() && !self.is_smooth()
    }

    /// Returns the boundary of a clear solid.
    pub fn interface(&self) -> Option<&Interface> {
        if let Self::Dielectric(interface) = self { Some(interface) } else { None }
    }

    /// Returns whether light goes on behind it.
    pub fn is_clear(&self) -> bool {
        self.interface().is_some()
    }

    /// Returns what it is, for people.
    pub fn describe(&self) -> String {
        match self {
            Self::Black => "black".to_owned(),
            Self::Diffuse(matt) => matt.describe(),
            Self::Conductor(metal) => metal.describe(),
            Self::Dielectric(interface) => interface.describe(),
        }
    }
}
