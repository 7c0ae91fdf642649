//! From half-spaces to vertices, facets and edges, in double precision.
//!
//! A large cube is cut by one plane after another. Vertices are shared and each is judged once against each plane (in, on
//! or out), so that many planes may pass through one vertex, as they do all over a gem, and facets still fit together.

mod crowd;

use glam::DVec3;

use crate::geometry::GeometryError;
use crowd::CROWD;

/// The half-space `normal`·x ≤ `offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    pub normal: DVec3,
    pub offset: f64,
}

impl Plane {
    pub fn new(normal: DVec3, offset: f64) -> Self {
        Self { normal, offset }
    }

    /// The half-space behind a point, `normal` pointing out of it.
    pub fn through(point: DVec3, normal: DVec3) -> Self {
        Self { normal, offset: normal.dot(point) }
    }

    /// The same half-space with a unit normal.
    pub(super) fn normalised(&self) -> Option<Self> {
        // Twice, because the square of a very long or short normal leaves the range of numbers.
        let scale = self.normal.abs().max_element();
        if !(scale > 0.0 && scale.is_finite() && self.offset.is_finite()) {
            return None;
        }
        let normal = self.normal / scale;
        let length = normal.length();
        let plane = Self { normal: normal / length, offset: self.offset / scale / length };
        (plane.normal.is_finite() && plane.offset.is_finite()).then_some(plane)
    }

    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// A facet: its plane, and its corners against the clock seen from outside.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Face {
    pub plane: usize,
    pub corners: Vec<usize>,
}

/// A bounded solid; `planes` are normalised and each bears one face, in their order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Polyhedron {
    pub planes: Vec<Plane>,
    /// Which of the given planes each one was.
    pub sources: Vec<u32>,
    pub vertices: Vec<DVec3>,
    pub faces: Vec<Face>,
}

/// Distances below this part of the size of the solid are none: ten thousand roundings in double precision, a hundredth of
/// one in single.
const TOLERANCE: f64 = 1e-9;

/// How far, in units of the farthest plane's distance, the solid may reach.
const HORIZON: f64 = 1e4;

impl Polyhedron {
    pub fn new(planes: &[Plane]) -> Result<Self, GeometryError> {
        let unit: Vec<Plane> = planes
            .iter()
            .enumerate()
            .map(|(index, plane)| plane.normalised().ok_or(GeometryError::BadPlane { index }))
            .collect::<Result<_, _>>()?;
        let farthest = unit.iter().map(|p| p.offset.abs()).fold(0.0, f64::max);
        // First from afar, to find where the solid is; then from near, so that its vertices are as exact as its size allows.
        let coarse = Cutter::run(&unit, DVec3::ZERO, HORIZON * farthest, farthest)?;
        let (center, radius) = coarse.extent();
        let fine = Cutter::run(&unit, center, 2.0 * radius, radius)?;
        fine.finish(&unit, radius)
    }
}

/// A cube's face while cutting goes on, beyond all plane numbers.
const CUBE: usize = usize::MAX;

struct Cutter {
    vertices: Vec<DVec3>,
    faces: Vec<Face>,
    tolerance: f64,
}

#[derive(Clone, Copy, PartialEq)]
enum Place {
    In,
    On,
    Out,
}

impl Cutter {
    fn run(planes: &[Plane], center: DVec3, half: f64, size: f64) -> Result<Self, GeometryError> {
        let cube = Self::cube(center, half, TOLERANCE * size);
        let cutter = if planes.len() > CROWD { crowd::cut(cube, planes)? } else { cube.cut_by(planes)? };
        if cutter.faces.iter().any(|f| f.plane == CUBE) {
            return Err(GeometryError::NoVolume);
        }
        Ok(cutter)
    }

    fn cut_by(mut self, planes: &[Plane]) -> Result<Self, GeometryError> {
        for (index, plane) in planes.iter().enumerate() {
            self.cut(plane, index);
            if self.faces.len() < 4 {
                return Err(GeometryError::NoVolume);
            }
        }
        Ok(self)
    }

    fn cube(center: DVec3, half: f64, tolerance: f64) -> Self {
        let sign = |bit: usize| if bit == 0 { -half } else { half };
        let vertices = (0..8).map(|i| center + DVec3::new(sign(i & 1), sign(i & 2), sign(i & 4))).collect();
        let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]
            .map(|corners| Face { plane: CUBE, corners: corners.to_vec() });
        Self { vertices, faces: faces.to_vec(), tolerance }
    }

    /// Centre of the bounding box, and the largest distance from it.
    fn extent(&self) -> (DVec3, f64) {
        let used = || self.faces.iter().flat_map(|f| f.corners.iter().map(|&i| self.vertices[i]));
        let min = used().fold(DVec3::INFINITY, DVec3::min);
        let max = used().fold(DVec3::NEG_INFINITY, DVec3::max);
        let center = (min + max) * 0.5;
        (center, used().map(|v| (v - center).length()).fold(0.0, f64::max))
    }

    /// Takes away what lies in front of the plane.
    fn cut(&mut self, plane: &Plane, index: usize) {
        let places: Vec<Place> = self
            .vertices
            .iter()
            .map(|&v| match plane.height(v) {
                h if h > self.tolerance => Place::Out,
                h if h < -self.tolerance => Place::In,
                _ => Place::On,
            })
            .collect();
        if !self.faces.iter().any(|f| f.corners.iter().any(|&c| places[c] == Place::Out)) {
            return;
        }
        // New vertices by the edge they halve, found from both of its faces.
        let mut halved: Vec<([usize; 2], usize)> = Vec::new();
        let mut rim: Vec<usize> = Vec::new();
        let mut kept = Vec::with_capacity(self.faces.len() + 1);
        for face in &self.faces {
            if !face.corners.iter().any(|&c| places[c] == Place::In) {
                continue;
            }
            let mut corners = Vec::with_capacity(face.corners.len() + 1);
            for (k, &a) in face.corners.iter().enumerate() {
                let b = face.corners[(k + 1) % face.corners.len()];
                if places[a] != Place::Out {
                    corners.push(a);
                }
                if places[a] == Place::On && !rim.contains(&a) {
                    rim.push(a);
                }
                let crosses = matches!((places[a], places[b]), (Place::In, Place::Out) | (Place::Out, Place::In));
                if crosses {
                    let edge = [a.min(b), a.max(b)];
                    let known = halved.iter().find(|(e, _)| *e == edge).map(|(_, v)| *v);
                    let vertex = known.unwrap_or_else(|| {
                        let [p, q] = edge.map(|i| self.vertices[i]);
                        let (hp, hq) = (plane.height(p), plane.height(q));
                        self.vertices.push(p + (q - p) * (hp / (hp - hq)));
                        halved.push((edge, self.vertices.len() - 1));
                        rim.push(self.vertices.len() - 1);
                        self.vertices.len() - 1
                    });
                    corners.push(vertex);
                }
            }
            if corners.len() >= 3 {
                kept.push(Face { plane: face.plane, corners });
            }
        }
        if rim.len() >= 3 {
            sort_around(|corner| self.vertices[corner], &mut rim, plane.normal);
            kept.push(Face { plane: index, corners: rim });
        }
        self.faces = kept;
        self.compact();
    }

    /// Forgets vertices that no face uses.
    fn compact(&mut self) {
        let mut renamed = vec![usize::MAX; self.vertices.len()];
        let mut vertices = Vec::new();
        for corner in self.faces.iter_mut().flat_map(|f| f.corners.iter_mut()) {
            if renamed[*corner] == usize::MAX {
                renamed[*corner] = vertices.len();
                vertices.push(self.vertices[*corner]);
            }
            *corner = renamed[*corner];
        }
        self.vertices = vertices;
    }

    /// Vertices that single precision could not tell apart become one, faces that vanish by it go, and each plane that
    /// still bears a face is kept.
    fn finish(mut self, planes: &[Plane], radius: f64) -> Result<Polyhedron, GeometryError> {
        let near = 100.0 * TOLERANCE * radius;
        let first = first_near(&self.vertices, near);
        for face in &mut self.faces {
            for corner in &mut face.corners {
                *corner = first[*corner];
            }
            face.corners.dedup();
            if face.corners.len() > 1 && face.corners.first() == face.corners.last() {
                face.corners.pop();
            }
        }
        let vertices = &self.vertices;
        self.faces.retain(|f| f.corners.len() >= 3 && area(vertices, &f.corners) > near * near);
        self.faces.sort_by_key(|f| f.plane);
        self.compact();
        let volume: f64 = self
            .faces
            .iter()
            .map(|f| {
                (planes[f.plane].offset - planes[f.plane].normal.dot(self.vertices[0]))
                    * area(&self.vertices, &f.corners)
            })
            .sum::<f64>()
            / 3.0;
        // A sheet, or a needle: single precision could not tell its sides apart.
        if self.faces.len() < 4 || !(volume > 1e-6 * radius * radius * radius * TOLERANCE.sqrt()) {
            return Err(GeometryError::NoVolume);
        }
        let sources = self.faces.iter().map(|f| f.plane as u32).collect();
        let kept = self.faces.iter().map(|f| planes[f.plane]).collect();
        let faces = self.faces.into_iter().enumerate().map(|(i, f)| Face { plane: i, corners: f.corners }).collect();
        Ok(Polyhedron { planes: kept, sources, vertices: self.vertices, faces })
    }
}

/// Of each vertex the first one that is no farther from it than `near`: itself, or one before it.
fn first_near(vertices: &[DVec3], near: f64) -> Vec<usize> {
    if vertices.len() > CROWD {
        return crowd::first_near(vertices, near);
    }
    (0..vertices.len()).map(|i| (0..i).find(|&j| (vertices[i] - vertices[j]).length() <= near).unwrap_or(i)).collect()
}

/// The corners of a convex polygon in their order around the normal.
fn sort_around(vertex: impl Fn(usize) -> DVec3, corners: &mut [usize], normal: DVec3) {
    let mean = corners.iter().map(|&c| vertex(c)).sum::<DVec3>() / corners.len() as f64;
    let axis = if normal.x.abs() < 0.6 { DVec3::X } else { DVec3::Y };
    let u = normal.cross(axis).normalize_or_zero();
    let v = normal.cross(u);
    let angle = |c: usize| {
        let w = vertex(c) - mean;
        libm::atan2(w.dot(v), w.dot(u))
    };
    corners.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
}

/// Area of a plane polygon.
pub(super) fn area(vertices: &[DVec3], corners: &[usize]) -> f64 {
    let fan = corners.windows(2).map(|pair| {
        let [a, b, c] = [corners[0], pair[0], pair[1]].map(|i| vertices[i]);
        (b - a).cross(c - a)
    });
    0.5 * fan.sum::<DVec3>().length()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solids(planes: &[Plane]) -> [Polyhedron; 2] {
        let unit: Vec<Plane> = planes.iter().map(|plane| plane.normalised().expect("a normal")).collect();
        let cube = || Cutter::cube(DVec3::ZERO, 4.0, TOLERANCE);
        let all = [cube().cut_by(&unit), crowd::cut(cube(), &unit)];
        all.map(|cutter| cutter.and_then(|cutter| cutter.finish(&unit, 1.0)).expect("a solid"))
    }

    fn agree(planes: &[Plane]) {
        let [one, other] = solids(planes);
        assert_eq!(one.sources, other.sources);
        assert_eq!(one.vertices.len(), other.vertices.len());
        for (a, b) in one.faces.iter().zip(&other.faces) {
            let corners = |solid: &Polyhedron, face: &Face| -> Vec<DVec3> {
                face.corners.iter().map(|&corner| solid.vertices[corner]).collect()
            };
            let (a, b) = (corners(&one, a), corners(&other, b));
            assert_eq!(a.len(), b.len());
            let from = b.iter().position(|corner| corner.distance(a[0]) < 1e-9).expect("the same corner");
            assert!(a.iter().zip(b.iter().cycle().skip(from)).all(|(a, b)| a.distance(*b) < 1e-9));
        }
        let edges: usize = other.faces.iter().map(|face| face.corners.len()).sum::<usize>() / 2;
        assert_eq!(other.vertices.len() + other.faces.len(), edges + 2, "Euler");
    }

    fn on_sphere(count: usize) -> impl Iterator<Item = DVec3> {
        (0..count).map(move |i| {
            let z = 1.0 - (2 * i + 1) as f64 / count as f64;
            let (sin, cos) = libm::sincos(i as f64 * 2.399_963_229_728_653);
            let across = (1.0 - z * z).sqrt();
            DVec3::new(across * cos, across * sin, z)
        })
    }

    /// Both ways to cut give one solid: planes at random and at all depths, around a ball, and many of them through a point.
    #[test]
    fn crowds_of_planes_are_cut_as_few_are() {
        let mut state = 7u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        for depth in [0.05, 0.5] {
            let planes: Vec<Plane> = (0..600)
                .map(|_| [(); 4].map(|()| random()))
                .map(|[x, y, z, far]| (DVec3::new(x - 0.5, y - 0.5, z - 0.5), 1.0 + depth * far))
                .map(|(normal, far)| Plane::new(normal, normal.length() * far))
                .collect();
            agree(&planes);
        }
        let ball: Vec<Plane> = on_sphere(600).map(|normal| Plane::new(normal, 1.0)).collect();
        agree(&ball);
        // Two cones point to point with their bases cut off by a box: 300 planes through each tip, and all of them twice.
        let cone = |tip: f64| {
            (0..300).map(move |i| {
                let (sin, cos) = libm::sincos(f64::from(i) * std::f64::consts::TAU / 300.0);
                Plane::through(DVec3::Z * tip, DVec3::new(cos, sin, tip))
            })
        };
        let planes: Vec<Plane> = cone(0.8).chain(cone(-0.8)).chain(cone(0.8)).collect();
        agree(&planes);
        // Steps like those of a gem: many planes through one vertex on a ring.
        let ring = (0..600).map(|i| {
            let (sin, cos) = libm::sincos(f64::from(i / 3) * std::f64::consts::TAU / 200.0);
            let up = [-1.0, 0.0, 1.0][i as usize % 3];
            Plane::through(DVec3::new(cos, sin, 0.0), DVec3::new(cos, sin, up))
        });
        agree(&ring.collect::<Vec<_>>());
    }

    #[test]
    fn vertices_that_are_one_are_found_in_cells() {
        let mut points: Vec<DVec3> = on_sphere(700).map(|p| (p * 40.0).round() / 40.0).collect();
        points.extend(on_sphere(700).map(|p| (p * 40.0).round() / 40.0 + DVec3::splat(4e-4)));
        let slow: Vec<usize> = (0..points.len())
            .map(|i| (0..i).find(|&j| (points[i] - points[j]).length() <= 1e-3).unwrap_or(i))
            .collect();
        assert!(slow.iter().enumerate().any(|(i, &first)| first < i) && slow.iter().enumerate().any(|(i, &f)| f == i));
        assert_eq!(crowd::first_near(&points, 1e-3), slow);
    }

    #[test]
    fn crowds_of_planes_that_close_nothing_are_errors() {
        let half: Vec<Plane> = on_sphere(2000).filter(|n| n.z > 0.0).map(|normal| Plane::new(normal, 1.0)).collect();
        assert!(half.len() > CROWD);
        assert_eq!(Polyhedron::new(&half), Err(GeometryError::NoVolume), "open");
        let away: Vec<Plane> = on_sphere(2000).map(|normal| Plane::new(normal, -1.0)).collect();
        assert_eq!(Polyhedron::new(&away), Err(GeometryError::NoVolume), "empty");
    }
}
