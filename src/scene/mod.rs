//! From files to a scene that can be rendered without failing: describe → resolve → needs.

mod chance;
pub mod describe;
mod error;
mod forms;
mod lamps;
mod lighting;
pub mod materials;
mod needs;
mod numbers;
mod optics;
mod oversights;
mod own_index;
mod physics;
mod pictures;
mod resolve;
mod words;

pub use chance::Chance;
pub use error::{Place, SceneError, Text};
pub use materials::{Interface, Matt, Metal, Surface};
pub use needs::{Decision, Needs, listed};
pub use optics::{Class, Optics, class_of, optics};
pub use physics::Physics;
pub use resolve::{Overrides, resolve};

use crate::camera::{Camera, Filter};
use crate::fresnel::{FresnelModel, Specimen};
use crate::geometry::{Departure, Hit, Ray, ShapeId, World};
use crate::light::Lights;
use crate::spectrum::{About, Arena, ColorMatching, Colorimeter, SpectrumId, Tint};
use crate::texture::Texels;
use glam::DVec3;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// A scene with every name looked up, every unit converted and every check made.
#[derive(Debug)]
pub struct Scene {
    pub spectra: Arena,
    pub world: World,
    /// Where the scene's file has the zero of the world's coordinates.
    pub origin: DVec3,
    /// Length of one unit, if the scene says it.
    pub meters_per_unit: Option<f64>,
    /// By [`ShapeId`].
    pub objects: Vec<Object>,
    /// Of each clear solid on whose faces opaque objects lie, which ones, in their order.
    pub covers: BTreeMap<ShapeId, Vec<ShapeId>>,
    pub surfaces: Vec<Surface>,
    /// What changes from place to place on a surface, by the surface's index.
    pub patterns: BTreeMap<u32, Pattern>,
    /// The first one is the medium around everything.
    pub media: Vec<Medium>,
    pub lights: Lights,
    pub camera: Camera,
    pub around_camera: Around,
    pub filter: Filter,
    pub settings: Settings,
    pub picture: Picture,
    pub data: Vec<DataSet>,
    pub warnings: Vec<String>,
    /// The scene's own text and the materials that it names.
    pub sources: Vec<Text>,
    /// Meshes and pictures that it reads.
    pub files: Vec<PathBuf>,
    /// For scenes in which a surface has an RGB model.
    pub rgb: Option<RgbColors>,
}

/// What RGB models of reflectance see with, and what they are seen by.
#[derive(Clone, Debug)]
pub struct RgbColors {
    /// Linear sRGB under D65.
    pub meter: Colorimeter,
    /// Reflectances whose colours are its primaries.
    pub primaries: [SpectrumId; 3],
}

#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    pub name: String,
    pub material: String,
    /// Index into [`Scene::surfaces`].
    pub surface: u32,
    /// As the scene says it; 0 unless given.
    pub priority: i32,
    /// For dielectrics: where solids overlap, the highest rank fills the space. No two are equal.
    pub rank: u32,
    /// For dielectrics; nothing is inside of other objects.
    pub inside: Inside,
    /// For dielectrics: whether its boundary may coincide with that of another one somewhere.
    pub touches: bool,
    /// Whether it has a part in [`Scene::covers`], on either side.
    pub covers: bool,
}

/// A solid as a path knows it that is inside of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Filling {
    /// [`Object::rank`].
    pub rank: u32,
    pub medium: MediumId,
}

/// The dielectric solids that a camera's rays begin in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Around {
    /// All of them do.
    pub all: Vec<Filling>,
    /// Some may; its origin tells of each.
    pub some: Vec<(ShapeId, Filling)>,
}

/// Pictures on a surface, in place of what [`Surface`] says of it as a whole.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pattern {
    /// 0…1.
    pub reflectance: Option<Texels<Tint>>,
    /// GGX α; the surface's own is the largest.
    pub alpha: Option<Texels<f32>>,
    /// As the scene calls them.
    pub files: Vec<String>,
}

/// How the inside of a dielectric solid is traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inside {
    /// A convex solid with nothing in it: from facet to facet, all wavelengths at once, without asking the scene.
    Alone,
    /// Something may be inside, or it is not made of facets: every ray asks the scene.
    General,
}

/// Index into [`Scene::media`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MediumId(pub u16);

impl MediumId {
    pub const OUTSIDE: Self = Self(0);
}

/// What fills a solid, or the space around all.
#[derive(Clone, Debug, PartialEq)]
pub struct Medium {
    pub name: String,
    pub n: SpectrumId,
    /// Per scene unit, natural base.
    pub absorption: Option<SpectrumId>,
    /// Imaginary part of the index, where it is large enough to change what is reflected.
    pub k: Option<SpectrumId>,
    /// Whether n changes with wavelength.
    pub dispersive: bool,
}

/// How long and how to render.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    pub width: u32,
    pub height: u32,
    /// x0, y0, x1, y1 in pixels, the upper ends excluded.
    pub crop: [u32; 4],
    pub samples: u32,
    pub seed: u64,
    pub max_depth: Option<u32>,
    pub sampler: describe::SamplerName,
    pub filter: describe::FilterName,
    pub fresnel: Option<FresnelModel>,
    /// Wavelengths a path carries: 1, 4 or 8.
    pub lanes: u32,
    /// Materials whose data the command line replaced, and by what.
    pub ior: Vec<(String, String)>,
    /// Materials that the command line replaced, and by what.
    pub vary: Vec<(String, String)>,
}

/// How the film is to be developed.
#[derive(Clone, Debug)]
pub struct Picture {
    pub exposure: describe::ExposureValue,
    /// Name of what is white.
    pub white_balance: String,
    /// XYZ of what is white, Y = 1.
    pub white: [f64; 3],
    pub gamut: describe::GamutName,
    pub observer: Arc<ColorMatching>,
}

/// A data set that the scene uses, and for what.
#[derive(Clone, Debug)]
pub struct DataSet {
    pub used_by: String,
    pub about: About,
}

impl Scene {
    pub fn object(&self, shape: ShapeId) -> &Object {
        &self.objects[shape.0 as usize]
    }

    /// What a ray from elsewhere meets first, as paths have it.
    pub fn closest(&self, ray: &Ray) -> Option<Hit> {
        let hit = self.world.closest(ray, f32::INFINITY)?;
        Some(self.cover(ray, &[], &hit).unwrap_or(hit))
    }

    /// What opaque lies on the boundary where a ray has met it, leaving others behind as in
    /// [`World::closest_beyond`].
    pub fn cover(&self, ray: &Ray, also: &[Departure], hit: &Hit) -> Option<Hit> {
        if !self.object(hit.shape).covers {
            return None;
        }
        self.world.upon(ray, also, hit, self.covers.get(&hit.shape)?)
    }

    pub fn medium(&self, id: MediumId) -> &Medium {
        &self.media[usize::from(id.0)]
    }

    /// A metal of the index [n, k], seen from a medium.
    pub fn metal(&self, index: [SpectrumId; 2], from: MediumId) -> Specimen<'_> {
        let [n2, k2] = index.map(|id| self.spectra.get(id));
        Specimen { n1: self.spectra.get(self.medium(from).n), n2, k2 }
    }

    /// The boundary of two media as a model is fitted to it: seen from the one that does not absorb, else from the rarer one.
    pub fn boundary(&self, a: MediumId, b: MediumId) -> Specimen<'_> {
        let of = |id| self.spectra.get(id);
        let index = |medium: MediumId| of(self.medium(medium).n);
        match [a, b].map(|medium| self.medium(medium).k) {
            [None, Some(k)] => Specimen { n1: index(a), n2: index(b), k2: of(k) },
            [Some(k), None] => Specimen { n1: index(b), n2: index(a), k2: of(k) },
            _ => Specimen::between(index(a), index(b)),
        }
    }
}
