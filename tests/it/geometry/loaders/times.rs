//! How long a million triangles take: `cargo test --release --test it loaders::times -- --ignored --nocapture`.

use std::fmt::Write;
use std::time::Instant;

use super::write::Buffer;
use super::*;
use serde_json::json;

const ROUND: usize = 1000;
const ALONG: usize = 500;

/// A torus of 1 M triangles: position, normal and texture coordinates of its vertices.
fn torus() -> (Vec<[f32; 8]>, Vec<[u32; 3]>) {
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..ALONG {
        for j in 0..ROUND {
            let (u, v) = (i as f32 / ALONG as f32, j as f32 / ROUND as f32);
            let ((a, b), (c, d)) = ((u * 6.2831855).sin_cos(), (v * 6.2831855).sin_cos());
            vertices.push([b * (3.0 + d), a * (3.0 + d), c, b * d, a * d, c, u, v]);
            let at = |i: usize, j: usize| ((i % ALONG) * ROUND + j % ROUND) as u32;
            let [p, q, r, s] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[p, q, r], [p, r, s]]);
        }
    }
    (vertices, triangles)
}

fn obj(vertices: &[[f32; 8]], triangles: &[[u32; 3]], full: bool) -> Vec<u8> {
    let mut text = String::new();
    for [x, y, z, nx, ny, nz, u, v] in vertices {
        writeln!(text, "v {x} {y} {z}").unwrap();
        if full {
            writeln!(text, "vn {nx} {ny} {nz}\nvt {u} {v}").unwrap();
        }
    }
    for t in triangles {
        let [a, b, c] = t.map(|i| i + 1);
        if full {
            writeln!(text, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}").unwrap();
        } else {
            writeln!(text, "f {a} {b} {c}").unwrap();
        }
    }
    text.into_bytes()
}

fn ply(vertices: &[[f32; 8]], triangles: &[[u32; 3]], format: &str) -> Vec<u8> {
    let names = ["x", "y", "z", "nx", "ny", "nz", "u", "v"].map(|name| format!("property float {name}\n")).concat();
    let (v, f) = (vertices.len(), triangles.len());
    let mut bytes = format!(
        "ply\nformat {format} 1.0\nelement vertex {v}\n{names}element face {f}\n\
         property list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    if format == "ascii" {
        let mut text = String::new();
        for [x, y, z, nx, ny, nz, u, v] in vertices {
            writeln!(text, "{x} {y} {z} {nx} {ny} {nz} {u} {v}").unwrap();
        }
        for [a, b, c] in triangles {
            writeln!(text, "3 {a} {b} {c}").unwrap();
        }
        bytes.extend(text.into_bytes());
        return bytes;
    }
    bytes.extend(vertices.as_flattened().iter().flat_map(|number| number.to_le_bytes()));
    for t in triangles {
        bytes.push(3);
        bytes.extend(t.iter().flat_map(|i| i.to_le_bytes()));
    }
    bytes
}

fn glb(vertices: &[[f32; 8]], triangles: &[[u32; 3]]) -> Vec<u8> {
    let mut buffer = Buffer::default();
    buffer.floats(&vertices.iter().map(|v| [v[0], v[1], v[2]]).collect::<Vec<_>>());
    buffer.floats(&vertices.iter().map(|v| [v[3], v[4], v[5]]).collect::<Vec<_>>());
    buffer.floats(&vertices.iter().map(|v| [v[6], v[7]]).collect::<Vec<_>>());
    buffer.indices(triangles.as_flattened(), 4);
    let attributes = json!({ "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 });
    buffer.glb(json!({ "nodes": [{ "mesh": 0 }],
                       "meshes": [{ "primitives": [{ "attributes": attributes, "indices": 3 }] }] }))
}

#[test]
#[ignore = "long: measures"]
fn load_times() {
    let (vertices, triangles) = torus();
    let point = |i: u32| [0, 1, 2].map(|axis| vertices[i as usize][axis]);
    let facets: Vec<_> = triangles.iter().map(|t| t.map(point)).collect();
    let files = [
        ("OBJ, positions", "obj", obj(&vertices, &triangles, false)),
        ("OBJ, with normals and texture coordinates", "obj", obj(&vertices, &triangles, true)),
        ("PLY, text", "ply", ply(&vertices, &triangles, "ascii")),
        ("PLY, binary", "ply", ply(&vertices, &triangles, "binary_little_endian")),
        ("STL, binary", "stl", super::write::stl_binary("", &facets)),
        ("GLB", "glb", glb(&vertices, &triangles)),
    ];
    let folder = tempfile::tempdir().unwrap();
    for (name, extension, bytes) in files {
        let path = folder.path().join(format!("torus.{extension}"));
        fs::write(&path, &bytes).unwrap();
        let mut seconds: Vec<f64> = (0..5)
            .map(|_| {
                let start = Instant::now();
                let file = load(&path).unwrap();
                assert_eq!(file.parts[0].triangles.indices.len(), 2 * ROUND * ALONG);
                assert_eq!(file.parts[0].triangles.positions.len(), ROUND * ALONG);
                start.elapsed().as_secs_f64()
            })
            .collect();
        seconds.sort_by(f64::total_cmp);
        println!("| {name} | {:.0} | {:.2} |", bytes.len() as f64 / 1e6, seconds[2]);
    }
}
