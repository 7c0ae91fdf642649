//! Mesh files of every format: what they say is what is loaded, and what is wrong with them is told.

mod broken;
mod cameras;
mod formats;
mod gltf;
mod obj;
mod ply;
mod stl;
mod times;
mod write;

use std::collections::HashMap;
use std::fs;

use glam::{DVec3, Vec3};
use spectrel::geometry::Triangles;
use spectrel::geometry::loaders::{LoadError, MeshFile, load};

/// Loads these bytes as a file `mesh.<extension>`.
fn load_bytes(extension: &str, bytes: &[u8]) -> Result<MeshFile, LoadError> {
    load_beside(extension, bytes, &[])
}

/// The same with other files beside it.
fn load_beside(extension: &str, bytes: &[u8], others: &[(&str, &[u8])]) -> Result<MeshFile, LoadError> {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in others {
        fs::write(folder.path().join(name), bytes).unwrap();
    }
    let path = folder.path().join(format!("mesh.{extension}"));
    fs::write(&path, bytes).unwrap();
    load(&path)
}

fn loaded(extension: &str, bytes: impl AsRef<[u8]>) -> MeshFile {
    load_bytes(extension, bytes.as_ref()).unwrap_or_else(|error| panic!("{error}"))
}

/// The message without the folder, which differs from run to run.
fn error(extension: &str, bytes: impl AsRef<[u8]>) -> String {
    let error = load_bytes(extension, bytes.as_ref()).expect_err("this file is broken").to_string();
    error.split_once("mesh.").map_or(error.clone(), |(_, rest)| format!("mesh.{rest}"))
}

/// All triangles of a file where they stand; a placement that mirrors turns them round.
fn placed(file: &MeshFile) -> Vec<[DVec3; 3]> {
    let mut all = Vec::new();
    for placement in &file.placements {
        let mirrors = placement.transform.matrix3.determinant() < 0.0;
        for triangle in corners(&file.parts[placement.part].triangles) {
            let [a, b, c] = triangle.map(|p| placement.transform.transform_point3(p.as_dvec3()));
            all.push(if mirrors { [a, c, b] } else { [a, b, c] });
        }
    }
    all
}

fn corners(triangles: &Triangles) -> Vec<[Vec3; 3]> {
    triangles.indices.iter().map(|t| t.map(|i| triangles.positions[i as usize])).collect()
}

/// By the divergence theorem; positive if normals point outwards.
fn volume(triangles: &[[DVec3; 3]]) -> f64 {
    triangles.iter().map(|[a, b, c]| a.dot(b.cross(*c)) / 6.0).sum()
}

/// Each edge is gone along once in either direction.
fn is_closed(triangles: &[[DVec3; 3]]) -> bool {
    let mut edges: HashMap<[[u64; 3]; 2], i32> = HashMap::new();
    let bits = |p: DVec3| (p + DVec3::ZERO).to_array().map(f64::to_bits);
    for t in triangles {
        for i in 0..3 {
            let (a, b) = (bits(t[i]), bits(t[(i + 1) % 3]));
            *edges.entry([a, b]).or_default() += 1;
            *edges.entry([b, a]).or_default() -= 1;
        }
    }
    edges.values().all(|&count| count == 0)
}
