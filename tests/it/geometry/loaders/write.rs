//! A unit cube in every format, and the small tools to write others.

use base64::Engine;
use serde_json::{Value, json};

pub const CUBE: [[f32; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
];

/// Counter-clockwise from outside.
pub const QUADS: [[u32; 4]; 6] = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

pub fn triangles() -> Vec<[u32; 3]> {
    QUADS.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
}

pub fn obj() -> String {
    let vertices = CUBE.map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat();
    let faces = QUADS.map(|quad| format!("f {} {} {} {}\n", quad[0] + 1, quad[1] + 1, quad[2] + 1, quad[3] + 1));
    vertices + &faces.concat()
}

pub fn ply_header(format: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment a cube\nelement vertex 8\nproperty float x\nproperty float y\n\
         property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n"
    )
}

pub fn ply_ascii() -> String {
    let vertices = CUBE.map(|[x, y, z]| format!("{x} {y} {z}\n")).concat();
    let faces = QUADS.map(|[a, b, c, d]| format!("4 {a} {b} {c} {d}\n")).concat();
    ply_header("ascii") + &vertices + &faces
}

pub fn ply_binary(big: bool) -> Vec<u8> {
    let mut bytes = ply_header(if big { "binary_big_endian" } else { "binary_little_endian" }).into_bytes();
    let mut word = |bits: u32| if big { bits.to_be_bytes() } else { bits.to_le_bytes() };
    for number in CUBE.as_flattened() {
        bytes.extend(word(number.to_bits()));
    }
    for quad in QUADS {
        bytes.push(4);
        bytes.extend(quad.map(&mut word).concat());
    }
    bytes
}

/// The facets of the cube with their corners.
fn facets() -> Vec<[[f32; 3]; 3]> {
    triangles().iter().map(|t| t.map(|i| CUBE[i as usize])).collect()
}

pub fn stl_ascii() -> String {
    let line = |[x, y, z]: [f32; 3]| format!("      vertex {x} {y} {z}\n");
    let facet = |corners: [[f32; 3]; 3]| {
        let corners = corners.map(line).concat();
        format!("  facet normal 0 0 0\n    outer loop\n{corners}    endloop\n  endfacet\n")
    };
    format!("solid a cube\n{}endsolid a cube\n", facets().into_iter().map(facet).collect::<String>())
}

pub fn stl_binary(head: &str, facets: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = head.as_bytes().to_vec();
    bytes.resize(80, b' ');
    bytes.extend((facets.len() as u32).to_le_bytes());
    for facet in facets {
        bytes.extend([0; 12]);
        bytes.extend(facet.as_flattened().iter().flat_map(|number| number.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

pub fn stl_cube(head: &str) -> Vec<u8> {
    stl_binary(head, &facets())
}

/// A buffer in the making, with its views and accessors.
#[derive(Default)]
pub struct Buffer {
    pub bytes: Vec<u8>,
    pub views: Vec<Value>,
    pub accessors: Vec<Value>,
}

impl Buffer {
    /// A view of the bytes; its number.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() }));
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.len() - 1
    }

    pub fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    pub fn floats<const N: usize>(&mut self, values: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = values.as_flattened().iter().flat_map(|number| number.to_le_bytes()).collect();
        let view = self.view(&bytes);
        let shape = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        self.accessor(json!({ "bufferView": view, "componentType": 5126, "count": values.len(), "type": shape }))
    }

    /// Indices of 1, 2 or 4 bytes.
    pub fn indices(&mut self, values: &[u32], size: usize) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()[..size].to_vec()).collect();
        let view = self.view(&bytes);
        let kind = [5121, 5123, 0, 5125][size - 1];
        self.accessor(json!({ "bufferView": view, "componentType": kind, "count": values.len(), "type": "SCALAR" }))
    }

    /// The document with everything that is not named in `rest` empty.
    pub fn document(&self, uri: Option<&str>, rest: Value) -> Value {
        let mut buffer = json!({ "byteLength": self.bytes.len() });
        if let Some(uri) = uri {
            buffer["uri"] = uri.into();
        }
        let mut root = json!({ "asset": { "version": "2.0" }, "buffers": [buffer] });
        root["bufferViews"] = self.views.clone().into();
        root["accessors"] = self.accessors.clone().into();
        for (key, value) in rest.as_object().unwrap() {
            root[key] = value.clone();
        }
        root
    }

    pub fn glb(&self, rest: Value) -> Vec<u8> {
        let mut json = self.document(None, rest).to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let length = 12 + 8 + json.len() + 8 + self.bytes.len();
        let word = |value: usize| (value as u32).to_le_bytes();
        let mut glb = [b"glTF".to_owned(), word(2), word(length), word(json.len()), b"JSON".to_owned()].concat();
        glb.extend(json);
        glb.extend([word(self.bytes.len()), b"BIN\0".to_owned()].concat());
        glb.extend(&self.bytes);
        glb
    }

    pub fn gltf(&self, rest: Value) -> Vec<u8> {
        let data = base64::engine::general_purpose::STANDARD.encode(&self.bytes);
        let uri = format!("data:application/octet-stream;base64,{data}");
        self.document(Some(&uri), rest).to_string().into_bytes()
    }
}

/// The cube in a buffer: its positions are accessor 0, its indices accessor 1.
pub fn cube_buffer() -> Buffer {
    let mut buffer = Buffer::default();
    buffer.floats(&CUBE);
    buffer.indices(triangles().as_flattened(), 2);
    buffer
}

/// One mesh, the cube, and these nodes; the scene shows node 0.
pub fn cube_on(nodes: Value) -> Value {
    json!({
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": nodes,
        "meshes": [{ "name": "Cube", "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
    })
}
