//! From what the files say to a scene that renders without failing: names looked up, units converted, every check made.

mod emission;
mod materials;
mod shapes;

use super::describe::{self, ExposureValue, ObserverName, SceneFile};
use super::{DataSet, Inside, Interface, Medium, Object, Picture, Scene, SceneError, Settings, Surface, Text};
use crate::camera::{Camera, Filter, Lens};
use crate::fresnel::FresnelModel;
use crate::geometry::{Shape, ShapeId, World};
use crate::light::{Emitter, Environment, Lights};
use crate::spectrum::{
    About, Arena, ColorMatching, LAMBDA_MAX_NM, LAMBDA_MIN_NM, Library, Observer, Spectrum, SpectrumId, white_xyz,
};
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use toml::Spanned;

/// What a command line says over a scene file.
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    pub width: Option<u32>,
    pub height: Option<u32>,
    pub crop: Option<[u32; 4]>,
    pub samples: Option<u32>,
    pub seed: Option<u64>,
    pub fresnel: Option<FresnelModel>,
    pub lanes: Option<u32>,
}

/// A picture's size unless the scene or the command line says otherwise.
const SIZE: [u32; 2] = [960, 640];
const SAMPLES: u32 = 128;

/// A data set whose range leaves out more than this share of what the observer sees is warned of.
const UNCOVERED: f64 = 1e-3;

/// Reads a scene's text and resolves it.
pub fn resolve(text: Text, library: &Library, overrides: &Overrides) -> Result<Scene, SceneError> {
    let mut file: SceneFile = text.parse()?;
    let own_materials = std::mem::take(&mut file.materials);
    let observer_1931 = library.observer(Observer::Cie1931)?;
    let resolver = Resolver {
        text: &text,
        library,
        meters_per_unit: None,
        fresnel: overrides.fresnel.or(file.render.fresnel),
        own_names: own_materials.keys().cloned().collect(),
        own_materials,
        observer_1931,
        spectra: Arena::default(),
        surfaces: Vec::new(),
        media: Vec::new(),
        by_name: BTreeMap::new(),
        white_candidates: Vec::new(),
        data: Vec::new(),
        warnings: Vec::new(),
        sources: Vec::new(),
    };
    resolver.scene(&file, overrides)
}

/// What is gathered while a scene is resolved.
struct Resolver<'a> {
    text: &'a Text,
    library: &'a Library,
    meters_per_unit: Option<f64>,
    fresnel: Option<FresnelModel>,
    own_names: BTreeSet<String>,
    own_materials: BTreeMap<String, Spanned<describe::Material>>,
    observer_1931: Arc<ColorMatching>,
    spectra: Arena,
    surfaces: Vec<Surface>,
    media: Vec<Medium>,
    by_name: BTreeMap<String, u32>,
    /// Lights by how much they matter for what is white.
    white_candidates: Vec<(f64, SpectrumId)>,
    data: Vec<DataSet>,
    warnings: Vec<String>,
    sources: Vec<Text>,
}

impl Resolver<'_> {
    fn scene(mut self, file: &SceneFile, overrides: &Overrides) -> Result<Scene, SceneError> {
        let settings = self.settings(&file.render, overrides)?;
        self.meters_per_unit =
            file.meters_per_unit.as_ref().map(|m| self.positive(m, "`meters_per_unit`")).transpose()?;
        let vacuum = self.spectra.add(Spectrum::Constant(1.0));
        self.media.push(Medium { name: "vacuum".into(), n: vacuum, absorption: None, dispersive: false });
        file.outside.as_ref().map(|name| self.outside(name)).transpose()?;
        let (objects, shapes, emitters) = self.objects(&file.objects)?;
        let environment = match &file.environment {
            Some(environment) => self.environment(environment.get_ref())?,
            None => Environment::Dark,
        };
        let world = World::new(shapes).map_err(|error| self.text.whole(error))?;
        let camera = self.camera(&file.camera, &settings, &world, &objects)?;
        let picture = self.picture(&file.picture)?;
        self.trace_alone_where_possible(&world, &objects);
        let lights = Lights::new(emitters, environment, objects.len());
        if lights.is_dark() {
            self.warnings.push("nothing in this scene shines: the picture will be black".into());
        }
        self.warn_of_unused_materials();
        self.sources.insert(0, self.text.clone());
        let filter = match settings.filter {
            describe::FilterName::Box => Filter::Box,
            describe::FilterName::BlackmanHarris => Filter::blackman_harris(),
        };
        Ok(Scene {
            spectra: self.spectra,
            world,
            objects,
            surfaces: self.surfaces,
            media: self.media,
            lights,
            camera,
            filter,
            settings,
            picture,
            data: self.data,
            warnings: self.warnings,
            sources: self.sources,
        })
    }

    fn settings(&self, render: &describe::Render, overrides: &Overrides) -> Result<Settings, SceneError> {
        let count = |over: Option<u32>, own: &Option<Spanned<u32>>, usual: u32, name: &str| match (over, own) {
            (Some(0), _) => Err(SceneError::new(format!("--{name} is 0: it must be at least 1"))),
            (Some(value), _) => Ok(value),
            (None, Some(own)) if *own.get_ref() == 0 => {
                Err(self.text.error(&own.span(), format!("`{name}` is 0: it must be at least 1")))
            }
            (None, own) => Ok(own.as_ref().map_or(usual, |own| *own.get_ref())),
        };
        let own_width = count(None, &render.width, SIZE[0], "width")?;
        let own_height = count(None, &render.height, SIZE[1], "height")?;
        let along = |given: u32, mine: u32, other: u32| {
            (f64::from(given) * f64::from(other) / f64::from(mine)).round().clamp(1.0, f64::from(u32::MAX)) as u32
        };
        // One side given: the other follows the scene's proportions.
        let [width, height] = match (overrides.width, overrides.height) {
            (None, None) => [own_width, own_height],
            (Some(width), None) => [count(Some(width), &None, 0, "width")?, along(width, own_width, own_height)],
            (None, Some(height)) => [along(height, own_height, own_width), count(Some(height), &None, 0, "height")?],
            (Some(width), Some(height)) => {
                [count(Some(width), &None, 0, "width")?, count(Some(height), &None, 0, "height")?]
            }
        };
        let crop = overrides.crop.unwrap_or([0, 0, width, height]);
        let [x0, y0, x1, y1] = crop;
        if !(x0 < x1 && x1 <= width && y0 < y1 && y1 <= height) {
            let message = format!("--crop {x0},{y0},{x1},{y1} is no part of a picture of {width} × {height} pixels");
            return Err(
                SceneError::new(message).help("give x0,y0,x1,y1 with x0 < x1 and y0 < y1, the upper ends excluded")
            );
        }
        let max_depth =
            render.max_depth.as_ref().map(|_| count(None, &render.max_depth, 1, "max_depth")).transpose()?;
        Ok(Settings {
            width,
            height,
            crop,
            samples: count(overrides.samples, &render.samples, SAMPLES, "samples")?,
            seed: overrides.seed.or(render.seed).unwrap_or(0),
            max_depth,
            sampler: render.sampler,
            filter: render.filter,
            fresnel: overrides.fresnel.or(render.fresnel),
            lanes: overrides.lanes.unwrap_or(crate::spectrum::LANES as u32),
        })
    }

    fn objects(
        &mut self,
        described: &[Spanned<describe::Object>],
    ) -> Result<(Vec<Object>, Vec<Shape>, Vec<Emitter>), SceneError> {
        let (mut objects, mut shapes, mut emitters) = (Vec::new(), Vec::new(), Vec::new());
        for (index, described) in described.iter().enumerate() {
            let (span, object) = (described.span(), described.get_ref());
            let name = object.name.clone().unwrap_or_else(|| format!("object {}", index + 1));
            let shape = self.shape(object)?;
            let surface = match &object.material {
                Some(material) => self.material(material)?,
                None if object.emission.is_some() => self.black(),
                None => {
                    let message = format!("{name} has neither a material nor an emission");
                    return Err(self
                        .text
                        .error(&span, message)
                        .help("add `material = \"…\"`: `spectrel list materials` shows them"));
                }
            };
            if let Surface::Dielectric(_) = self.surfaces[surface as usize] {
                self.check_dielectric(object, &shape, &name)?;
            }
            if let Some(emission) = &object.emission {
                let light = self.emission(emission.get_ref(), &name)?;
                let two_sided = emission.get_ref().two_sided && !shape.is_solid();
                let power = light.luminance * f64::from(shape.area()) * if two_sided { 2.0 } else { 1.0 };
                self.white_candidates.push((power, light.id));
                emitters.push(Emitter { shape: ShapeId(index as u32), radiance: light.id, two_sided, power });
            }
            let material = object.material.as_ref().map_or("light", |material| material.get_ref()).to_owned();
            objects.push(Object { name, material, surface });
            shapes.push(shape);
        }
        Ok((objects, shapes, emitters))
    }

    fn check_dielectric(&self, object: &describe::Object, shape: &Shape, name: &str) -> Result<(), SceneError> {
        if !shape.is_solid() {
            let message = format!("{name} is flat, but a dielectric needs an inside");
            return Err(self.text.error(&object.shape.span(), message).help("use a thin `box` instead"));
        }
        match &object.emission {
            Some(emission) => {
                Err(self.text.error(&emission.span(), format!("{name} is a dielectric: it cannot shine")))
            }
            None => Ok(()),
        }
    }

    /// The surface of what only shines.
    fn black(&mut self) -> u32 {
        let known = self.surfaces.iter().position(|surface| *surface == Surface::Black);
        known.unwrap_or_else(|| {
            self.surfaces.push(Surface::Black);
            self.surfaces.len() - 1
        }) as u32
    }

    fn camera(
        &self,
        described: &Spanned<describe::Camera>,
        settings: &Settings,
        world: &World,
        objects: &[Object],
    ) -> Result<Camera, SceneError> {
        let (span, camera) = (described.span(), described.get_ref());
        let lens = match (&camera.fov, &camera.focal_length_mm) {
            (Some(fov), None) => Lens::FieldOfView(*fov.get_ref()),
            (None, Some(focal)) => {
                Lens::FocalLength { focal_length_mm: *focal.get_ref(), sensor_width_mm: camera.sensor_width_mm }
            }
            (None, None) => return Err(self.text.error(&span, "the camera needs `fov` or `focal_length_mm`")),
            (Some(_), Some(focal)) => {
                return Err(self
                    .text
                    .error(&focal.span(), "`fov` and `focal_length_mm` both say how wide the camera sees"));
            }
        };
        let vector = |v: [f64; 3]| DVec3::from_array(v).as_vec3();
        let [position, look_at] = [&camera.position, &camera.look_at].map(|v| vector(*v.get_ref()));
        for (name, given) in [("position", &camera.position), ("look_at", &camera.look_at)] {
            if !vector(*given.get_ref()).is_finite() {
                return Err(self.text.error(&given.span(), format!("the camera's `{name}` is not finite")));
            }
        }
        if let Some(inside) = world.shapes().iter().position(|shape| shape.contains(position)) {
            let message = format!("the camera stands inside `{}`, which is solid", objects[inside].name);
            return Err(self.text.error(&camera.position.span(), message).help("move it out of the object"));
        }
        let place = camera.fov.as_ref().or(camera.focal_length_mm.as_ref()).map_or(span, Spanned::span);
        Camera::new(position, look_at, vector(camera.up), lens, [settings.width, settings.height])
            .map_err(|error| self.text.error(&place, error))
    }

    fn picture(&mut self, picture: &describe::Picture) -> Result<Picture, SceneError> {
        let observer = self.library.observer(observer(picture.observer))?;
        let white_balance = picture.white_balance.as_ref().map_or("D65", |name| name.get_ref()).to_owned();
        let span = picture.white_balance.as_ref().map_or(0..0, Spanned::span);
        let white = if white_balance == "scene" {
            let strongest = self.white_candidates.iter().max_by(|a, b| a.0.total_cmp(&b.0));
            strongest.map_or(Spectrum::Constant(1.0), |&(_, id)| self.spectra.get(id).clone())
        } else {
            let found = self
                .library
                .illuminant(&white_balance, self.text.base())
                .map_err(|error| self.text.error(&span, error))?;
            found.spectrum.clone()
        };
        let white = white_xyz(&white, &observer).map_err(|error| self.text.error(&span, error))?;
        let exposure = match picture.exposure.as_ref().map(|exposure| (*exposure.get_ref(), exposure.span())) {
            None => ExposureValue::Auto,
            Some((ExposureValue::Ev(ev), span)) if !(-100.0..=100.0).contains(&ev) => {
                return Err(self.text.error(&span, format!("an exposure of {ev} EV: it lies between −100 and 100")));
            }
            Some((exposure, _)) => exposure,
        };
        Ok(Picture { exposure, white_balance, white, gamut: picture.gamut, observer })
    }

    /// Marks the convex dielectrics that nothing else reaches into: their insides are traced without asking the scene.
    fn trace_alone_where_possible(&mut self, world: &World, objects: &[Object]) {
        let shapes = world.shapes();
        let reached = |solid: usize| {
            shapes.iter().enumerate().any(|(other, shape)| other != solid && shapes[solid].may_touch_inside(shape))
        };
        for (index, surface) in self.surfaces.iter_mut().enumerate() {
            let Surface::Dielectric(Interface { inside, .. }) = surface else { continue };
            let mut users = (0..shapes.len()).filter(|&shape| objects[shape].surface as usize == index);
            let alone = users.all(|shape| matches!(shapes[shape], Shape::Convex(_)) && !reached(shape));
            *inside = if alone { Inside::Alone } else { Inside::General };
        }
    }

    fn warn_of_unused_materials(&mut self) {
        let unused: Vec<_> = self.own_materials.keys().map(|name| format!("`{name}`")).collect();
        if !unused.is_empty() {
            self.warnings.push(format!("no object uses the material{} {}", plural(unused.len()), unused.join(", ")));
        }
    }

    /// Remembers where a value comes from, and warns where its data do not reach.
    fn note_data(&mut self, used_by: &str, about: &About) {
        if self.data.iter().any(|data| data.used_by == used_by && data.about.name == about.name) {
            return;
        }
        let missing = about.range_nm.map_or(0.0, |range| share_outside(&self.observer_1931, range));
        if let (true, Some((first, last))) = (missing > UNCOVERED, about.range_nm) {
            self.warnings.push(format!(
                "`{}` ({used_by}) covers {first}–{last} nm: {:.1} % of what the eye sees lies outside, where its ends are held or its formula is extrapolated",
                about.name,
                missing * 100.0
            ));
        }
        self.data.push(DataSet { used_by: used_by.to_owned(), about: about.clone() });
    }

    fn positive(&self, number: &Spanned<f64>, what: &str) -> Result<f64, SceneError> {
        let value = *number.get_ref();
        if value > 0.0 && value.is_finite() {
            return Ok(value);
        }
        Err(self.text.error(&number.span(), format!("{what} is {value}: it must be finite and above 0")))
    }

    fn not_negative(&self, number: &Spanned<f64>, name: &str) -> Result<f64, SceneError> {
        let value = *number.get_ref();
        if value >= 0.0 && value.is_finite() {
            return Ok(value);
        }
        Err(self.text.error(&number.span(), format!("`{name}` is {value}: it must be finite and not negative")))
    }
}

fn observer(name: ObserverName) -> Observer {
    match name {
        ObserverName::Cie1931 => Observer::Cie1931,
        ObserverName::Cie1964 => Observer::Cie1964,
        ObserverName::Cie2015 => Observer::Cie2015,
    }
}

/// How much of what an observer sees lies outside a range of wavelengths, 0…1.
fn share_outside(observer: &ColorMatching, (first, last): (f64, f64)) -> f64 {
    let seen = |nm: &f64| observer.at(*nm).iter().sum::<f64>();
    let all = || (LAMBDA_MIN_NM as u32..=LAMBDA_MAX_NM as u32).map(f64::from);
    let outside: f64 = all().filter(|nm| !(first..=last).contains(nm)).map(|nm| seen(&nm)).sum();
    outside / all().map(|nm| seen(&nm)).sum::<f64>()
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}
