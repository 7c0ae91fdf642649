//! From what the files say to a scene that renders without failing: names looked up, units converted, every check made.

mod around;
mod bodies;
mod camera;
mod colors;
mod covers;
mod emission;
mod materials;
mod meshes;
mod objects;
mod patterns;
mod picture;
mod place;
mod points;
mod provenance;
mod settings;
mod shapes;
mod solids;
mod substitutes;
mod surroundings;
mod trade;
mod view;

pub(super) use emission::BRIGHTEST;
pub use settings::Overrides;

use super::describe::SceneFile;
use super::materials::Material;
use super::oversights::{self, Measures};
use super::{DataSet, Medium, Pattern, Scene, SceneError, Surface, Text};
use crate::fresnel::FresnelModel;
use crate::geometry::{Bounds, World};
use crate::light::{Environment, Lights};
use crate::spectrum::{Arena, ColorMatching, Library, Observer, Spectrum, SpectrumId};
use bodies::Bodies;
use glam::{DVec3, Vec3};
use meshes::Meshes;
use objects::Objects;
use place::Rounded;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;
use substitutes::Substitutes;
use toml::Spanned;

/// Reads a scene's text and resolves it.
pub fn resolve(text: Text, library: &Library, overrides: &Overrides) -> Result<Scene, SceneError> {
    let mut file: SceneFile = text.parse()?;
    let own_materials = std::mem::take(&mut file.materials);
    let own_materials = own_materials.into_iter().map(|(name, material)| {
        let span = material.span();
        (name, (Arc::new(material.into_inner()), span))
    });
    let observer_1931 = library.observer(Observer::Cie1931)?;
    let resolver = Resolver {
        text: &text,
        library,
        meters_per_unit: None,
        fresnel: overrides.fresnel.or(file.render.fresnel),
        without_dispersion: overrides.without_dispersion,
        own_materials: own_materials.collect(),
        substitutes: Substitutes::new(overrides)?,
        used_materials: BTreeSet::new(),
        outside_name: None,
        origin: place::origin(file.camera.get_ref()),
        rounded: Vec::new(),
        observer_1931,
        spectra: Arena::default(),
        surfaces: Vec::new(),
        patterns: BTreeMap::new(),
        media: Vec::new(),
        by_name: BTreeMap::new(),
        white_candidates: Vec::new(),
        data: Vec::new(),
        noted: BTreeSet::new(),
        warnings: Vec::new(),
        sources: Vec::new(),
        meshes: BTreeMap::new(),
        bodies: BTreeMap::new(),
        files: BTreeSet::new(),
    };
    resolver.scene(&file, overrides)
}

/// What is gathered while a scene is resolved.
struct Resolver<'a> {
    text: &'a Text,
    library: &'a Library,
    meters_per_unit: Option<f64>,
    fresnel: Option<FresnelModel>,
    without_dispersion: bool,
    own_materials: BTreeMap<String, (Arc<Material>, Range<usize>)>,
    substitutes: Substitutes,
    used_materials: BTreeSet<String>,
    /// The material that is around everything.
    outside_name: Option<String>,
    /// What all places are measured from.
    origin: DVec3,
    rounded: Vec<Rounded>,
    observer_1931: Arc<ColorMatching>,
    spectra: Arena,
    surfaces: Vec<Surface>,
    patterns: BTreeMap<u32, Pattern>,
    media: Vec<Medium>,
    by_name: BTreeMap<String, u32>,
    /// Lights by how much they matter for what is white.
    white_candidates: Vec<(f64, SpectrumId)>,
    data: Vec<DataSet>,
    /// Users and names of `data`.
    noted: BTreeSet<(String, String)>,
    warnings: Vec<String>,
    sources: Vec<Text>,
    meshes: Meshes,
    bodies: Bodies,
    /// Meshes and pictures that were read.
    files: BTreeSet<PathBuf>,
}

impl Resolver<'_> {
    fn scene(mut self, file: &SceneFile, overrides: &Overrides) -> Result<Scene, SceneError> {
        let settings = self.settings(&file.render, overrides)?;
        self.meters_per_unit =
            file.meters_per_unit.as_ref().map(|m| self.positive(m, "`meters_per_unit`")).transpose()?;
        let vacuum = self.spectra.add(Spectrum::Constant(1.0));
        self.media.push(Medium { name: "vacuum".into(), n: vacuum, absorption: None, k: None, dispersive: false });
        file.outside.as_ref().map(|name| self.outside(name)).transpose()?;
        let Objects { mut objects, shapes, mut emitters } = self.objects(&file.objects, &file.replace)?;
        self.check_substitutes()?;
        let world = World::new(shapes).map_err(|error| self.text.whole(error))?;
        let environment = match &file.environment {
            Some(environment) => self.environment(environment.get_ref(), &world.bounds(), &mut emitters)?,
            None => Environment::Dark,
        };
        for point in &file.points {
            emitters.push(self.point(point.get_ref())?);
        }
        for sun in &file.suns {
            emitters.push(self.sun(sun.get_ref(), half_diagonal(&world.bounds()))?);
        }
        let covers = self.covers(&world, &mut objects);
        self.solids(&world, &mut objects);
        let view = self.view(&file.camera)?;
        let camera = self.camera(&file.camera, &view, [settings.width, settings.height])?;
        let filter = settings::filter(settings.filter);
        let origins = camera.origins([settings.width, settings.height], filter.overhang());
        let around_camera = self.around_camera(&view, origins, &world, &objects)?;
        let picture = self.picture(&file.picture)?;
        let lights = Lights::new(emitters, environment, &world);
        self.warn_of_lost_light(!file.points.is_empty(), file.environment.is_some() || !file.suns.is_empty());
        self.warn_of_darkness();
        self.warn_of_rounding();
        self.warn_of_unused_materials();
        self.sources.insert(0, self.text.clone());
        let rgb = self.rgb_colors()?;
        let measures = Measures { meters_per_unit: self.meters_per_unit, origin: self.origin, look_at: view.look_at };
        let mut scene = Scene {
            spectra: self.spectra,
            world,
            origin: self.origin,
            meters_per_unit: self.meters_per_unit,
            objects,
            covers,
            surfaces: self.surfaces,
            patterns: self.patterns,
            media: self.media,
            lights,
            camera,
            around_camera,
            filter,
            settings,
            picture,
            data: self.data,
            warnings: self.warnings,
            sources: self.sources,
            files: self.files.into_iter().collect(),
            rgb,
        };
        let oversights = oversights::of(&scene, &measures);
        scene.warnings.extend(oversights);
        Ok(scene)
    }

    fn positive(&self, number: &Spanned<f64>, what: &str) -> Result<f64, SceneError> {
        let value = *number.get_ref();
        if value > 0.0 && value.is_finite() {
            return Ok(value);
        }
        Err(self.text.error(&number.span(), format!("{what} is {value}: it must be finite and above 0")))
    }

    fn finite(&self, number: &Spanned<f64>, name: &str) -> Result<f64, SceneError> {
        let value = *number.get_ref();
        if value.is_finite() {
            return Ok(value);
        }
        Err(self.text.error(&number.span(), format!("`{name}` is {value}: it must be finite")))
    }

    fn not_negative(&self, number: &Spanned<f64>, name: &str) -> Result<f64, SceneError> {
        let value = *number.get_ref();
        if value >= 0.0 && value.is_finite() {
            return Ok(value);
        }
        Err(self.text.error(&number.span(), format!("`{name}` is {value}: it must be finite and not negative")))
    }
}

/// The surface of the box around all shapes, through which the environment lights them.
pub(super) fn surface(bounds: &Bounds) -> f64 {
    let [x, y, z] = if bounds.is_empty() { [1.0; 3] } else { bounds.size().to_array().map(f64::from) };
    2.0 * (x * y + y * z + z * x)
}

/// Half of the way from corner to corner: the radius of the ball around all shapes.
fn half_diagonal(bounds: &Bounds) -> f64 {
    f64::from(bounds.size().length()) / 2.0
}

fn vector(values: [f64; 3]) -> Vec3 {
    DVec3::from_array(values).as_vec3()
}
