//! Corners of open edges that are a hair apart become one.

use std::collections::HashMap;

use glam::{DVec3, I64Vec3, Vec3};

use super::Triangles;
use crate::geometry::Bounds;
use crate::geometry::mesh::weld;

/// The smallest gap that is looked for, as a share of the size: two roundings of a coordinate.
const FINEST: f64 = 1e-7;

/// Distances to try, up to a share of the size of a mesh.
pub fn distances(mesh: &Triangles, share: f64) -> Vec<f64> {
    let used = mesh.indices.iter().flatten().map(|&corner| mesh.positions[corner as usize]);
    let size = f64::from(Bounds::of(used).size().length());
    let mut shares: Vec<f64> = (0..12).map(|k| FINEST * 10f64.powi(k)).take_while(|tried| *tried < share).collect();
    if share > 0.0 {
        shares.push(share);
    }
    shares.into_iter().map(|share| share * size).collect()
}

/// Moves corners of open edges to the first one within a distance, and drops triangles that vanish
/// by it. Returns how many were moved and how far at most; none if no two are so near.
pub fn weld_rims(mesh: &mut Triangles, distance: f64) -> Option<(usize, f32)> {
    let welded = weld(&mesh.positions);
    let open = open_corners(mesh, &welded);
    let mut cells: HashMap<I64Vec3, Vec<u32>> = HashMap::new();
    let mut moved: HashMap<u32, Vec3> = HashMap::new();
    let mut farthest = 0.0f64;
    for &corner in &open {
        let at = mesh.positions[corner as usize];
        let near = neighbours(at, distance)
            .filter_map(|cell| cells.get(&cell))
            .flatten()
            .map(|&other| (mesh.positions[other as usize].as_dvec3().distance(at.as_dvec3()), other))
            .filter(|(apart, _)| *apart <= distance)
            .min_by(|a, b| a.0.total_cmp(&b.0));
        match near {
            Some((apart, other)) => {
                farthest = farthest.max(apart);
                moved.insert(corner, mesh.positions[other as usize]);
            }
            None => cells.entry(cell(at.as_dvec3(), distance)).or_default().push(corner),
        }
    }
    if moved.is_empty() {
        return None;
    }
    for (position, corner) in mesh.positions.iter_mut().zip(&welded) {
        *position = moved.get(corner).copied().unwrap_or(*position);
    }
    let positions = &mesh.positions;
    mesh.indices.retain(|corners| {
        let [a, b, c] = corners.map(|corner| positions[corner as usize]);
        a != b && b != c && c != a
    });
    Some((moved.len(), farthest as f32))
}

/// Ends of the edges that an odd number of triangles have, in their order.
fn open_corners(mesh: &Triangles, welded: &[u32]) -> Vec<u32> {
    let mut counts: HashMap<[u32; 2], u32> = HashMap::new();
    for corners in &mesh.indices {
        let [a, b, c] = corners.map(|corner| welded[corner as usize]);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *counts.entry([from.min(to), from.max(to)]).or_default() += 1;
        }
    }
    let mut open: Vec<u32> = counts.iter().filter(|(_, count)| *count % 2 == 1).flat_map(|(ends, _)| *ends).collect();
    open.sort_unstable();
    open.dedup();
    open
}

/// Cells are as wide as the distance, so that what is near is in one of the 27 around.
fn cell(at: DVec3, distance: f64) -> I64Vec3 {
    (at / distance).floor().as_i64vec3()
}

fn neighbours(at: Vec3, distance: f64) -> impl Iterator<Item = I64Vec3> {
    let middle = cell(at.as_dvec3(), distance);
    (0..27).map(move |k| middle.saturating_add(I64Vec3::new(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)))
}
