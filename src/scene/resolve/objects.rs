//! Objects: each a shape of a material, some of them lights.

use super::Resolver;
use crate::geometry::{Shape, ShapeId, World};
use crate::light::{Emitter, Source};
use crate::scene::describe;
use crate::scene::{Inside, Object, SceneError, Surface};
use toml::Spanned;

/// All objects of a scene, in the order of the file.
#[derive(Default)]
pub struct Objects {
    pub objects: Vec<Object>,
    pub shapes: Vec<Shape>,
    pub emitters: Vec<Emitter>,
}

impl Resolver<'_> {
    pub fn objects(&mut self, described: &[Spanned<describe::Object>]) -> Result<Objects, SceneError> {
        let mut all = Objects::default();
        for (index, described) in described.iter().enumerate() {
            let object = described.get_ref();
            let name = object.name.clone().unwrap_or_else(|| format!("object {}", index + 1));
            let shape = self.shape(object)?;
            let surface = self.surface_of(described, &name)?;
            if let Surface::Dielectric(_) = self.surfaces[surface as usize] {
                self.check_dielectric(object, &shape, &name)?;
            }
            self.check_coordinates(object, surface, &shape, &name)?;
            if let Some(emission) = &object.emission {
                all.emitters.push(self.emitter(emission.get_ref(), &name, ShapeId(index as u32), &shape)?);
            }
            let material = object.material.as_ref().map_or("light", |material| material.get_ref()).to_owned();
            all.objects.push(Object { name, material, surface, inside: Inside::General });
            all.shapes.push(shape);
        }
        Ok(all)
    }

    fn surface_of(&mut self, described: &Spanned<describe::Object>, name: &str) -> Result<u32, SceneError> {
        let object = described.get_ref();
        match &object.material {
            Some(material) => self.material(material),
            None if object.emission.is_some() => Ok(self.black()),
            None => {
                let message = format!("{name} has neither a material nor an emission");
                let error = self.text.error(&described.span(), message);
                Err(error.help("add `material = \"…\"`: `spectrel list materials` shows them"))
            }
        }
    }

    fn emitter(
        &mut self,
        emission: &describe::Emission,
        name: &str,
        id: ShapeId,
        shape: &Shape,
    ) -> Result<Emitter, SceneError> {
        let light = self.emission(emission, name)?;
        let two_sided = emission.two_sided;
        if two_sided && shape.is_solid() {
            let message = format!("{name} is a solid: it shines from its outside, `two_sided` is for flat shapes");
            return Err(self.text.error(&emission.spectrum.span(), message));
        }
        let power = light.luminance * f64::from(shape.area()) * if two_sided { 2.0 } else { 1.0 };
        self.white_candidates.push((power, light.id));
        Ok(Emitter { source: Source::Shape { id, two_sided }, radiance: light.id, power })
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

    /// Pictures lie on a shape by its texture coordinates.
    fn check_coordinates(
        &self,
        object: &describe::Object,
        surface: u32,
        shape: &Shape,
        name: &str,
    ) -> Result<(), SceneError> {
        match self.patterns.get(&surface) {
            Some(pattern) if !shape.has_uv() => {
                let files = pattern.files.join("` and `");
                let message = format!("{name} has no texture coordinates, by which `{files}` could lie on it");
                let error = self.text.error(&object.shape.span(), message);
                Err(error.help("spheres, rectangles and disks have them, and meshes whose file brings them"))
            }
            _ => Ok(()),
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

    /// Finds the convex dielectrics that nothing else reaches into: their insides are traced without asking the scene.
    pub fn find_stones(&self, world: &World, objects: &mut [Object]) {
        for (object, id) in objects.iter_mut().zip((0..).map(ShapeId)) {
            let surface = &self.surfaces[object.surface as usize];
            let refracts = matches!(surface, Surface::Dielectric(interface) if !interface.is_rough());
            let faceted = matches!(world.shape(id), Some(Shape::Convex(_)));
            if refracts && faceted && world.stands_alone(id) {
                object.inside = Inside::Alone;
            }
        }
    }
}
