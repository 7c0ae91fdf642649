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
    /// Those of them that an odd number of triangles have: at the others all that is wrong are
    /// windings.
    pub gaps: usize,
    /// The middle of an open edge, of a gap if there is one.
    pub opening: Option<Vec3>,
    /// Signed volume, cubed units of the mesh; of no meaning unless it is closed.
    pub volume: f64,
    /// Below this a volume is rounding.
    least_volume: f64,
}

/// A volume below this share of area times size is rounding: sheets whose sides coincide.
const SHEET: f64 = 1e-9;

impl Surroundings {
    pub fn of(mesh: &Triangles) -> Self {
        let (volume, least_volume) = volume(mesh);
        let mut found = Self { volume, least_volume, ..Self::default() };
        let mut edges = Edges::of(mesh);
        for lower in 0..mesh.positions.len() {
            let ends = edges.from(lower);
            ends.sort_unstable();
            for same in ends.chunk_by(|a, b| a.corner() == b.corner()) {
                let forth = same.iter().filter(|end| end.is_forth()).count();
                if 2 * forth != same.len() {
                    let gap = same.len() % 2 == 1;
                    let middle = mesh.positions[lower] * 0.5 + mesh.positions[same[0].corner()] * 0.5;
                    if found.opening.is_none() || (gap && found.gaps == 0) {
                        found.opening = Some(middle);
                    }
                    found.open_edges += 1;
                    found.gaps += usize::from(gap);
                }
            }
        }
        found
    }

    pub fn is_closed(&self) -> bool {
        self.open_edges == 0
    }

    /// Whether it is closed around something: two sheets back to back are not.
    pub fn is_solid(&self) -> bool {
        self.is_closed() && self.volume.abs() > self.least_volume
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
pub(in crate::geometry) fn weld(positions: &[Vec3]) -> Vec<u32> {
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

/// About a corner of the mesh, so that a mesh far from the origin keeps its digits; and the least
/// volume that is one.
fn volume(mesh: &Triangles) -> (f64, f64) {
    let Some(origin) = mesh.positions.first().map(|p| p.as_dvec3()) else { return (0.0, 0.0) };
    let (mut six, mut area2, mut farthest) = (0.0, 0.0, 0.0f64);
    for triangle in &mesh.indices {
        let [a, b, c]: [DVec3; 3] = triangle.map(|corner| mesh.positions[corner as usize].as_dvec3() - origin);
        six += a.dot(b.cross(c));
        area2 += (b - a).cross(c - a).length();
        farthest = farthest.max(a.length_squared());
    }
    (six / 6.0, SHEET * area2 * farthest.sqrt())
}
