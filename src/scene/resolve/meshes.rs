//! Mesh files: each read once, however many objects show it.

use super::Resolver;
use super::place::place;
use crate::geometry::loaders::{self, FileCamera, MeshFile};
use crate::geometry::{Mesh, Placed};
use crate::scene::describe;
use crate::scene::{SceneError, listed};
use crate::spectrum::nearest;
use glam::{Affine3A, DVec3};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use toml::Spanned;

/// By path and crease angle (its bits).
pub type Meshes = BTreeMap<(PathBuf, Option<u64>), Arc<Loaded>>;

/// A file whose parts are ready for rays.
#[derive(Debug)]
pub struct Loaded {
    file: MeshFile,
    meshes: Vec<Arc<Mesh>>,
}

impl Loaded {
    pub fn cameras(&self) -> &[FileCamera] {
        &self.file.cameras
    }
}

/// A part of a file, somewhere.
pub struct Piece {
    pub name: String,
    /// As the file calls it.
    pub material: Option<String>,
    pub placed: Placed,
}

impl Resolver<'_> {
    /// The pieces of a mesh file that an object shows, where the file has them, as seen from an origin.
    pub fn pieces(&mut self, described: &describe::MeshFile, origin: DVec3) -> Result<Vec<Piece>, SceneError> {
        let crease = described.crease_angle.as_ref().map(|angle| self.crease(angle)).transpose()?;
        let loaded = self.loaded(&described.file, crease)?;
        let wanted = described.part.as_ref();
        let mut pieces = Vec::new();
        for placement in &loaded.file.placements {
            let part = &loaded.file.parts[placement.part];
            if wanted.is_some_and(|wanted| ![&placement.name, &part.name].contains(&wanted.get_ref())) {
                continue;
            }
            let transform = placement.transform;
            let translation = place(transform.translation.to_array(), origin);
            let affine = Affine3A::from_mat3_translation(transform.matrix3.as_mat3(), translation);
            let there = Placed::new(loaded.meshes[placement.part].clone());
            let placed = match affine == Affine3A::IDENTITY {
                true => there,
                false => there.transformed(&affine).map_err(|error| {
                    self.text.error(&described.file.span(), format!("`{}` of this file: {error}", placement.name))
                })?,
            };
            pieces.push(Piece { name: placement.name.clone(), material: part.material.clone(), placed });
        }
        match wanted {
            Some(wanted) if pieces.is_empty() => {
                let names = loaded.file.placements.iter().map(|placement| placement.name.as_str());
                Err(self.not_in_file("part", wanted, &names.collect::<Vec<_>>()))
            }
            _ => Ok(pieces),
        }
    }

    /// A name that a file does not have.
    pub fn not_in_file(&self, what: &str, wanted: &Spanned<String>, names: &[&str]) -> SceneError {
        let message = format!("the file has no {what} `{}`", wanted.get_ref());
        let error = self.text.error(&wanted.span(), message);
        match nearest(wanted.get_ref(), names.iter().copied()) {
            Some(name) => error.help(format!("did you mean `{name}`?")),
            None => error.help(format!("it has {}", listed(names))),
        }
    }

    /// A file ready for rays; with `crease` in degrees, smoothed.
    pub fn loaded(&mut self, file: &Spanned<String>, crease: Option<f64>) -> Result<Arc<Loaded>, SceneError> {
        let path = self.text.base().join(file.get_ref());
        let key = (path, crease.map(f64::to_bits));
        if let Some(known) = self.meshes.get(&key) {
            return Ok(known.clone());
        }
        let (span, name) = (file.span(), file.get_ref());
        self.files.insert(key.0.clone());
        let mut file = loaders::load(&key.0).map_err(|error| self.text.error(&span, error))?;
        self.warnings.extend(file.notes.iter().map(|note| format!("{name}: {note}")));
        let ready = |part: &mut loaders::Part| {
            let triangles = std::mem::take(&mut part.triangles);
            Mesh::new(match crease {
                Some(degrees) => triangles.smoothed(degrees),
                None => triangles,
            })
        };
        let meshes = file.parts.iter_mut().map(|part| ready(part).map(Arc::new)).collect::<Result<Vec<_>, _>>();
        let meshes = meshes.map_err(|error| self.text.error(&span, error))?;
        let loaded = Arc::new(Loaded { file, meshes });
        self.meshes.insert(key, loaded.clone());
        Ok(loaded)
    }

    fn crease(&self, angle: &describe::Number) -> Result<f64, SceneError> {
        match *angle.get_ref() {
            degrees if (0.0..=180.0).contains(&degrees) => Ok(degrees),
            degrees => {
                Err(self.text.error(&angle.span(), format!("`crease_angle` is {degrees}: it must be within 0 … 180")))
            }
        }
    }

    /// Names a dielectric whose mesh has no inside.
    pub fn warn_of_openings(&mut self, name: &str, placed: &Placed) {
        let surroundings = placed.mesh().surroundings();
        if let Some(middle) = surroundings.opening {
            self.warnings.push(format!(
                "`{name}` is not closed: {} of its edges have a triangle on one side only, one of them at {:.6}, {:.6}, {:.6} of the file; \
                 light that comes in or out by the gap does not know that it did",
                surroundings.open_edges, middle.x, middle.y, middle.z
            ));
        }
    }
}
