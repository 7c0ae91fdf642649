//! Lengths and axes of mesh files in the scene's.

use crate::common::command::{self, run};
use crate::common::{film, library, mean};
use glam::Vec3;
use serde_json::json;
use spectrel::geometry::Bounds;
use spectrel::scene::{Overrides, Scene, SceneError, Text, resolve};
use std::fs;
use std::path::Path;

/// A box of 4 × 6 × 8 around (1, 0, 0), in three axes of which the second is up in glTF, scaled.
fn corners(scale: f32) -> [[f32; 3]; 8] {
    std::array::from_fn(|i| {
        let at = |axis: usize, half: f32| if i >> axis & 1 == 1 { half } else { -half };
        [1.0 + at(0, 2.0), at(1, 3.0), at(2, 4.0)].map(|x| x * scale)
    })
}

const FACES: [[u32; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

fn obj(scale: f32) -> String {
    let vertices = corners(scale).map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat();
    vertices + &FACES.map(|face| format!("f {}\n", face.map(|i| (i + 1).to_string()).join(" "))).concat()
}

/// The same in metres of a file whose unit is the millimetre, with a camera 40 mm in front of it that sees 10 mm.
fn gltf(folder: &Path) {
    let triangles = FACES.iter().flat_map(|&[a, b, c, d]| [a, b, c, a, c, d]);
    let numbers = triangles.flat_map(|i| corners(1e-3)[i as usize]);
    let bytes: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
    let file = json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0, 1] }],
        "nodes": [{ "mesh": 0 }, { "camera": 0, "translation": [0.001, 0, 0.04] }],
        "cameras": [{ "name": "Front", "type": "orthographic", "orthographic": { "xmag": 0.005, "ymag": 0.005, "znear": 0, "zfar": 9 } }],
        "meshes": [{ "name": "Box", "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 36, "type": "VEC3" }],
        "bufferViews": [{ "buffer": 0, "byteLength": bytes.len() }],
        "buffers": [{ "uri": "box.bin", "byteLength": bytes.len() }]
    });
    fs::write(folder.join("box.bin"), bytes).expect("a file");
    fs::write(folder.join("box.gltf"), file.to_string()).expect("a file");
}

const CAMERA: &str = "camera = { position = [1, -40, 0], look_at = [1, 0, 0], orthographic_width = 10 }\n";

fn scene(head: &str, object: &str) -> Result<Scene, SceneError> {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("box.obj"), obj(1.0)).expect("a file");
    gltf(folder.path());
    let text = format!(
        "{head}\nrender = {{ width = 12, height = 12, samples = 64 }}
        environment.constant = {{ spectrum = \"D65\", luminance = 100 }}
        [[objects]]\nmaterial = \"ruby\"\n{object}\n"
    );
    resolve(Text::new(folder.path().join("scene.toml"), text), &library(), &Overrides::default())
}

fn bounds(head: &str, object: &str) -> Bounds {
    scene(&format!("{head}{CAMERA}"), object).unwrap_or_else(|error| panic!("{error}")).world.bounds()
}

fn stands(found: Bounds, center: Vec3, size: Vec3, what: &str) {
    let near = |a: Vec3, b: Vec3| (a - b).length() < 1e-5 * size.length();
    assert!(near(found.center(), center) && near(found.size(), size), "{what}: {found:?}");
}

#[test]
fn lengths_and_axes_of_files_become_those_of_the_scene() {
    let (up, deep) = (Vec3::new(4.0, 8.0, 6.0), Vec3::new(4.0, 6.0, 8.0));
    for (head, object, center, size) in [
        ("meters_per_unit = 0.001\n", "shape.mesh.file = \"box.gltf\"", 1.0, up),
        ("meters_per_unit = 0.01\n", "shape.mesh.file = \"box.gltf\"", 0.1, up / 10.0),
        ("meters_per_unit = 1\n", "shape.mesh.file = \"box.gltf\"", 1e-3, up / 1e3),
        (
            "meters_per_unit = 0.001\n",
            "shape.mesh = { file = \"box.gltf\", unit = \"cm\", up = \"z\" }",
            0.01,
            deep / 100.0,
        ),
        ("meters_per_unit = 0.01\n", "shape.mesh.file = \"box.obj\"", 1.0, deep),
        ("meters_per_unit = 0.01\n", "shape.mesh = { file = \"box.obj\", unit = \"mm\", up = \"y\" }", 0.1, up / 10.0),
        ("meters_per_unit = 0.001\n", "shape.mesh = { file = \"box.obj\", unit = \"in\" }", 25.4, deep * 25.4),
        (
            "meters_per_unit = 0.001\n",
            "shape.mesh = { file = \"box.obj\", unit = \"m\" }\ntransform.scale = 0.5",
            500.0,
            deep * 500.0,
        ),
    ] {
        stands(bounds(head, object), Vec3::X * center, size, &format!("{head}{object}"));
    }
    let error = scene(CAMERA, "shape.mesh = { file = \"box.obj\", unit = \"mm\" }").expect_err("no unit").to_string();
    assert!(error.contains("add `meters_per_unit = …`"), "{error}");
    let error = scene(CAMERA, "shape.mesh = { file = \"box.obj\", unit = \"km\" }").expect_err("km").to_string();
    assert!(error.contains("`mm`"), "{error}");
}

/// A ruby absorbs by its thickness in millimetres, wherever its size comes from.
#[test]
fn a_ruby_of_a_gltf_file_is_as_red_as_one_of_the_scene() {
    let head = "meters_per_unit = 0.001\n";
    let own = "shape.box = { center = [1, 0, 0], size = [4, 8, 6] }";
    let look = |camera: &str, object: &str| {
        mean(&film(&scene(&format!("{head}{camera}"), object).unwrap_or_else(|error| panic!("{error}"))))
    };
    let expected = look(CAMERA, own);
    assert!(expected[1] < 85.0, "it absorbs: {expected:?}");
    let filed = "camera.file = \"box.gltf\"\n";
    for (camera, object) in [
        (filed, "shape.mesh.file = \"box.gltf\""),
        (filed, own),
        (CAMERA, "shape.mesh.file = \"box.gltf\""),
        (CAMERA, "shape.mesh = { file = \"box.obj\", unit = \"mm\", up = \"y\" }"),
    ] {
        let found = look(camera, object);
        let off = found.iter().zip(expected).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
        assert!(off < 1e-2, "{camera}{object}: {found:?} {expected:?}");
    }
}

/// A cube of 6 mm around the zero of a glTF file, in metres as glTF has them.
fn cube(folder: &Path) {
    let triangles = FACES.iter().flat_map(|&[a, b, c, d]| [a, b, c, a, c, d]);
    let corner = |i: u32| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { 0.003f32 } else { -0.003 });
    let bytes: Vec<u8> = triangles.flat_map(corner).flat_map(f32::to_le_bytes).collect();
    let file = json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
        "meshes": [{ "name": "Cube", "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 36, "type": "VEC3" }],
        "bufferViews": [{ "buffer": 0, "byteLength": bytes.len() }],
        "buffers": [{ "uri": "cube.bin", "byteLength": bytes.len() }]
    });
    fs::write(folder.join("cube.bin"), bytes).expect("a file");
    fs::write(folder.join("cube.gltf"), file.to_string()).expect("a file");
}

/// Linear sRGB of a ruby in white light, seen straight through: as its file says, and as if its metres were the scene's millimetres,
/// which made it a thousandth of its size and hid that it absorbs.
#[test]
fn a_ruby_of_six_millimetres_is_red_and_one_of_six_micrometres_is_clear() {
    let folder = tempfile::tempdir().expect("a folder");
    cube(folder.path());
    let look = |width: f64, mesh: &str| {
        let text = format!(
            "meters_per_unit = 0.001\nrender = {{ width = 16, height = 16, samples = 256 }}
            camera = {{ position = [0, -40, 0], look_at = [0, 0, 0], orthographic_width = {width} }}
            environment.constant = {{ spectrum = \"D65\", luminance = 100 }}
            [[objects]]\nmaterial = \"ruby\"\nshape.mesh = {mesh}\n"
        );
        let scene = resolve(Text::new(folder.path().join("scene.toml"), text), &library(), &Overrides::default());
        let [x, y, z] = mean(&film(&scene.expect("a scene"))).map(|value| value / 100.0);
        // IEC 61966-2-1.
        [
            3.240970 * x - 1.537383 * y - 0.498611 * z,
            -0.969244 * x + 1.875968 * y + 0.041555 * z,
            0.055630 * x - 0.203977 * y + 1.056972 * z,
        ]
    };
    for (width, mesh, expected) in [
        (4.0, "{ file = \"cube.gltf\" }", [0.474, 0.090, 0.124]),
        (0.004, "{ file = \"cube.gltf\", unit = \"mm\" }", [0.998, 0.996, 0.997]),
    ] {
        let found = look(width, mesh);
        let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 5e-3, "{mesh}: {found:?} {expected:?}");
    }
}

#[test]
fn inspect_tells_size_and_place_of_a_mesh_in_units_and_in_millimetres() {
    let camera = "[camera]\nposition = [0, -40, 0]\nlook_at = [0, 0, 0]\nfov = 30\n";
    let light = "[environment.constant]\nspectrum = \"D65\"\nluminance = 100\n";
    let object = "[[objects]]\nname = \"cube\"\nmaterial = \"gold\"\nshape.mesh.file = \"cube.gltf\"\n\
        transform.translate = [1, 0, 0.5]\n";
    for (head, says) in [
        ("meters_per_unit = 0.01\n", "cube  0.6 × 0.6 × 0.6 at (1, 0, 0.5); in mm 6 × 6 × 6 at (10, 0, 5)"),
        ("", "cube  0.006 × 0.006 × 0.006 at (1, 0, 0.5)\n"),
    ] {
        let folder = command::folder(&[("a.toml", &format!("{head}{camera}{light}{object}"))]);
        cube(folder.path());
        let text = String::from_utf8(run(folder.path(), &["inspect", "a.toml"]).stdout).expect("text");
        assert!(text.contains("Meshes, scene units\n") && text.contains(says), "{says:?} is not in\n{text}");
    }
}
