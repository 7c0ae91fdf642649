//! Objects: each a shape of a material, some of them lights.

use super::Resolver;
use super::bodies::Origin;
use super::emission::Resolved;
use super::shapes::affine;
use crate::geometry::{GeometryError, Shape, ShapeId};
use crate::light::{Emitter, Source};
use crate::scene::describe;
use crate::scene::{Inside, Object, SceneError, Surface};
use glam::{Affine3A, DVec3};
use std::collections::{BTreeMap, BTreeSet};
use toml::Spanned;

/// All objects of a scene, in the order of the file.
#[derive(Default)]
pub struct Objects {
    pub objects: Vec<Object>,
    pub shapes: Vec<Shape>,
    pub emitters: Vec<Emitter>,
}

/// A shape that an object consists of, and its material.
#[derive(Clone)]
pub struct Piece {
    pub name: String,
    pub shape: Shape,
    pub material: String,
    /// Index into the scene's surfaces.
    pub surface: u32,
    /// If it is of a mesh file.
    pub origin: Option<Origin>,
}

/// A shape before its material is looked up: the name that a mesh file gives it, if any.
struct Bare {
    name: String,
    shape: Shape,
    material: Option<String>,
    origin: Option<Origin>,
}

type Replace = BTreeMap<Spanned<String>, Spanned<String>>;

impl Resolver<'_> {
    pub fn objects(
        &mut self,
        described: &[Spanned<describe::Object>],
        replace: &Replace,
    ) -> Result<Objects, SceneError> {
        let mut all = Objects::default();
        let mut replaced = BTreeSet::new();
        for (index, described) in described.iter().enumerate() {
            let object = described.get_ref();
            let name = object.name.clone().unwrap_or_else(|| format!("object {}", index + 1));
            // Once for all pieces and copies: each integral over a light's spectrum takes 0.3 ms.
            let emission = object.emission.as_ref();
            let light = emission.map(|emission| self.emission(emission.get_ref(), &name)).transpose()?;
            let mut pieces = Vec::new();
            for bare in self.bare_pieces(object, &name)? {
                let named = bare.material.as_deref().filter(|_| object.material.is_none());
                let replacement = named.and_then(|named| replace.get_key_value(named));
                replaced.extend(replacement.map(|(name, _)| name.get_ref().as_str()));
                let material = object.material.as_ref().or(replacement.map(|(_, material)| material));
                pieces.push(self.piece(described, bare, material)?);
            }
            if let describe::Shape::Mesh(file) = object.shape.get_ref() {
                pieces = self.bodies(object, file, &name, pieces)?;
            }
            for piece in self.standing(object, pieces)? {
                self.object(&mut all, object, piece, light.as_ref())?;
            }
        }
        let unused = replace.keys().filter(|name| !replaced.contains(name.get_ref().as_str()));
        for name in unused {
            self.warnings.push(format!("no mesh of this scene has a material `{}` to replace", name.get_ref()));
        }
        Ok(all)
    }

    /// The shapes of an object where they are made: one, or as many as its file has.
    fn bare_pieces(&mut self, object: &describe::Object, name: &str) -> Result<Vec<Bare>, SceneError> {
        let [of_shape, ..] = self.origins(object);
        let mut pieces = self
            .shape(object, of_shape)?
            .map_or_else(Vec::new, |shape| vec![Bare { name: name.to_owned(), shape, material: None, origin: None }]);
        if let describe::Shape::Mesh(file) = object.shape.get_ref() {
            let found = self.pieces(file, of_shape)?;
            let alone = found.len() == 1;
            let full = |part: String| if alone || part == name { name.to_owned() } else { format!("{name}: {part}") };
            pieces.extend(found.into_iter().map(|piece| Bare {
                name: full(piece.name),
                shape: piece.placed.into(),
                material: piece.material,
                origin: Some(piece.origin),
            }));
        }
        pieces.iter().for_each(|piece| self.note_rounding(&piece.name, &piece.shape));
        Ok(pieces)
    }

    /// The pieces of an object where it stands: as often as its copies say.
    fn standing(&mut self, object: &describe::Object, mut pieces: Vec<Piece>) -> Result<Vec<Piece>, SceneError> {
        let [_, of_transform, of_copies] = self.origins(object);
        if let Some(transform) = &object.transform {
            pieces = pieces
                .iter()
                .map(|piece| self.moved(piece, transform, of_transform, Shape::transformed))
                .collect::<Result<_, _>>()?;
        }
        if object.copies.is_empty() {
            return Ok(pieces);
        }
        let mut copies = Vec::with_capacity(pieces.len() * object.copies.len());
        for (number, place) in (1..).zip(&object.copies) {
            for piece in &pieces {
                let copy = self.moved(piece, place, of_copies, Shape::copied)?;
                copies.push(Piece { name: format!("{} #{number}", piece.name), ..copy });
            }
        }
        Ok(copies)
    }

    /// A piece somewhere else, as seen from an origin.
    fn moved(
        &mut self,
        piece: &Piece,
        transform: &Spanned<describe::Transform>,
        origin: DVec3,
        to: impl Fn(&Shape, &Affine3A) -> Result<Shape, GeometryError>,
    ) -> Result<Piece, SceneError> {
        let affine = affine(transform.get_ref(), origin);
        let shape = to(&piece.shape, &affine).map_err(|error| self.text.error(&transform.span(), error))?;
        self.note_rounding(&piece.name, &shape);
        Ok(Piece { shape, ..piece.clone() })
    }

    /// A shape with its material, as far as both go together.
    fn piece(
        &mut self,
        described: &Spanned<describe::Object>,
        bare: Bare,
        material: Option<&Spanned<String>>,
    ) -> Result<Piece, SceneError> {
        let object = described.get_ref();
        let Bare { name, shape, material: named, origin } = bare;
        // What only shines is black, whatever its file calls it.
        let named = named.filter(|_| object.emission.is_none() && material.is_none());
        let by_file = named.map(|named| Spanned::new(object.shape.span(), named));
        let surface = match &by_file {
            Some(named) => self.material(named).map_err(|error| self.unreplaced(error, named))?,
            None => self.surface_of(described, material, &name)?,
        };
        let material = material.or(by_file.as_ref());
        if self.surfaces[surface as usize].is_clear() {
            self.check_dielectric(object, &shape, &name)?;
        }
        self.check_coordinates(object, surface, &shape, &name)?;
        let material = material.map_or("light", |material| material.get_ref()).to_owned();
        Ok(Piece { name, shape, material, surface, origin })
    }

    fn object(
        &mut self,
        all: &mut Objects,
        object: &describe::Object,
        piece: Piece,
        light: Option<&Resolved>,
    ) -> Result<(), SceneError> {
        let Piece { name, shape, material, surface, .. } = piece;
        if let (Some(emission), Some(light)) = (&object.emission, light) {
            let id = ShapeId(all.shapes.len() as u32);
            all.emitters.push(self.emitter(emission.get_ref(), light, &name, id, &shape)?);
        }
        let priority = object.priority;
        let (rank, inside, touches, covers) = (0, Inside::General, false, false);
        all.objects.push(Object { name, material, surface, priority, rank, inside, touches, covers });
        all.shapes.push(shape);
        Ok(())
    }

    /// A material that only a mesh file names, and that nobody knows.
    fn unreplaced(&self, error: SceneError, named: &Spanned<String>) -> SceneError {
        let name = named.get_ref();
        if self.own_materials.contains_key(name) || self.library.material(name).is_ok() {
            return error;
        }
        let message = format!("this file calls a material `{name}`, which neither this scene nor the library has");
        let help = format!(
            "add `material = \"…\"` to the object, or at the end of the scene `[replace]` with `\"{name}\" = \"…\"`"
        );
        self.text.error(&named.span(), message).help(help)
    }

    fn surface_of(
        &mut self,
        described: &Spanned<describe::Object>,
        material: Option<&Spanned<String>>,
        name: &str,
    ) -> Result<u32, SceneError> {
        match material {
            Some(material) => self.material(material),
            None if described.get_ref().emission.is_some() => Ok(self.black()),
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
        light: &Resolved,
        name: &str,
        id: ShapeId,
        shape: &Shape,
    ) -> Result<Emitter, SceneError> {
        let two_sided = emission.two_sided;
        if let Shape::Mesh(placed) = shape
            && placed.mesh().was_inside_out()
            && !two_sided
        {
            self.warnings.push(format!(
                "`{name}` is closed and its triangles face inwards: it shines from its outside all the same; `two_sided = true` makes it shine inwards, too"
            ));
        }
        if two_sided && !matches!(shape, Shape::Mesh(_)) && shape.is_solid() {
            let message =
                format!("{name} is a solid: it shines from its outside, `two_sided` is for flat shapes and meshes");
            return Err(self.text.error(&emission.spectrum.span(), message));
        }
        let power = light.luminance * f64::from(shape.area()) * if two_sided { 2.0 } else { 1.0 };
        self.white_candidates.push((power, light.id));
        Ok(Emitter { source: Source::Shape { id, two_sided }, radiance: light.id, power })
    }

    fn check_dielectric(&self, object: &describe::Object, shape: &Shape, name: &str) -> Result<(), SceneError> {
        if !matches!(shape, Shape::Mesh(_)) && !shape.is_solid() {
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
}
