//! Where a mesh is open.

use std::collections::{HashMap, HashSet};

use glam::Vec3;

use super::whichever_way;
use crate::geometry::Triangles;
use crate::geometry::mesh::weld;

/// The edges that an odd number of a mesh's triangles have, by the bits of their ends: the same in
/// every mesh.
#[derive(Clone, Debug, Default)]
pub struct Rim {
    edges: HashSet<[[u32; 3]; 2]>,
}

impl Rim {
    /// Triangles that are there several times count once.
    pub fn of(mesh: &Triangles) -> Self {
        let welded = weld(&mesh.positions);
        let mut seen = HashSet::with_capacity(mesh.indices.len());
        let mut edges = HashSet::new();
        for corners in mesh.indices.iter().filter(|corners| seen.insert(whichever_way(corners, &welded))) {
            let [a, b, c] = corners.map(|corner| bits(mesh.positions[corner as usize]));
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let edge = [from.min(to), from.max(to)];
                // An edge that comes a second time is closed, a third time open again.
                if !edges.remove(&edge) {
                    edges.insert(edge);
                }
            }
        }
        Self { edges }
    }

    /// Sets of rims that have edges in common, as the number of the first rim of each one's set.
    pub fn sets(rims: &[&Rim]) -> Vec<usize> {
        let mut sets: Vec<usize> = (0..rims.len()).collect();
        let mut owners: HashMap<[[u32; 3]; 2], usize> = HashMap::new();
        for (number, rim) in rims.iter().enumerate() {
            for edge in &rim.edges {
                let owner = *owners.entry(*edge).or_insert(number);
                let (a, b) = (first(&sets, owner), first(&sets, number));
                sets[a.max(b)] = a.min(b);
            }
        }
        (0..sets.len()).map(|number| first(&sets, number)).collect()
    }
}

fn first(sets: &[usize], mut number: usize) -> usize {
    while sets[number] != number {
        number = sets[number];
    }
    number
}

/// Adding zero makes −0 the same as 0.
fn bits(position: Vec3) -> [u32; 3] {
    position.to_array().map(|x| (x + 0.0).to_bits())
}
