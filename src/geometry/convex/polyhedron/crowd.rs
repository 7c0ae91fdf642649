//! Solids of many planes: the same cuts as in [`polyhedron`](super), which visit only what a plane touches.
//!
//! Planes come in rounds, each twice as large as the one before and in the order of a curve through all directions (N. Amenta, S. Choi
//! and G. Rote, "Incremental constructions con BRIO", SoCG 2003). So vertices that are stored beside each other lie beside each other,
//! and a box around them tells whether a plane touches any. Faces none of whose corners it touches are not looked at. 20,000 planes
//! around a ball take less than a second instead of 40 s. Slots of what a plane cuts away are used again; a vertex that is gone is
//! no number, and no plane touches it.

use std::collections::HashMap;

use super::{Cutter, Face, Place, Plane, sort_around};
use crate::geometry::GeometryError;
use glam::DVec3;

/// Solids of more planes than this are cut here: below it both ways take milliseconds.
pub(super) const CROWD: usize = 512;

/// Vertices with one box around them.
const TOGETHER: usize = 32;

/// No face.
const GONE: usize = usize::MAX - 1;

struct Crowd {
    vertices: Vec<DVec3>,
    /// Around each `TOGETHER` vertices, those that are gone included.
    boxes: Vec<[DVec3; 2]>,
    /// The faces at each vertex.
    around: Vec<Vec<usize>>,
    free: Vec<usize>,
    /// Of each vertex, how the plane that cuts lies to it; `In` where it is not touched.
    places: Vec<Place>,
    /// Of each vertex, whether it already is a corner of the new face.
    in_rim: Vec<bool>,
    faces: Vec<Face>,
    alive: usize,
    tolerance: f64,
}

/// Cuts a cube by planes one after another.
pub(super) fn cut(mut cutter: Cutter, planes: &[Plane]) -> Result<Cutter, GeometryError> {
    let mut crowd = Crowd::of(&mut cutter);
    for index in order(planes) {
        crowd.cut(&planes[index], index);
        if crowd.alive < 4 {
            return Err(GeometryError::NoVolume);
        }
    }
    cutter.vertices = crowd.vertices;
    cutter.faces = crowd.faces;
    cutter.faces.retain(|face| face.plane != GONE);
    cutter.compact();
    Ok(cutter)
}

/// The order in which planes cut. Of planes that are equal the first one comes first.
fn order(planes: &[Plane]) -> Vec<usize> {
    let round = |plane: &Plane| {
        let [x, y, z] = plane.normal.to_array();
        let mix =
            |code: u64, number: f64| (code ^ number.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
        [x, y, z, plane.offset].into_iter().fold(0, mix).leading_zeros()
    };
    let place = |plane: &Plane| {
        let [x, y, z] = plane.normal.to_array().map(|axis| ((axis + 1.0) * 511.5) as u32);
        (0..10).rev().fold(0, |code, bit| code << 3 | (x >> bit & 1) << 2 | (y >> bit & 1) << 1 | (z >> bit & 1))
    };
    let mut order: Vec<usize> = (0..planes.len()).collect();
    order.sort_by_cached_key(|&index| (std::cmp::Reverse(round(&planes[index])), place(&planes[index])));
    order
}

impl Crowd {
    fn of(cutter: &mut Cutter) -> Self {
        let mut crowd = Self {
            vertices: Vec::new(),
            boxes: Vec::new(),
            around: Vec::new(),
            free: Vec::new(),
            places: Vec::new(),
            in_rim: Vec::new(),
            faces: Vec::new(),
            alive: 0,
            tolerance: cutter.tolerance,
        };
        for &vertex in &cutter.vertices {
            crowd.add_vertex(vertex);
        }
        std::mem::take(&mut cutter.faces).into_iter().for_each(|face| crowd.add_face(face));
        crowd
    }

    fn add_vertex(&mut self, p: DVec3) -> usize {
        let index = self.free.pop().unwrap_or_else(|| {
            self.vertices.push(p);
            self.around.push(Vec::new());
            self.places.push(Place::In);
            self.in_rim.push(false);
            self.vertices.len() - 1
        });
        if self.boxes.len() == index / TOGETHER {
            self.boxes.push([p, p]);
        }
        let [min, max] = &mut self.boxes[index / TOGETHER];
        (*min, *max) = (min.min(p), max.max(p));
        self.vertices[index] = p;
        index
    }

    fn forget(&mut self, vertex: usize) {
        self.vertices[vertex] = DVec3::NAN;
        self.around[vertex].clear();
        self.free.push(vertex);
    }

    fn add_face(&mut self, face: Face) {
        for &corner in &face.corners {
            self.around[corner].push(self.faces.len());
        }
        self.faces.push(face);
        self.alive += 1;
    }

    /// The vertices that are not clearly behind a plane.
    fn touched(&self, plane: &Plane) -> Vec<usize> {
        let least = -self.tolerance;
        let mut touched = Vec::new();
        for (number, &[min, max]) in self.boxes.iter().enumerate() {
            // Monotone in each coordinate, roundings included: no vertex of the box is higher.
            let farthest = DVec3::select(plane.normal.cmpgt(DVec3::ZERO), max, min);
            if plane.height(farthest) >= least {
                let start = number * TOGETHER;
                let end = self.vertices.len().min(start + TOGETHER);
                touched.extend((start..end).filter(|&vertex| plane.height(self.vertices[vertex]) >= least));
            }
        }
        touched
    }

    /// Takes away what lies in front of the plane.
    fn cut(&mut self, plane: &Plane, index: usize) {
        let touched = self.touched(plane);
        let out = |crowd: &Self, vertex: usize| plane.height(crowd.vertices[vertex]) > crowd.tolerance;
        if !touched.iter().any(|&vertex| out(self, vertex)) {
            return;
        }
        for &vertex in &touched {
            self.places[vertex] = if out(self, vertex) { Place::Out } else { Place::On };
        }
        let mut near: Vec<usize> = touched.iter().flat_map(|&vertex| self.around[vertex].iter().copied()).collect();
        near.sort_unstable();
        near.dedup();
        let mut rim = Vec::new();
        let mut halved = HashMap::new();
        for face in near {
            self.clip(face, plane, &mut rim, &mut halved);
        }
        for &vertex in &rim {
            self.in_rim[vertex] = false;
        }
        for vertex in touched {
            let is_out = std::mem::replace(&mut self.places[vertex], Place::In) == Place::Out;
            if is_out || (self.around[vertex].is_empty() && !rim.contains(&vertex)) {
                self.forget(vertex);
            }
        }
        if rim.len() >= 3 {
            sort_around(|corner| self.vertices[corner], &mut rim, plane.normal);
            self.add_face(Face { plane: index, corners: rim });
        }
    }

    /// Leaves of a face what is not in front of the plane, and gathers the corners of the new face.
    fn clip(&mut self, face: usize, plane: &Plane, rim: &mut Vec<usize>, halved: &mut HashMap<[usize; 2], usize>) {
        let old = std::mem::take(&mut self.faces[face].corners);
        let mut corners = Vec::with_capacity(old.len() + 1);
        if old.iter().any(|&corner| self.places[corner] == Place::In) {
            for (&a, &b) in old.iter().zip(old.iter().skip(1).chain(old.first())) {
                if self.places[a] == Place::In && self.places[b] == Place::In {
                    corners.push(a);
                    continue;
                }
                if self.places[a] != Place::Out {
                    corners.push(a);
                }
                if self.places[a] == Place::On && !std::mem::replace(&mut self.in_rim[a], true) {
                    rim.push(a);
                }
                let crosses =
                    matches!((self.places[a], self.places[b]), (Place::In, Place::Out) | (Place::Out, Place::In));
                if crosses {
                    let vertex = self.halve([a.min(b), a.max(b)], plane, rim, halved);
                    self.around[vertex].push(face);
                    corners.push(vertex);
                }
            }
        }
        if corners.len() < 3 {
            for corner in old.into_iter().chain(corners.drain(..)) {
                self.around[corner].retain(|&other| other != face);
            }
            self.faces[face].plane = GONE;
            self.alive -= 1;
        }
        self.faces[face].corners = corners;
    }

    /// The vertex where a plane halves an edge, the same for both of its faces.
    fn halve(
        &mut self,
        edge: [usize; 2],
        plane: &Plane,
        rim: &mut Vec<usize>,
        halved: &mut HashMap<[usize; 2], usize>,
    ) -> usize {
        if let Some(&vertex) = halved.get(&edge) {
            return vertex;
        }
        let [p, q] = edge.map(|end| self.vertices[end]);
        let (hp, hq) = (plane.height(p), plane.height(q));
        let vertex = self.add_vertex(p + (q - p) * (hp / (hp - hq)));
        halved.insert(edge, vertex);
        rim.push(vertex);
        self.in_rim[vertex] = true;
        vertex
    }
}

/// Of each vertex the first one that is no farther from it than `near`: itself, or one before it. Looked up in cells as wide.
pub(super) fn first_near(vertices: &[DVec3], near: f64) -> Vec<usize> {
    let cell = |p: DVec3| ((p - vertices[0]) / near).floor().to_array().map(|axis| axis as i64);
    let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    let mut first = Vec::with_capacity(vertices.len());
    for (i, &vertex) in vertices.iter().enumerate() {
        let [x, y, z] = cell(vertex);
        let around = (0..27).map(|k| [x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1]);
        let found = around
            .filter_map(|cell| cells.get(&cell)?.iter().copied().find(|&j| (vertex - vertices[j]).length() <= near));
        first.push(found.min().unwrap_or(i));
        cells.entry([x, y, z]).or_default().push(i);
    }
    first
}
