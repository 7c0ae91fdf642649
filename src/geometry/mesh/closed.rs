//! Whether triangles close a volume, and which way they face.
//!
//! A mesh is closed if each edge is run through as often one way as the other: then its inside is well defined, and so is
//! the volume ⅓ Σ a · (b × c) / 2, which is negative if the mesh is turned inside out. Corners are one where their
//! positions are equal, since normals and texture coordinates may part them.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use glam::{DVec3, Vec3};

use crate::geometry::Triangles;

/// What was found out about a mesh's surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// Edges that triangles run through more often one way than the other.
    pub open_edges: usize,
    /// The middle of one of them.
    pub opening: Option<Vec3>,
    /// Signed volume, cubed units of the mesh; of no meaning unless it is closed.
    pub volume: f64,
}

impl Surroundings {
    pub fn of(mesh: &Triangles) -> Self {
        let welded = weld(&mesh.positions);
        let mut edges: Vec<(u32, u32, bool)> = Vec::with_capacity(3 * mesh.indices.len());
        for triangle in &mesh.indices {
            let corners = triangle.map(|corner| welded[corner as usize]);
            for k in 0..3 {
                let (from, to) = (corners[k], corners[(k + 1) % 3]);
                edges.push((from.min(to), from.max(to), from < to));
            }
        }
        edges.sort_unstable();
        let mut found = Self { volume: volume(mesh), ..Self::default() };
        for same in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let forth = same.iter().filter(|edge| edge.2).count();
            let (from, to, _) = same[0];
            if from != to && 2 * forth != same.len() {
                found.open_edges += 1;
                let middle = || mesh.positions[from as usize] * 0.5 + mesh.positions[to as usize] * 0.5;
                found.opening = found.opening.or_else(|| Some(middle()));
            }
        }
        found
    }

    pub fn is_closed(&self) -> bool {
        self.open_edges == 0
    }
}

/// For each position, the first one that equals it.
pub(super) fn weld(positions: &[Vec3]) -> Vec<u32> {
    let mut first: HashMap<[u32; 3], u32, BuildHasherDefault<Bits>> =
        HashMap::with_capacity_and_hasher(positions.len(), BuildHasherDefault::default());
    // Adding zero makes −0 the same as 0.
    let key = |p: &Vec3| p.to_array().map(|x| (x + 0.0).to_bits());
    (0..).zip(positions).map(|(index, position)| *first.entry(key(position)).or_insert(index)).collect()
}

/// Coordinates are spread well enough for a multiplication a word; the standard hash took half of the time of a check.
#[derive(Default)]
struct Bits(u64);

impl Hasher for Bits {
    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(4) {
            let mut word = [0; 4];
            word[..chunk.len()].copy_from_slice(chunk);
            self.write_u32(u32::from_le_bytes(word));
        }
    }

    fn write_u32(&mut self, word: u32) {
        self.0 = (self.0.rotate_left(23) ^ u64::from(word)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }

    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 32)
    }
}

/// About a corner of the mesh, so that a mesh far from the origin keeps its digits.
fn volume(mesh: &Triangles) -> f64 {
    let Some(origin) = mesh.positions.first().map(|p| p.as_dvec3()) else { return 0.0 };
    let six = |triangle: &[u32; 3]| -> f64 {
        let [a, b, c]: [DVec3; 3] = triangle.map(|corner| mesh.positions[corner as usize].as_dvec3() - origin);
        a.dot(b.cross(c))
    };
    mesh.indices.iter().map(six).sum::<f64>() / 6.0
}
