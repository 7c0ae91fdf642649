//! Mesh files: each read once, however many objects show it.

use super::Resolver;
use super::bodies::Origin;
use super::place::place;
use crate::geometry::loaders::{self, FileCamera, MeshFile, Projection, Z_UP};
use crate::geometry::{Mesh, Placed, Surroundings};
use crate::scene::describe;
use crate::scene::{SceneError, listed};
use crate::spectrum::nearest;
use glam::{Affine3A, DAffine3, DMat3, DVec3};
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
    /// Its cameras, where one unit of the file is so many of the scene's.
    pub fn cameras(&self, scale: f64) -> impl Iterator<Item = FileCamera> {
        self.file.cameras.iter().cloned().map(move |camera| FileCamera {
            position: camera.position * scale,
            projection: match camera.projection {
                Projection::Orthographic { width, height } => {
                    Projection::Orthographic { width: width * scale, height: height * scale }
                }
                perspective => perspective,
            },
            ..camera
        })
    }
}

/// A part of a file, somewhere.
pub struct Piece {
    pub name: String,
    /// As the file calls it.
    pub material: Option<String>,
    pub placed: Placed,
    pub origin: Origin,
}

impl Resolver<'_> {
    /// The pieces of a mesh file that an object shows, where the file has them, as seen from an origin.
    pub fn pieces(&mut self, described: &describe::MeshFile, origin: DVec3) -> Result<Vec<Piece>, SceneError> {
        let loaded = self.mesh_file(described)?;
        let turned = self.file_to_scene(described, &loaded)?;
        let wanted = described.part.as_ref();
        let mut pieces = Vec::new();
        for placement in &loaded.file.placements {
            let part = &loaded.file.parts[placement.part];
            if wanted.is_some_and(|wanted| ![&placement.name, &part.name].contains(&wanted.get_ref())) {
                continue;
            }
            let transform = turned * placement.transform;
            let translation = place(transform.translation.to_array(), origin);
            let affine = Affine3A::from_mat3_translation(transform.matrix3.as_mat3(), translation);
            let there = Placed::new(loaded.meshes[placement.part].clone());
            let placed = match affine == Affine3A::IDENTITY {
                true => there,
                false => there.transformed(&affine).map_err(|error| {
                    self.text.error(&described.file.span(), format!("`{}` of this file: {error}", placement.name))
                })?,
            };
            let origin = Origin { part: placement.part, affine };
            pieces.push(Piece { name: placement.name.clone(), material: part.material.clone(), placed, origin });
        }
        match wanted {
            Some(wanted) if pieces.is_empty() => {
                let names = loaded.file.placements.iter().map(|placement| placement.name.as_str());
                Err(self.not_in_file("part", wanted, &names.collect::<Vec<_>>()))
            }
            _ => Ok(pieces),
        }
    }

    /// The file of an object, smoothed as the object says.
    pub fn mesh_file(&mut self, described: &describe::MeshFile) -> Result<Arc<Loaded>, SceneError> {
        let crease = described.crease_angle.as_ref().map(|angle| self.crease(angle)).transpose()?;
        self.loaded(&described.file, crease)
    }

    /// From the lengths and axes of a file, turned to z upwards where its format says what is up,
    /// to the scene's.
    fn file_to_scene(&self, described: &describe::MeshFile, loaded: &Loaded) -> Result<DAffine3, SceneError> {
        let scale = match &described.unit {
            None => self.file_unit(loaded),
            Some(unit) => match self.meters_per_unit {
                Some(scene) => unit.get_ref().metres() / scene,
                None => {
                    let error =
                        self.text.error(&unit.span(), "a unit of length, so the scene must say how long its own is");
                    return Err(
                        error.help("add `meters_per_unit = …` at the top, 0.001 if the scene is in millimetres")
                    );
                }
            },
        };
        let turn = match (described.up, loaded.file.is_in_metres) {
            (Some(describe::UpName::Y), false) => Z_UP,
            (Some(describe::UpName::Z), true) => Z_UP.transpose(),
            _ => DMat3::IDENTITY,
        };
        Ok(DAffine3 { matrix3: turn * scale, translation: DVec3::ZERO })
    }

    /// How many units of the scene one of a file is, as far as the two say.
    pub fn file_unit(&self, loaded: &Loaded) -> f64 {
        match self.meters_per_unit {
            Some(scene) if loaded.file.is_in_metres => 1.0 / scene,
            _ => 1.0,
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
    pub fn warn_of_openings(&mut self, name: &str, surroundings: &Surroundings) {
        let Surroundings { open_edges, gaps, opening, .. } = *surroundings;
        let at = |middle: glam::Vec3| format!("{:.6}, {:.6}, {:.6} of the file", middle.x, middle.y, middle.z);
        let what = match opening {
            Some(middle) if gaps > 0 => format!(
                "`{name}` is not closed: {gaps} of its edges have a triangle on one side only, one of them at {}; \
                 light that comes in or out by the gap does not know that it did",
                at(middle)
            ),
            Some(middle) => format!(
                "`{name}` has no inside: at {open_edges} of its edges triangles are wound against each other and cannot be made to agree, \
                 one of them at {}",
                at(middle)
            ),
            None if !surroundings.is_solid() => {
                format!("`{name}` encloses nothing: its triangles lie on each other, and a clear solid needs an inside")
            }
            None => return,
        };
        self.warnings.push(what);
    }
}
