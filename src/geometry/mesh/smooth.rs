//! Normals for meshes that bring none, or the wrong ones.
//!
//! Each corner of a triangle gets the mean of the normals of the triangles around it that bend away from its own by less
//! than the crease angle, weighted by their angles at the corner (G. Thürmer, C. A. Wüthrich, "Computing Vertex Normals
//! from Polygonal Facets", J. Graphics Tools 3(1), 1998), so that how a face is cut into triangles does not matter.

use std::collections::HashMap;

use glam::DVec3;

use super::closed::weld;
use crate::geometry::Triangles;

impl Triangles {
    /// The same surface with normals that are smooth across edges which bend by less than an angle in degrees; without
    /// normals at 0. Corners are parted where normals differ.
    pub fn smoothed(self, crease_degrees: f64) -> Self {
        if crease_degrees <= 0.0 {
            return Self { normals: Vec::new(), ..self };
        }
        let least_cosine = libm::cos(crease_degrees.to_radians());
        let welded = weld(&self.positions);
        let faces: Vec<DVec3> = self.indices.iter().map(|triangle| self.face_normal(triangle)).collect();
        let mut around: Vec<Vec<(u32, f64)>> = vec![Vec::new(); self.positions.len()];
        for (face, triangle) in (0..).zip(&self.indices) {
            for corner in 0..3 {
                around[welded[triangle[corner] as usize] as usize].push((face, self.angle(triangle, corner)));
            }
        }
        let mut parted = Parted { of: &self, known: HashMap::new(), made: Self::default() };
        for (face, triangle) in faces.iter().zip(&self.indices) {
            let corner = |&index: &u32| {
                let near = around[welded[index as usize] as usize].iter();
                let smooth = near.filter(|(other, _)| faces[*other as usize].dot(*face) > least_cosine);
                let sum: DVec3 = smooth.map(|&(other, angle)| faces[other as usize] * angle).sum();
                (index, sum.try_normalize().unwrap_or(*face))
            };
            let corners = [corner(&triangle[0]), corner(&triangle[1]), corner(&triangle[2])];
            let indices = corners.map(|(index, normal)| parted.corner(index, normal));
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

/// A mesh whose corners are made anew where they have more than one normal.
struct Parted<'a> {
    of: &'a Triangles,
    known: HashMap<(u32, [u32; 3]), u32>,
    made: Triangles,
}

impl Parted<'_> {
    fn corner(&mut self, index: u32, normal: DVec3) -> u32 {
        let normal = normal.as_vec3();
        let (of, made) = (self.of, &mut self.made);
        *self.known.entry((index, normal.to_array().map(f32::to_bits))).or_insert_with(|| {
            made.positions.push(of.positions[index as usize]);
            made.normals.push(normal);
            made.uvs.extend(of.uvs.get(index as usize));
            made.positions.len() as u32 - 1
        })
    }
}
