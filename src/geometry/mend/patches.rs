//! Windings followed from triangle to triangle over edges that just two of them have.
//!
//! Such triangles are a patch. Where every way around comes back with the same winding, the patch
//! has two sides, and the fewer triangles are turned to agree with the more; a patch with one side
//! only (Möbius's) stays as it is.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::turn;
use crate::geometry::mesh::weld;
use crate::geometry::{Bounds, Triangles};

/// No neighbour.
const NONE: u32 = u32::MAX;

/// Bodies that face inwards are compared with all others up to this many times.
const MOST_PAIRS: usize = 100_000_000;

/// Triangles wound alike once the turned ones are turned.
struct Patch {
    triangles: Vec<u32>,
    turned: Vec<u32>,
}

/// Makes windings agree; returns how many triangles were turned.
pub fn agree(mesh: &mut Triangles) -> usize {
    let turned: Vec<u32> = patches(mesh).into_iter().flat_map(|patch| patch.turned).collect();
    turned.iter().for_each(|&triangle| turn(mesh, triangle as usize));
    turned.len()
}

/// Turns bodies of a closed mesh that face inwards and are in no other's box, where the mesh as a
/// whole faces outwards (or the other way round, which whoever builds it mends); returns how many
/// triangles that were.
pub fn face_outwards(mesh: &mut Triangles, volume: f64) -> usize {
    if is_one_piece(mesh) {
        return 0;
    }
    let bodies: Vec<Body> = patches(mesh).into_iter().map(|patch| Body::of(patch.triangles, mesh)).collect();
    let wrong: Vec<&Body> = bodies.iter().filter(|body| body.closed && body.volume * volume < 0.0).collect();
    if wrong.len().saturating_mul(bodies.len()) > MOST_PAIRS {
        return 0;
    }
    let beside = |body: &&&Body| !bodies.iter().any(|other| !std::ptr::eq(other, **body) && other.holds(body));
    let turned: Vec<u32> = wrong.par_iter().filter(beside).flat_map_iter(|body| body.triangles.clone()).collect();
    turned.iter().for_each(|&triangle| turn(mesh, triangle as usize));
    turned.len()
}

/// A patch as a body.
struct Body {
    triangles: Vec<u32>,
    bounds: Bounds,
    volume: f64,
    /// Whether its triangles may close it: the sum of their areas as vectors is zero.
    closed: bool,
}

impl Body {
    fn of(triangles: Vec<u32>, mesh: &Triangles) -> Self {
        let corners = |triangle: &u32| mesh.indices[*triangle as usize].map(|corner| mesh.positions[corner as usize]);
        let bounds = Bounds::of(triangles.iter().flat_map(corners));
        let origin = bounds.center().as_dvec3();
        let (mut volume, mut sum, mut area) = (0.0, DVec3::ZERO, 0.0);
        for triangle in &triangles {
            let [a, b, c] = corners(triangle).map(|corner: Vec3| corner.as_dvec3() - origin);
            let across = (b - a).cross(c - a);
            (volume, sum, area) = (volume + a.dot(b.cross(c)), sum + across, area + across.length());
        }
        Self { triangles, bounds, volume, closed: sum.length() <= 1e-6 * area }
    }

    fn holds(&self, other: &Body) -> bool {
        self.bounds.min.cmple(other.bounds.min).all() && self.bounds.max.cmpge(other.bounds.max).all()
    }
}

/// Whether all triangles hang together by their corners, which is cheaper to see than patches are.
fn is_one_piece(mesh: &Triangles) -> bool {
    let mut roots = weld(&mesh.positions);
    let mut pieces = (0..).zip(&roots).filter(|(index, root)| index == *root).count();
    for &[a, b, c] in &mesh.indices {
        for (from, to) in [(a, b), (b, c)] {
            let (from, to) = (root(&mut roots, from), root(&mut roots, to));
            if from != to {
                roots[from.max(to) as usize] = from.min(to);
                pieces -= 1;
            }
        }
    }
    pieces <= 1
}

fn root(roots: &mut [u32], mut index: u32) -> u32 {
    while roots[index as usize] != index {
        let next = roots[index as usize];
        roots[index as usize] = roots[next as usize];
        index = next;
    }
    index
}

/// Patches in the order of their first triangles.
fn patches(mesh: &Triangles) -> Vec<Patch> {
    let neighbours = neighbours(mesh);
    // Of each triangle whether it is to be turned, once that is known.
    let mut turned: Vec<Option<bool>> = vec![None; mesh.indices.len()];
    let mut found = Vec::new();
    for start in 0..mesh.indices.len() as u32 {
        if turned[start as usize].is_some() {
            continue;
        }
        turned[start as usize] = Some(false);
        let (mut triangles, mut two_sided, mut next) = (vec![start], true, 0);
        while let Some(&triangle) = triangles.get(next) {
            next += 1;
            let here = turned[triangle as usize] == Some(true);
            for &(other, agrees) in neighbours[triangle as usize].iter().filter(|(other, _)| *other != NONE) {
                let wanted = here == agrees;
                match turned[other as usize] {
                    Some(known) => two_sided &= known == wanted,
                    None => {
                        turned[other as usize] = Some(wanted);
                        triangles.push(other);
                    }
                }
            }
        }
        let (mut some, others): (Vec<u32>, Vec<u32>) =
            triangles.iter().partition(|&&triangle| turned[triangle as usize] == Some(true));
        if some.len() > others.len() {
            some = others;
        }
        found.push(Patch { triangles, turned: if two_sided { some } else { Vec::new() } });
    }
    found
}

/// For each edge of a triangle the only other one that has it, and whether both run through it as
/// neighbours should, in opposite directions.
fn neighbours(mesh: &Triangles) -> Vec<[(u32, bool); 3]> {
    let welded = weld(&mesh.positions);
    // Ends of an edge, then the triangle's number, which of its edges it is, and whether it runs
    // upwards.
    let mut edges: Vec<(u32, u32, u32, u8, bool)> = Vec::with_capacity(3 * mesh.indices.len());
    for (triangle, corners) in (0..).zip(&mesh.indices) {
        let [a, b, c] = corners.map(|corner| welded[corner as usize]);
        for (edge, (from, to)) in (0..).zip([(a, b), (b, c), (c, a)]) {
            edges.push((from.min(to), from.max(to), triangle, edge, from < to));
        }
    }
    edges.par_sort_unstable();
    let mut neighbours = vec![[(NONE, true); 3]; mesh.indices.len()];
    for same in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let &[(.., one, edge, up), (.., other, others, others_up)] = same else { continue };
        neighbours[one as usize][usize::from(edge)] = (other, up != others_up);
        neighbours[other as usize][usize::from(others)] = (one, up != others_up);
    }
    neighbours
}
