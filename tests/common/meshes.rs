//! Closed meshes made by rule.

use glam::Vec3;
use spectrel::geometry::{Convex, Triangles};
use std::collections::HashMap;

/// A solid's facets as fans of triangles.
pub fn of_convex(solid: &Convex) -> Triangles {
    let fans = (0..solid.facets().len() as u32).flat_map(|facet| {
        let corners = solid.corners(facet);
        (1..corners.len() - 1).map(|k| [corners[0], corners[k], corners[k + 1]])
    });
    Triangles { positions: solid.vertices().to_vec(), indices: fans.collect(), ..Triangles::default() }
}

/// A ball of radius 1: an icosahedron whose triangles are cut in four `cuts` times.
pub fn icosphere(cuts: u32) -> Triangles {
    let phi = (1.0 + 5.0f64.sqrt()) / 2.0;
    let mut positions: Vec<glam::DVec3> = Vec::new();
    for (a, b) in [(-1.0, phi), (1.0, phi), (-1.0, -phi), (1.0, -phi)] {
        positions.push(glam::DVec3::new(a, b, 0.0).normalize());
    }
    for (a, b) in [(-1.0, phi), (1.0, phi), (-1.0, -phi), (1.0, -phi)] {
        positions.push(glam::DVec3::new(0.0, a, b).normalize());
    }
    for (a, b) in [(-1.0, phi), (1.0, phi), (-1.0, -phi), (1.0, -phi)] {
        positions.push(glam::DVec3::new(b, 0.0, a).normalize());
    }
    let mut indices: Vec<[u32; 3]> = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    for _ in 0..cuts {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                positions.push((positions[a as usize] + positions[b as usize]).normalize());
                positions.len() as u32 - 1
            })
        };
        indices = indices
            .iter()
            .flat_map(|&[a, b, c]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
            })
            .collect();
    }
    Triangles { positions: positions.iter().map(|p| p.as_vec3()).collect(), indices, ..Triangles::default() }
}

/// A ball whose corners are moved in and out by waves of this height.
pub fn blob(cuts: u32, height: f32) -> Triangles {
    let mut ball = icosphere(cuts);
    for p in &mut ball.positions {
        let wave = (7.0 * p.x + 1.0).sin() * (5.0 * p.y).cos() + (11.0 * p.z + 3.0 * p.x).sin();
        *p *= 1.0 + height * wave;
    }
    ball
}

/// A ring around z: a tube of radius `tube` around a circle of radius 1, with its smooth normals.
pub fn torus(around: u32, along: u32, tube: f32) -> Triangles {
    let mut ring = Triangles::default();
    for i in 0..around {
        let (sin, cos) = (i as f32 / around as f32 * std::f32::consts::TAU).sin_cos();
        for j in 0..along {
            let (height, out) = (j as f32 / along as f32 * std::f32::consts::TAU).sin_cos();
            let radius = 1.0 + tube * out;
            ring.positions.push(Vec3::new(radius * cos, radius * sin, tube * height));
            ring.normals.push(Vec3::new(out * cos, out * sin, height));
            let at = |i: u32, j: u32| (i % around) * along + j % along;
            ring.indices.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            ring.indices.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    ring
}
