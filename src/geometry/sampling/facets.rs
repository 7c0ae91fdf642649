//! Convex solids: by area, among the facets that show their outside to the reference.
//!
//! From inside all facets are seen from behind, and all of them take part.

use glam::Vec3;

use super::{Toward, area_pdf, by_area};
use crate::geometry::{Convex, Facet, Hit};

/// The facets that the reference sees, and the sum of their areas. Sampler and density both ask here, so they agree.
fn seen(solid: &Convex, reference: Vec3) -> (impl Fn(&Facet) -> bool, f32) {
    let o = reference - solid.center();
    let shows = move |f: &Facet| f.normal.dot(o) > f.offset;
    let area: f32 = solid.facets().iter().filter(|f| shows(f)).map(|f| f.area).sum();
    let inside = !(area > 0.0);
    (move |f: &Facet| inside || shows(f), if inside { solid.area() } else { area })
}

pub(super) fn sample(solid: &Convex, reference: Vec3, u: [f32; 2]) -> Option<Toward> {
    let (sees, area) = seen(solid, reference);
    let (index, facet, rest) =
        pick(u[0] * area, solid.facets().iter().enumerate().filter(|(_, f)| sees(f)).map(|(i, f)| (i, f, f.area)))?;
    let corners = solid.corners(index as u32);
    let vertex = |k: usize| corners.get(k).and_then(|&c| solid.vertices().get(c as usize)).copied();
    let a = vertex(0)?;
    let triangles = (1..corners.len().saturating_sub(1)).filter_map(|k| {
        let (b, c) = (vertex(k)?, vertex(k + 1)?);
        Some((k, (b, c), 0.5 * (b - a).cross(c - a).length()))
    });
    // The fan's triangles sum to the facet's area but for rounding.
    let (_, (b, c), share) = pick(rest * facet.area, triangles)?;
    // Uniform in the triangle: (1 − √s) a + √s ((1 − v) b + v c).
    let root = share.sqrt();
    let point = a + ((b - a) * (1.0 - u[1]) + (c - a) * u[1]) * root;
    by_area(reference, point, facet.normal, index as u32, area)
}

/// Chooses by weight: the item in which `target` falls as weights add up, and how far into it, 0…1. The last one takes
/// what rounding leaves.
fn pick<T>(mut target: f32, items: impl Iterator<Item = (usize, T, f32)>) -> Option<(usize, T, f32)> {
    let mut last = None;
    for (index, item, weight) in items {
        if !(weight > 0.0) {
            continue;
        }
        if target < weight {
            return Some((index, item, target / weight));
        }
        target -= weight;
        last = Some((index, item, 1.0));
    }
    last
}

pub(super) fn pdf(solid: &Convex, reference: Vec3, direction: Vec3, hit: &Hit) -> f32 {
    let (sees, area) = seen(solid, reference);
    match solid.facets().get(hit.facet as usize) {
        Some(facet) if sees(facet) => area_pdf(reference, direction, hit.point, facet.normal, area),
        _ => 0.0,
    }
}
