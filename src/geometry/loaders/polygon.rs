//! Polygons to triangles.
//!
//! A fan wherever one covers the polygon, else ears are cut off one by one (G. H. Meisters, "Polygons have ears",
//! 1975). Every corner stays a corner of some triangle, also one in the middle of a straight edge: polygons that shared
//! an edge still share it. (Ready-made triangulators drop such corners, which would open closed solids.)

use glam::{DVec2, DVec3, Vec3};

/// Ears cost up to the cube of the number of corners; beyond this a polygon is cut into a fan come what may.
const MAX_EARS: usize = 400;

/// Faces of any number of corners, one after the other.
#[derive(Default)]
pub(super) struct Polygons {
    pub corners: Vec<u32>,
    /// Corners of each face.
    pub sizes: Vec<u32>,
}

impl Polygons {
    /// All triangles. Corners must be indices of positions.
    pub fn triangles(&self, positions: &[Vec3]) -> Vec<[u32; 3]> {
        let mut triangles = Vec::with_capacity(self.corners.len().saturating_sub(2 * self.sizes.len()));
        let mut rest = self.corners.as_slice();
        for &size in &self.sizes {
            let Some((face, after)) = rest.split_at_checked(size as usize) else { break };
            rest = after;
            triangulate(face, positions, &mut triangles);
        }
        triangles
    }
}

fn triangulate(face: &[u32], positions: &[Vec3], triangles: &mut Vec<[u32; 3]>) {
    if let &[a, b, c] = face {
        return triangles.push([a, b, c]);
    }
    let point = |&corner: &u32| positions.get(corner as usize).map_or(DVec3::NAN, |p| p.as_dvec3());
    let points: Vec<DVec3> = face.iter().map(point).collect();
    let Some(&origin) = points.first() else { return };
    // Newell's normal: the sum over a fan from any corner, concave or not.
    let normal: DVec3 = points.iter().zip(points.iter().skip(1)).map(|(a, b)| (a - origin).cross(b - origin)).sum();
    let flat: Vec<DVec2> = points.iter().map(|p| project(p - origin, normal)).collect();
    // Quads: one of the two diagonals lies inside. Others: ears find what a fan from the first corner does not.
    let starts = if face.len() == 4 { 2 } else { 1 };
    let fan = (0..starts).find(|&start| fan_covers(&flat, start));
    let order: Vec<u32> = (0..face.len() as u32).collect();
    let cut = match fan {
        Some(start) => fan_from(&order, start),
        None if face.len() <= MAX_EARS => ears(&flat, order),
        None => fan_from(&order, 0),
    };
    let corner = |i: u32| face.get(i as usize).copied();
    triangles.extend(cut.into_iter().filter_map(|[a, b, c]| Some([corner(a)?, corner(b)?, corner(c)?])));
}

/// Along the longest axis of the normal, so that a turn to the left stays one.
fn project(p: DVec3, normal: DVec3) -> DVec2 {
    let size = normal.abs();
    let (p, along) = if size.x >= size.y && size.x >= size.z {
        (DVec2::new(p.y, p.z), normal.x)
    } else if size.y >= size.z {
        (DVec2::new(p.z, p.x), normal.y)
    } else {
        (DVec2::new(p.x, p.y), normal.z)
    };
    if along < 0.0 { DVec2::new(p.y, p.x) } else { p }
}

fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

fn fan_covers(flat: &[DVec2], start: usize) -> bool {
    let mut around = flat.iter().cycle().skip(start).take(flat.len()).copied();
    let Some(apex) = around.next() else { return false };
    let rim: Vec<DVec2> = around.collect();
    rim.iter().zip(rim.iter().skip(1)).all(|(&b, &c)| turn(apex, b, c) > 0.0)
}

fn fan_from(order: &[u32], start: usize) -> Vec<[u32; 3]> {
    let mut around = order.iter().cycle().skip(start).take(order.len()).copied();
    let Some(apex) = around.next() else { return Vec::new() };
    let rim: Vec<u32> = around.collect();
    rim.iter().zip(rim.iter().skip(1)).map(|(&b, &c)| [apex, b, c]).collect()
}

/// Cuts ears until a triangle is left; where none is to be had (the polygon meets itself), a fan of the rest.
fn ears(flat: &[DVec2], mut order: Vec<u32>) -> Vec<[u32; 3]> {
    let mut cut = Vec::with_capacity(order.len());
    while order.len() > 3 {
        let Some(at) = (0..order.len()).find(|&at| is_ear(flat, &order, at)) else { break };
        cut.extend(neighbours(&order, at));
        order.remove(at);
    }
    cut.extend(fan_from(&order, 0));
    cut
}

/// The corner with the ones before and after it.
fn neighbours(order: &[u32], at: usize) -> Option<[u32; 3]> {
    let count = order.len();
    let get = |i: usize| order.get(i % count).copied();
    Some([get(at + count - 1)?, get(at)?, get(at + 1)?])
}

fn is_ear(flat: &[DVec2], order: &[u32], at: usize) -> bool {
    let point = |i: u32| flat.get(i as usize).copied().unwrap_or(DVec2::NAN);
    let Some(ear) = neighbours(order, at) else { return false };
    let [a, b, c] = ear.map(point);
    let inside = |p: DVec2| turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    let at_corner = |p: DVec2| p == a || p == b || p == c;
    turn(a, b, c) > 0.0
        && !order.iter().any(|&i| {
            let p = point(i);
            !ear.contains(&i) && inside(p) && !at_corner(p)
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Areas of the triangles of a polygon in the plane x + y + z = 0, each along the polygon's normal.
    fn areas(outline: &[(f32, f32)]) -> Vec<f64> {
        let positions: Vec<Vec3> = outline.iter().map(|&(x, y)| Vec3::new(x, y, -x - y)).collect();
        let sizes = vec![outline.len() as u32];
        let polygons = Polygons { corners: (0..outline.len() as u32).collect(), sizes };
        let triangles = polygons.triangles(&positions);
        assert_eq!(triangles.len(), outline.len() - 2);
        let corner = |i: u32| positions[i as usize].as_dvec3();
        let z = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).z / 2.0;
        triangles.iter().map(|t| z(t.map(corner))).collect()
    }

    fn check(outline: &[(f32, f32)], area: f64) {
        let areas = areas(outline);
        assert!(areas.iter().all(|&a| a > 0.0), "{areas:?}");
        assert!((areas.iter().sum::<f64>() - area).abs() < 1e-6, "{areas:?}");
        let backwards: Vec<(f32, f32)> = outline.iter().rev().copied().collect();
        let areas = self::areas(&backwards);
        assert!(areas.iter().all(|&a| a < 0.0), "{areas:?}");
        assert!((areas.iter().sum::<f64>() + area).abs() < 1e-6, "{areas:?}");
    }

    #[test]
    fn convex_and_concave_polygons_are_covered_once() {
        check(&[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)], 2.0);
        // An arrow head, from each of its corners.
        let arrow = [(0.0, 0.0), (2.0, 2.0), (0.0, 1.0), (-2.0, 2.0)];
        for start in 0..4 {
            let turned: Vec<_> = arrow.iter().cycle().skip(start).take(4).copied().collect();
            check(&turned, 2.0);
        }
        // A letter U, and a comb whose fan from the first corner would fold.
        check(&[(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (2.0, 3.0), (2.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)], 7.0);
        check(&[(0.0, 0.0), (5.0, 0.0), (5.0, 2.0), (4.0, 1.0), (3.0, 2.0), (2.0, 1.0), (1.0, 2.0)], 7.0);
    }

    #[test]
    fn a_corner_on_a_straight_edge_stays() {
        check(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)], 2.0);
        check(&[(1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0), (0.0, 0.0)], 2.0);
    }

    #[test]
    fn polygons_of_nothing_end() {
        let line: Vec<(f32, f32)> = (0..9).map(|i| (i as f32, 0.0)).collect();
        assert_eq!(areas(&line), vec![0.0; 7]);
        assert_eq!(areas(&[(1.0, 1.0); 5]), vec![0.0; 3]);
    }
}
