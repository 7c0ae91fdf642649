//! From half-spaces to vertices, facets and edges, in double precision.
//!
//! A large cube is cut by one plane after another. Vertices are shared and each is judged once against each plane (in, on
//! or out), so that many planes may pass through one vertex, as they do all over a gem, and facets still fit together.

use glam::DVec3;

use crate::geometry::GeometryError;

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
    fn normalised(&self) -> Option<Self> {
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
        let mut cutter = Self::cube(center, half, TOLERANCE * size);
        for (index, plane) in planes.iter().enumerate() {
            cutter.cut(plane, index);
            if cutter.faces.len() < 4 {
                return Err(GeometryError::NoVolume);
            }
        }
        if cutter.faces.iter().any(|f| f.plane == CUBE) {
            return Err(GeometryError::NoVolume);
        }
        Ok(cutter)
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
            self.sort_around(&mut rim, plane.normal);
            kept.push(Face { plane: index, corners: rim });
        }
        self.faces = kept;
        self.compact();
    }

    /// The corners of a convex polygon in their order around the normal.
    fn sort_around(&self, corners: &mut [usize], normal: DVec3) {
        let mean = corners.iter().map(|&c| self.vertices[c]).sum::<DVec3>() / corners.len() as f64;
        let axis = if normal.x.abs() < 0.6 { DVec3::X } else { DVec3::Y };
        let u = normal.cross(axis).normalize_or_zero();
        let v = normal.cross(u);
        let angle = |c: usize| {
            let w = self.vertices[c] - mean;
            libm::atan2(w.dot(v), w.dot(u))
        };
        corners.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
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
        let first: Vec<usize> = (0..self.vertices.len())
            .map(|i| (0..i).find(|&j| (self.vertices[i] - self.vertices[j]).length() <= near).unwrap_or(i))
            .collect();
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

/// Area of a plane polygon.
pub(super) fn area(vertices: &[DVec3], corners: &[usize]) -> f64 {
    let fan = corners.windows(2).map(|pair| {
        let [a, b, c] = [corners[0], pair[0], pair[1]].map(|i| vertices[i]);
        (b - a).cross(c - a)
    });
    0.5 * fan.sum::<DVec3>().length()
}
