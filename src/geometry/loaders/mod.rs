//! Meshes from files: OBJ, PLY, STL and glTF 2.0, as plain triangles with the names that the files give.
//!
//! Every reader works on the whole file in memory, checks each count and index against what is really there before it
//! reserves or follows it, and says where a file is wrong: the line of a text, the byte or element of a binary. What
//! can be left out without harm (triangles without area, lines, points) is left out, counted and told in
//! [`MeshFile::notes`].
//!
//! The readers are our own, because of what they say of broken files. `tobj` and `stl_io` name no place at all;
//! `ply-rs-bw`, as fast as ours on bytes (0.05 s for the file below, 0.29 s as text), hands out elements without
//! their place, so a face that names a missing vertex has no line; `gltf` refuses files
//! for required extensions of materials, which we replace anyway. What does fit is used:
//! `serde_json` for the text of glTF, `base64` for the data inside it, the standard library's correctly rounded
//! numbers.
//!
//! From file to [`MeshFile`], a torus of 1 M triangles with normals and texture coordinates, one thread of a Zen 4
//! server (`times::load_times` of `tests/it/geometry/loaders` prints it):
//!
//! | file | MB | s |
//! |---|---|---|
//! | OBJ | 106 | 0.48 |
//! | OBJ, positions only | 39 | 0.30 |
//! | PLY, text | 61 | 0.19 |
//! | PLY, binary | 29 | 0.04 |
//! | STL, binary (positions only) | 50 | 0.17 |
//! | GLB | 28 | 0.03 |
//!
//! Coordinates are kept as the file has them (in single precision); only glTF says which way is up, and its placements
//! turn its y to our z. It alone has a unit, too: [`MeshFile::is_in_metres`].

mod error;
mod gather;
mod gltf;
mod number;
mod obj;
mod ply;
mod polygon;
mod stl;
mod text;
mod weld;

use std::fs::File;
use std::io::Read;
use std::path::Path;

use glam::{DAffine3, DVec3};

use super::Triangles;
pub use error::{LoadError, Place};
pub use gltf::Z_UP;

/// What a mesh file holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshFile {
    /// Every mesh with its material; triangles are in the part's own space, and each part has at least one.
    pub parts: Vec<Part>,
    /// Where parts stand. OBJ, PLY and STL place each part once, by the identity; glTF once for each node that shows
    /// it.
    pub placements: Vec<Placement>,
    pub cameras: Vec<FileCamera>,
    /// Lengths are metres and y was up, as glTF has it; the other formats say neither.
    pub is_in_metres: bool,
    /// What was skipped or could not be understood, in sentences for people.
    pub notes: Vec<String>,
}

/// A mesh of one material. Names need not be unique: a mesh of two materials is two parts of one name.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    pub name: String,
    /// The name that the file gives to the material.
    pub material: Option<String>,
    /// All positions are used by a triangle, finite and within the range of shapes; no triangle is without area.
    pub triangles: Triangles,
}

/// A part somewhere in the file's world.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// The name of the node, or of the part where files have no nodes.
    pub name: String,
    /// Index into [`MeshFile::parts`].
    pub part: usize,
    /// From the part's space to spectrel's (z upwards). It may mirror: outside stays outside, so whoever bakes it into
    /// positions must then turn the triangles round.
    pub transform: DAffine3,
}

/// A camera as the file has it, turned to spectrel's axes.
#[derive(Clone, Debug, PartialEq)]
pub struct FileCamera {
    pub name: String,
    /// The name of the node that holds it, by which modelling programs show it.
    pub node: Option<String>,
    pub position: DVec3,
    /// Unit vector of the view.
    pub direction: DVec3,
    /// Unit vector, upwards in the picture, perpendicular to `direction`.
    pub up: DVec3,
    pub projection: Projection,
}

/// How a [`FileCamera`] sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// The aspect ratio is width over height; without one, it is that of the picture.
    Perspective { vertical_fov_degrees: f64, aspect_ratio: Option<f64> },
    /// Width and height of what is seen, in the file's units.
    Orthographic { width: f64, height: f64 },
}

impl Projection {
    /// The full horizontal angle for a picture of an aspect ratio (width over height); the file's own goes first. An
    /// orthographic camera has none.
    pub fn horizontal_fov_degrees(&self, picture_aspect_ratio: f64) -> Option<f64> {
        match *self {
            Projection::Perspective { vertical_fov_degrees, aspect_ratio } => {
                let half_height = libm::tan(vertical_fov_degrees.to_radians() / 2.0);
                let half_width = half_height * aspect_ratio.unwrap_or(picture_aspect_ratio);
                Some(2.0 * libm::atan(half_width).to_degrees())
            }
            Projection::Orthographic { .. } => None,
        }
    }
}

/// The extensions of the formats that [`load`] knows, in lower case.
pub const EXTENSIONS: [&str; 5] = ["obj", "ply", "stl", "gltf", "glb"];

/// Reads a mesh file; its extension tells the format.
pub fn load(path: &Path) -> Result<MeshFile, LoadError> {
    let extension = path.extension().map(|text| text.to_string_lossy().to_lowercase());
    let stem = path.file_stem().map_or_else(String::new, |text| text.to_string_lossy().into_owned());
    let format = match extension.as_deref() {
        Some("obj") => Format::Obj,
        Some("ply") => Format::Ply,
        Some("stl") => Format::Stl,
        Some("gltf" | "glb") => Format::Gltf,
        _ => return Err(LoadError::UnknownFormat { path: path.to_owned(), extension }),
    };
    let bytes = contents(path, None).map_err(|source| LoadError::Read { path: path.to_owned(), source })?;
    let file = match format {
        Format::Obj => obj::read(&bytes, &stem),
        Format::Ply => ply::read(&bytes, &stem),
        Format::Stl => stl::read(&bytes, &stem),
        Format::Gltf => gltf::read(&bytes, path),
    };
    file.map_err(|fault| fault.in_file(path))
}

enum Format {
    Obj,
    Ply,
    Stl,
    Gltf,
}

/// The bytes of a file, at most `limit`. Devices and pipes, which may never end, are refused.
fn contents(path: &Path, limit: Option<u64>) -> std::io::Result<Vec<u8>> {
    let file = File::open(path)?;
    let about = file.metadata()?;
    if !about.is_file() {
        return Err(std::io::Error::new(std::io::ErrorKind::InvalidInput, "it is not a file"));
    }
    let wanted = limit.unwrap_or(u64::MAX).min(about.len());
    let mut bytes = Vec::with_capacity(usize::try_from(wanted).unwrap_or(0));
    file.take(wanted).read_to_end(&mut bytes)?;
    Ok(bytes)
}
