//! One side of surfaces whose every face is there a second time from behind.
//!
//! The two need not be cut into the same triangles: a square's diagonal may be the other one. So
//! the front is followed from edge to edge: of the triangles that come back along an edge, the
//! neighbour is the one that does not fold back onto where one comes from.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use crate::geometry::Triangles;
use crate::geometry::mesh::weld;

/// Sheets that lie on each other agree in area and volume to this, relatively.
const ALIKE: f64 = 1e-6;

/// More sheets than these, or more triangles along one edge, are no export of a solid from both sides: each is compared with the others.
const MOST_SHEETS: usize = 10_000;
const MOST_ALONG: usize = 16;

/// The first of each pair of sheets that lie on each other, back to back; none if some have no such
/// other.
pub fn fronts(mesh: &Triangles) -> Option<Triangles> {
    let welded = weld(&mesh.positions);
    let sheets = sheets(mesh, &welded).filter(|sheets| sheets.len() <= MOST_SHEETS)?;
    let (mut kept, mut paired) = (Vec::new(), vec![false; sheets.len()]);
    for (place, front) in sheets.iter().enumerate() {
        if std::mem::replace(&mut paired[place], true) {
            continue;
        }
        let back = (place + 1..sheets.len()).find(|&back| !paired[back] && front.is_backed_by(&sheets[back]))?;
        paired[back] = true;
        kept.extend(front.triangles.iter().copied());
    }
    kept.sort_unstable();
    let indices = kept.iter().map(|&triangle: &u32| mesh.indices[triangle as usize]).collect();
    Some(Triangles { indices, ..mesh.clone() })
}

struct Sheet {
    triangles: Vec<u32>,
    volume: f64,
    area: f64,
    /// The sum of the corners, each times the area of its triangle.
    moment: DVec3,
}

impl Sheet {
    fn of(triangles: Vec<u32>, mesh: &Triangles) -> Self {
        let origin = mesh.positions[mesh.indices[0][0] as usize].as_dvec3();
        let (mut volume, mut area, mut moment) = (0.0, 0.0, DVec3::ZERO);
        for &triangle in &triangles {
            let [a, b, c] = corners(mesh, triangle).map(|corner| corner - origin);
            let size = (b - a).cross(c - a).length();
            (volume, area, moment) = (volume + a.dot(b.cross(c)), area + size, moment + (a + b + c) * size);
        }
        Self { triangles, volume, area, moment }
    }

    fn is_backed_by(&self, back: &Sheet) -> bool {
        let same = |a: f64, b: f64| (a - b).abs() <= ALIKE * a.abs().max(b.abs());
        let apart = (self.moment - back.moment).length();
        same(self.volume, -back.volume) && same(self.area, back.area) && apart <= ALIKE * self.moment.length()
    }
}

fn corners(mesh: &Triangles, triangle: u32) -> [DVec3; 3] {
    mesh.indices[triangle as usize].map(|corner| mesh.positions[corner as usize].as_dvec3())
}

/// All sheets, in the order of their first triangles; none where more triangles lie along an edge than can be told apart.
fn sheets(mesh: &Triangles, welded: &[u32]) -> Option<Vec<Sheet>> {
    let ends = |triangle: u32| mesh.indices[triangle as usize].map(|corner| welded[corner as usize]);
    let mut along: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
    for triangle in 0..mesh.indices.len() as u32 {
        let [a, b, c] = ends(triangle);
        [[a, b], [b, c], [c, a]].iter().for_each(|edge| along.entry(*edge).or_default().push(triangle));
    }
    if along.values().any(|triangles| triangles.len() > MOST_ALONG) {
        return None;
    }
    let at = |corner: u32| mesh.positions[corner as usize];
    let mut taken = vec![false; mesh.indices.len()];
    let mut sheets = Vec::new();
    for start in 0..mesh.indices.len() as u32 {
        if std::mem::replace(&mut taken[start as usize], true) {
            continue;
        }
        let (mut triangles, mut next) = (vec![start], 0);
        while let Some(&triangle) = triangles.get(next) {
            next += 1;
            let [a, b, c] = ends(triangle);
            for [from, to, apex] in [[a, b, c], [b, c, a], [c, a, b]] {
                let away = |&&other: &&u32| {
                    let apexes = ends(other).into_iter().find(|corner| *corner != from && *corner != to);
                    apexes.map_or(f64::INFINITY, |other| fold([from, to, apex, other].map(at)))
                };
                let back = along.get(&[to, from]).into_iter().flatten().filter(|other| **other != triangle);
                let Some(&neighbour) = back.min_by(|x, y| away(x).total_cmp(&away(y))) else { continue };
                if !std::mem::replace(&mut taken[neighbour as usize], true) {
                    triangles.push(neighbour);
                }
            }
        }
        sheets.push(Sheet::of(triangles, mesh));
    }
    Some(sheets)
}

/// The cosine between two triangles at their common edge, as their apexes lie: 1 where one folds
/// back onto the other.
fn fold([from, to, apex, other]: [Vec3; 4]) -> f64 {
    let [from, to, apex, other] = [from, to, apex, other].map(|p| p.as_dvec3());
    let along = (to - from).normalize_or_zero();
    let across = |apex: DVec3| ((apex - from) - along * along.dot(apex - from)).normalize_or_zero();
    across(apex).dot(across(other))
}
