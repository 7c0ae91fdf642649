//! Normals for meshes that bring none, or the wrong ones.
//!
//! Each corner of a triangle gets the mean of the normals of the triangles around it that bend away from its own by less
//! than the crease angle, weighted by their angles at the corner (G. Thürmer, C. A. Wüthrich, "Computing Vertex Normals
//! from Polygonal Facets", J. Graphics Tools 3(1), 1998), so that how a face is cut into triangles does not matter.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::closed::weld;
use crate::geometry::Triangles;

/// A corner of more triangles than this is a tip and stays as it is: each of them would have to look at all others.
const MOST: usize = 10_000;

/// So many normals of a corner are looked through for the same one; a corner too many does no harm.
const LOOKS: usize = 64;

impl Triangles {
    /// The same surface with normals that are smooth across edges which bend by less than an angle in degrees; without
    /// normals at 0. Corners are parted where normals differ. A mesh that names corners it does not have stays as it is.
    pub fn smoothed(self, crease_degrees: f64) -> Self {
        if crease_degrees <= 0.0 {
            return Self { normals: Vec::new(), ..self };
        }
        if self.indices.iter().flatten().any(|&index| index as usize >= self.positions.len()) {
            return self;
        }
        let least_cosine = libm::cos(crease_degrees.to_radians());
        let faces: Vec<DVec3> = self.indices.par_iter().map(|triangle| self.face_normal(triangle)).collect();
        let around = Around::of(&self);
        let normal = |face: usize, index: u32| {
            if around.faces(index).len() > MOST {
                return faces[face].as_vec3();
            }
            let near = around.faces(index).iter();
            let smooth = near.filter(|(other, _)| faces[*other as usize].dot(faces[face]) > least_cosine);
            let sum: DVec3 = smooth.map(|&(other, angle)| faces[other as usize] * angle).sum();
            sum.try_normalize().unwrap_or(faces[face]).as_vec3()
        };
        let normals: Vec<[Vec3; 3]> = (self.indices.par_iter().enumerate())
            .map(|(face, triangle)| triangle.map(|index| normal(face, index)))
            .collect();
        let mut parted = Parted::new(&self);
        for (triangle, normals) in self.indices.iter().zip(normals) {
            let indices = [0, 1, 2].map(|corner| parted.corner(triangle[corner], normals[corner]));
            parted.made.indices.push(indices);
        }
        parted.made
    }

    /// Zero for a triangle without area.
    fn face_normal(&self, triangle: &[u32; 3]) -> DVec3 {
        let [a, b, c] = triangle.map(|index| self.positions[index as usize].as_dvec3());
        (b - a).cross(c - a).normalize_or_zero()
    }

    fn angle(&self, triangle: &[u32; 3], corner: usize) -> f64 {
        let [a, b, c] = [0, 1, 2].map(|k| self.positions[triangle[(corner + k) % 3] as usize].as_dvec3());
        libm::atan2((b - a).cross(c - a).length(), (b - a).dot(c - a))
    }
}

/// The triangles around each corner with their angles there, those of a corner side by side.
struct Around {
    welded: Vec<u32>,
    faces: Vec<(u32, f64)>,
    /// Where those of each corner begin in `faces`, and where the last ones end.
    firsts: Vec<u32>,
}

impl Around {
    fn of(mesh: &Triangles) -> Self {
        let welded = weld(&mesh.positions);
        let mut firsts = vec![0; mesh.positions.len() + 1];
        for &index in mesh.indices.iter().flatten() {
            firsts[welded[index as usize] as usize] += 1;
        }
        let mut sum = 0;
        for first in &mut firsts {
            sum += *first;
            *first = sum;
        }
        let mut faces = vec![(0, 0.0); sum as usize];
        // From the back, so that those of a corner end up in the order of their numbers.
        for (face, triangle) in mesh.indices.iter().enumerate().rev() {
            for corner in (0..3).rev() {
                let place = &mut firsts[welded[triangle[corner] as usize] as usize];
                *place -= 1;
                faces[*place as usize] = (face as u32, mesh.angle(triangle, corner));
            }
        }
        Self { welded, faces, firsts }
    }

    fn faces(&self, index: u32) -> &[(u32, f64)] {
        let corner = self.welded[index as usize] as usize;
        &self.faces[self.firsts[corner] as usize..self.firsts[corner + 1] as usize]
    }
}

/// A mesh whose corners are made anew where they have more than one normal.
struct Parted<'a> {
    of: &'a Triangles,
    /// For each corner of the old mesh, the last one made of it; for each new one, the one made before of the same.
    last: Vec<u32>,
    before: Vec<u32>,
    made: Triangles,
}

/// No corner.
const NONE: u32 = u32::MAX;

impl<'a> Parted<'a> {
    fn new(of: &'a Triangles) -> Self {
        Self { of, last: vec![NONE; of.positions.len()], before: Vec::new(), made: Triangles::default() }
    }

    fn corner(&mut self, index: u32, normal: Vec3) -> u32 {
        let (of, made) = (self.of, &mut self.made);
        let index = index as usize;
        let mut known = self.last[index];
        for _ in 0..LOOKS {
            if known == NONE {
                break;
            }
            if made.normals[known as usize].to_array().map(f32::to_bits) == normal.to_array().map(f32::to_bits) {
                return known;
            }
            known = self.before[known as usize];
        }
        let new = made.positions.len() as u32;
        made.positions.push(of.positions[index]);
        made.normals.push(normal);
        made.uvs.extend(of.uvs.get(index));
        self.before.push(self.last[index]);
        self.last[index] = new;
        new
    }
}
