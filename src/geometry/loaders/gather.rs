//! Parts as the readers bring them, cleaned: triangles without area go, vertices that nobody uses go, normals that say
//! nothing go. Everything that went is counted in a note.

use glam::{DAffine3, DVec3, Vec3};
use rayon::prelude::*;

use super::error::Fault;
use super::{MeshFile, Part, Placement, Triangles};
use crate::geometry::{GeometryError, check};

/// The parts of a file so far.
#[derive(Default)]
pub(super) struct Gathered {
    pub parts: Vec<Part>,
    pub notes: Vec<String>,
}

impl Gathered {
    pub fn note(&mut self, note: impl Into<String>) {
        self.notes.push(note.into());
    }

    /// Takes a part in, and says its number; a part without any triangle worth showing is dropped with a note. Indices
    /// must have been checked: a triangle that names no vertex would be skipped like one without area.
    pub fn add(&mut self, mut part: Part) -> Option<usize> {
        let name = part.name.clone();
        self.drop_bad_triangles(&mut part);
        if part.triangles.indices.is_empty() {
            self.note(format!("`{name}` has no faces and was dropped"));
            return None;
        }
        drop_unused(&mut part.triangles);
        self.drop_bad_normals(&mut part);
        self.drop_bad_uvs(&mut part);
        self.parts.push(part);
        Some(self.parts.len() - 1)
    }

    fn drop_bad_triangles(&mut self, part: &mut Part) {
        let mut counts = [0; 3];
        let Triangles { positions, indices, .. } = &mut part.triangles;
        if indices.par_iter().all(|corners| flaw(corners, positions).is_none()) {
            return;
        }
        indices.retain(|corners| match flaw(corners, positions) {
            None => true,
            Some(flaw) => {
                if let Some(count) = counts.get_mut(flaw as usize) {
                    *count += 1;
                }
                false
            }
        });
        let [twice, infinite, flat] = counts;
        let name = &part.name;
        let skipped = [
            (twice, "names the same vertex twice", "name the same vertex twice"),
            (infinite, "has a corner that is not a finite number", "have corners that are not finite numbers"),
            (flat, "has no area", "have no area"),
        ];
        for (count, one, many) in skipped {
            match count {
                0 => {}
                1 => self.notes.push(format!("1 triangle of `{name}` {one} and was skipped")),
                _ => self.notes.push(format!("{count} triangles of `{name}` {many} and were skipped")),
            }
        }
    }

    /// One normal without direction spoils the interpolation of its neighbours, and a guess could differ much from what
    /// was meant: then the part is faceted.
    fn drop_bad_normals(&mut self, part: &mut Part) {
        let normals = &mut part.triangles.normals;
        let bad = normals.iter().filter(|n| !n.is_finite() || **n == Vec3::ZERO).count();
        if bad > 0 {
            normals.clear();
            let name = &part.name;
            self.notes.push(format!(
                "{} of `{name}` {} zero or not finite: its normals were dropped, it is faceted",
                count(bad, "normal"),
                if bad == 1 { "is" } else { "are" }
            ));
        }
        // Any length is allowed; squares of these would leave single precision.
        for normal in part.triangles.normals.iter_mut() {
            let longest = normal.abs().max_element();
            if !(1e-12..=1e12).contains(&longest) {
                *normal = normal.as_dvec3().normalize().as_vec3();
            }
        }
    }

    fn drop_bad_uvs(&mut self, part: &mut Part) {
        let uvs = &mut part.triangles.uvs;
        if uvs.iter().any(|uv| !uv.is_finite()) {
            uvs.clear();
            let note =
                format!("`{}` has texture coordinates that are not finite numbers: they were dropped", part.name);
            self.notes.push(note);
        }
    }

    /// The file, if anything is left to be seen.
    pub fn finish(self) -> Result<MeshFile, Fault> {
        let Self { parts, notes } = self;
        if parts.is_empty() {
            let why = if notes.is_empty() { String::new() } else { format!(": {}", notes.join("; ")) };
            return Err(Fault::new(format!("the file has no face to show{why}")));
        }
        Ok(MeshFile { parts, notes, ..MeshFile::default() })
    }

    /// The same for formats that place each part once, where it is.
    pub fn finish_in_place(self) -> Result<MeshFile, Fault> {
        let mut file = self.finish()?;
        let place = |(part, Part { name, .. }): (usize, &Part)| Placement {
            name: name.clone(),
            part,
            transform: DAffine3::IDENTITY,
        };
        file.placements = file.parts.iter().enumerate().map(place).collect();
        Ok(file)
    }
}

/// Why a triangle cannot be kept.
#[derive(Clone, Copy)]
enum Flaw {
    Twice,
    NotFinite,
    Flat,
}

fn flaw(corners: &[u32; 3], positions: &[Vec3]) -> Option<Flaw> {
    let [i, j, k] = *corners;
    if i == j || j == k || k == i {
        return Some(Flaw::Twice);
    }
    let point = |i: u32| positions.get(i as usize).map_or(DVec3::NAN, |p| p.as_dvec3());
    let [a, b, c] = corners.map(point);
    if !(a.is_finite() && b.is_finite() && c.is_finite()) {
        return Some(Flaw::NotFinite);
    }
    // Of single-precision corners the edges are all but exact in double precision, and nothing under- or overflows.
    ((b - a).cross(c - a) == DVec3::ZERO).then_some(Flaw::Flat)
}

/// Keeps the vertices that triangles use, in their order.
fn drop_unused(triangles: &mut Triangles) {
    const UNUSED: u32 = u32::MAX;
    let Triangles { positions, normals, uvs, indices } = triangles;
    let mut places = vec![UNUSED; positions.len()];
    for &corner in indices.as_flattened() {
        if let Some(place) = places.get_mut(corner as usize) {
            *place = 0;
        }
    }
    if !places.contains(&UNUSED) {
        return;
    }
    let used: Vec<bool> = places.iter().map(|&place| place != UNUSED).collect();
    for (place, next) in places.iter_mut().filter(|place| **place != UNUSED).zip(0..) {
        *place = next;
    }
    keep(positions, &used);
    keep(normals, &used);
    keep(uvs, &used);
    for corner in indices.as_flattened_mut() {
        *corner = places.get(*corner as usize).copied().unwrap_or(UNUSED);
    }
}

fn keep<T>(values: &mut Vec<T>, used: &[bool]) {
    let mut used = used.iter();
    values.retain(|_| used.next().copied().unwrap_or(false));
}

/// A vertex of a file. Numbers that are none pass: they cost the triangles that use them; what single precision cannot
/// work with is an error.
pub(super) fn position(x: f64, y: f64, z: f64) -> Result<Vec3, String> {
    let point = DVec3::new(x, y, z);
    in_range("a coordinate", point)?;
    Ok(point.as_vec3())
}

/// Finite numbers within the range of shapes, or none at all.
pub(super) fn in_range(what: &'static str, vector: DVec3) -> Result<(), String> {
    let single = vector.as_vec3();
    if single.is_finite() && check::point(what, single).is_ok() {
        return Ok(());
    }
    // The range is that of the check; the number is told as the file has it.
    let too_large = |value: &f64| value.is_finite() && check::point(what, Vec3::splat(*value as f32)).is_err();
    match vector.to_array().into_iter().find(too_large) {
        Some(value) => Err(GeometryError::OutOfRange { what, value: value.abs() }.to_string()),
        None => Ok(()),
    }
}

/// `1 triangle`, `2 triangles`, `2 meshes`.
pub(super) fn count(number: usize, noun: &str) -> String {
    let ending = match noun.ends_with("sh") {
        _ if number == 1 => "",
        true => "es",
        false => "s",
    };
    format!("{number} {noun}{ending}")
}
