//! Whether triangles close a volume, and which way they face.
//!
//! A mesh is closed if each edge is run through as often one way as the other: then its inside is well defined, and so is
//! the volume ⅓ Σ a · (b × c) / 2, which is negative if the mesh is turned inside out. Corners are one where their
//! positions are equal, since normals and texture coordinates may part them.

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
        let mut found = Self { volume: volume(mesh), ..Self::default() };
        let mut edges = Edges::of(mesh);
        for lower in 0..mesh.positions.len() {
            let ends = edges.from(lower);
            ends.sort_unstable();
            for same in ends.chunk_by(|a, b| a.corner() == b.corner()) {
                let forth = same.iter().filter(|end| end.is_forth()).count();
                if 2 * forth != same.len() {
                    found.open_edges += 1;
                    let middle = mesh.positions[lower] * 0.5 + mesh.positions[same[0].corner()] * 0.5;
                    found.opening = found.opening.or(Some(middle));
                }
            }
        }
        found
    }

    pub fn is_closed(&self) -> bool {
        self.open_edges == 0
    }
}

/// The edges of a mesh, sorted by the lower of their two corners. By counting: to sort pairs of corners took five times as long and
/// three times the memory.
struct Edges {
    ends: Vec<End>,
    /// Where the edges of each corner begin in `ends`, and where the last ones end.
    firsts: Vec<u32>,
}

/// The higher corner of an edge, and in the lowest bit whether a triangle runs towards it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct End(u32);

impl End {
    fn corner(self) -> usize {
        (self.0 >> 1) as usize
    }

    fn is_forth(self) -> bool {
        self.0 & 1 == 1
    }
}

impl Edges {
    fn of(mesh: &Triangles) -> Self {
        let welded = weld(&mesh.positions);
        let edges = || {
            mesh.indices.iter().flat_map(|triangle| {
                let [a, b, c] = triangle.map(|corner| welded[corner as usize]);
                [(a, b), (b, c), (c, a)].into_iter().filter(|(from, to)| from != to)
            })
        };
        let mut firsts = vec![0; mesh.positions.len() + 1];
        for (from, to) in edges() {
            firsts[from.min(to) as usize] += 1;
        }
        let mut sum = 0;
        for first in &mut firsts {
            sum += *first;
            *first = sum;
        }
        // Filled from the back of each corner's share, which leaves in `firsts` where it begins.
        let mut ends = vec![End(0); sum as usize];
        for (from, to) in edges() {
            let place = &mut firsts[from.min(to) as usize];
            *place -= 1;
            ends[*place as usize] = End(from.max(to) << 1 | u32::from(from < to));
        }
        Self { ends, firsts }
    }

    /// The edges of which a corner is the lower one.
    fn from(&mut self, corner: usize) -> &mut [End] {
        &mut self.ends[self.firsts[corner] as usize..self.firsts[corner + 1] as usize]
    }
}

/// For each position, the first one that equals it. A table with room for twice as many, searched onwards from where the bits of a
/// position say.
pub(super) fn weld(positions: &[Vec3]) -> Vec<u32> {
    const FREE: u32 = u32::MAX;
    let size = (2 * positions.len()).next_power_of_two();
    let mut table = vec![FREE; size];
    let first = |(index, position): (u32, &Vec3)| {
        let mut place = scatter(position) & (size - 1);
        loop {
            match table[place] {
                FREE => {
                    table[place] = index;
                    return index;
                }
                // As numbers, so −0 is 0.
                other if positions[other as usize] == *position => return other,
                _ => place = (place + 1) & (size - 1),
            }
        }
    };
    (0..).zip(positions).map(first).collect()
}

/// Coordinates are spread well enough for a multiplication a word.
fn scatter(position: &Vec3) -> usize {
    // Adding zero makes −0 the same as 0.
    let words = position.to_array().map(|x| u64::from((x + 0.0).to_bits()));
    let hash = words.iter().fold(0u64, |hash, word| (hash.rotate_left(23) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    (hash ^ (hash >> 32)) as usize
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
