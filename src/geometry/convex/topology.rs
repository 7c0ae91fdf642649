//! What the copies of a solid share: its exact form, and which of its vertices are the corners of which facet.
//!
//! An affine map with an inverse keeps a convex solid convex and its vertices at its facets; only a mirror turns corners around.

use std::sync::OnceLock;

use super::polyhedron::Polyhedron;

/// The exact form of a solid with its topology.
#[derive(Clone, Debug)]
pub(super) struct Shared {
    pub exact: Polyhedron,
    upright: Topology,
    /// Made when the first mirrored copy is.
    mirrored: OnceLock<Topology>,
}

/// Facets by their corners, and edges; indices of vertices.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Topology {
    corners: Vec<u32>,
    /// The end of each facet's corners.
    ends: Vec<u32>,
    pub edges: Vec<[u32; 2]>,
}

impl Shared {
    pub fn new(exact: Polyhedron) -> Self {
        let faces = exact.faces.iter().map(|face| face.corners.iter().map(|&corner| corner as u32));
        Self { upright: Topology::new(faces), mirrored: OnceLock::new(), exact }
    }

    pub fn topology(&self, mirrored: bool) -> &Topology {
        if mirrored { self.mirrored.get_or_init(|| self.upright.mirrored()) } else { &self.upright }
    }
}

/// All else follows from the exact form.
impl PartialEq for Shared {
    fn eq(&self, other: &Self) -> bool {
        self.exact == other.exact
    }
}

impl Topology {
    fn new(faces: impl Iterator<Item = impl Iterator<Item = u32>>) -> Self {
        let (mut corners, mut ends, mut edges) = (Vec::new(), Vec::new(), Vec::new());
        for face in faces {
            let start = corners.len();
            corners.extend(face);
            let own: &[u32] = &corners[start..];
            let next = own.iter().cycle().skip(1);
            // Each edge runs both ways, once in each of its facets.
            edges.extend(own.iter().zip(next).map(|(&a, &b)| [a, b]).filter(|[a, b]| a < b));
            ends.push(corners.len() as u32);
        }
        edges.sort_unstable();
        edges.dedup();
        Self { corners, ends, edges }
    }

    fn mirrored(&self) -> Self {
        let facets = 0..self.ends.len() as u32;
        let corners = facets.flat_map(|facet| self.corners(facet).iter().rev().copied()).collect();
        Self { corners, ends: self.ends.clone(), edges: self.edges.clone() }
    }

    /// The corners of a facet against the clock seen from outside; none if there is no such facet.
    #[inline]
    pub fn corners(&self, facet: u32) -> &[u32] {
        let facet = facet as usize;
        let start = if facet == 0 { Some(&0) } else { self.ends.get(facet - 1) };
        let range = start.zip(self.ends.get(facet)).map(|(&start, &end)| start as usize..end as usize);
        range.and_then(|range| self.corners.get(range)).unwrap_or(&[])
    }
}
