//! What glTF has of its own.

use std::f64::consts::FRAC_1_SQRT_2;

use super::write::{Buffer, CUBE, cube_buffer, cube_on};
use super::*;
use serde_json::{Value, json};

/// A scene of one node that shows one primitive.
fn alone(primitive: Value) -> Value {
    json!({ "nodes": [{ "mesh": 0 }], "meshes": [{ "primitives": [primitive] }] })
}

fn triangles_of(buffer: &Buffer, primitive: Value) -> Triangles {
    loaded("glb", buffer.glb(alone(primitive))).parts[0].triangles.clone()
}

/// A square in four corners, counter-clockwise about z in the order of a strip.
const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];

#[test]
fn nested_nodes_stand_where_they_stand_on_paper() {
    let h = FRAC_1_SQRT_2;
    let nodes = json!([
        { "translation": [1, 2, 3], "rotation": [0, h, 0, h], "scale": [2, 2, 2], "children": [1] },
        { "name": "inner", "translation": [0, 0, 1], "scale": [1, 3, 1], "mesh": 0 },
    ]);
    let file = loaded("glb", cube_buffer().glb(cube_on(nodes)));
    assert_eq!((file.placements[0].name.as_str(), file.parts[0].name.as_str()), ("inner", "Cube"));
    let at = |x, y, z| file.placements[0].transform.transform_point3(DVec3::new(x, y, z));
    // (1,0,0) → (1,0,1) → (2,0,2) → a quarter turn about y (2,0,−2) → (3,2,1), which is (3,−1,2) with z upwards.
    let expected = [
        (at(0.0, 0.0, 0.0), DVec3::new(3.0, -3.0, 2.0)),
        (at(1.0, 0.0, 0.0), DVec3::new(3.0, -1.0, 2.0)),
        (at(0.0, 1.0, 0.0), DVec3::new(3.0, -3.0, 8.0)),
        (at(0.0, 0.0, 1.0), DVec3::new(5.0, -3.0, 2.0)),
    ];
    for (found, expected) in expected {
        assert!((found - expected).length() < 1e-14, "{found} {expected}");
    }
    assert!((volume(&placed(&file)) - 24.0).abs() < 1e-12);
    // The same as matrices, by columns.
    let nodes = json!([
        { "matrix": [0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 1, 2, 3, 1], "children": [1] },
        { "matrix": [1, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1], "mesh": 0 },
    ]);
    let matrices = loaded("glb", cube_buffer().glb(cube_on(nodes)));
    let (a, b) = (placed(&file), placed(&matrices));
    assert!(a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (*a - *b).length() < 1e-14));
    // A quaternion that the file rounded is still a rotation.
    let nodes = json!([{ "mesh": 0, "rotation": [0, 0.71, 0, 0.71] }]);
    assert!((volume(&placed(&loaded("glb", cube_buffer().glb(cube_on(nodes))))) - 1.0).abs() < 1e-12);
}

#[test]
fn one_mesh_on_three_nodes_is_one_part() {
    let nodes = json!([
        { "children": [1, 2] },
        { "name": "b", "mesh": 0, "translation": [5, 0, 0], "children": [3] },
        { "mesh": 0, "scale": [-1, 1, 1] },
        { "name": "d", "mesh": 0, "translation": [0, 0, -7] },
        { "name": "in no scene", "mesh": 0 },
    ]);
    let file = loaded("glb", cube_buffer().glb(cube_on(nodes)));
    assert_eq!((file.parts.len(), file.placements.len()), (1, 3));
    let places: Vec<_> = file.placements.iter().map(|p| (p.name.as_str(), p.transform.translation)).collect();
    let expected = [("b", DVec3::new(5.0, 0.0, 0.0)), ("d", DVec3::new(5.0, 7.0, 0.0)), ("node 2", DVec3::ZERO)];
    assert_eq!(places, expected);
    // Outside stays outside, also in the mirror.
    assert!((volume(&placed(&file)) - 3.0).abs() < 1e-12);
    let everywhere = json!({ "nodes": [{ "mesh": 0 }, { "mesh": 0 }],
                             "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }] });
    assert_eq!(loaded("glb", cube_buffer().glb(everywhere)).placements.len(), 2);
}

#[test]
fn strips_fans_and_bare_lists() {
    let mut buffer = Buffer::default();
    buffer.floats(&SQUARE);
    let shape = |mode: u32| triangles_of(&buffer, json!({ "attributes": { "POSITION": 0 }, "mode": mode })).indices;
    assert_eq!(shape(5), [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(shape(6), [[1, 2, 0], [2, 3, 0]]);
    assert_eq!(shape(4), [[0, 1, 2]]);
    let lines = buffer.glb(alone(json!({ "attributes": { "POSITION": 0 }, "mode": 1 })));
    assert_eq!(error("glb", lines), "mesh.glb: the file has no face to show: 1 primitive of points or lines skipped");
}

#[test]
fn indices_of_every_size() {
    for size in [1, 2, 4] {
        let mut buffer = Buffer::default();
        buffer.floats(&SQUARE);
        buffer.indices(&[3, 2, 1], size);
        let triangles = triangles_of(&buffer, json!({ "attributes": { "POSITION": 0 }, "indices": 1 }));
        assert_eq!(corners(&triangles), [[SQUARE[3], SQUARE[2], SQUARE[1]].map(Vec3::from_array)]);
        let mut buffer = Buffer::default();
        buffer.floats(&SQUARE);
        buffer.indices(&[0, 1, 2, 0, 4, 1], size);
        let primitive = alone(json!({ "attributes": { "POSITION": 0 }, "indices": 1 }));
        let expected = "mesh.glb: primitive 0 of mesh `mesh 0`: triangle 1 names vertex 4, but there are 4 (from 0)";
        assert_eq!(error("glb", buffer.glb(primitive)), expected);
    }
}

#[test]
fn interleaved_attributes_and_a_stretch_of_them() {
    let mut buffer = Buffer::default();
    let rows: Vec<f32> = CUBE.iter().flat_map(|p| [p[0], p[1], p[2], 0.0, 0.0, p[0] + 1.0]).collect();
    let bytes: Vec<u8> = rows.iter().flat_map(|number| number.to_le_bytes()).collect();
    let view = buffer.view(&bytes);
    buffer.views[view]["byteStride"] = 24.into();
    for offset in [0, 12] {
        let accessor =
            json!({ "bufferView": view, "byteOffset": offset, "componentType": 5126, "count": 8, "type": "VEC3" });
        buffer.accessor(accessor);
    }
    // The last four vertices only: a primitive's share of one long accessor.
    buffer.indices(&[4, 5, 6, 4, 6, 7], 2);
    let triangles = triangles_of(&buffer, json!({ "attributes": { "POSITION": 0, "NORMAL": 1 }, "indices": 2 }));
    assert_eq!(triangles.indices, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(triangles.positions, [4, 5, 6, 7].map(|i| Vec3::from_array(CUBE[i])));
    assert_eq!(triangles.normals.iter().map(|n| n.z).collect::<Vec<_>>(), [1.0, 2.0, 2.0, 1.0]);
}

#[test]
fn sparse_accessors_with_and_without_a_base() {
    for base in [false, true] {
        let mut buffer = Buffer::default();
        let places = buffer.view(&[1, 0, 2, 0]);
        let values: Vec<u8> =
            [9.0_f32, 0.0, 0.0, 0.0, 8.0, 0.0].iter().flat_map(|number| number.to_le_bytes()).collect();
        let values = buffer.view(&values);
        let mut accessor = json!({
            "componentType": 5126, "count": 3, "type": "VEC3",
            "sparse": { "count": 2, "indices": { "bufferView": places, "componentType": 5123 },
                        "values": { "bufferView": values } },
        });
        if base {
            let bytes: Vec<u8> = [7.0_f32; 9].iter().flat_map(|number| number.to_le_bytes()).collect();
            accessor["bufferView"] = buffer.view(&bytes).into();
        }
        buffer.accessor(accessor);
        let first = if base { Vec3::splat(7.0) } else { Vec3::ZERO };
        let triangles = triangles_of(&buffer, json!({ "attributes": { "POSITION": 0 } }));
        assert_eq!(corners(&triangles), [[first, Vec3::X * 9.0, Vec3::Y * 8.0]]);
    }
}

#[test]
fn quantised_numbers_are_fractions() {
    let mut buffer = Buffer::default();
    let words = [0_i16, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0];
    let view = buffer.view(&words.map(i16::to_le_bytes).concat());
    buffer.views[view]["byteStride"] = 8.into();
    buffer
        .accessor(json!({ "bufferView": view, "componentType": 5122, "normalized": true, "count": 3, "type": "VEC3" }));
    let view = buffer.view(&[0, 255, 51, 0, 255, 204]);
    buffer
        .accessor(json!({ "bufferView": view, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC2" }));
    let triangles = triangles_of(&buffer, json!({ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 } }));
    assert_eq!(corners(&triangles), [[Vec3::ZERO, Vec3::X, Vec3::NEG_Y]]);
    // v is downwards in the file and upwards here.
    let expected = [[0.0, 0.0], [0.2, 1.0], [1.0, 0.2]];
    for (found, expected) in triangles.uvs.iter().zip(expected) {
        assert!((found.x - expected[0]).abs() < 1e-7 && (found.y - expected[1]).abs() < 1e-7, "{found}");
    }
}

#[test]
fn primitives_are_parts_with_their_material() {
    let mut scene = cube_on(json!([{ "mesh": 0, "name": "here" }]));
    let primitive = |material: Value| json!({ "attributes": { "POSITION": 0 }, "indices": 1, "material": material });
    scene["meshes"][0]["primitives"] = json!([primitive(json!(1)), primitive(Value::Null), primitive(json!(0))]);
    scene["materials"] = json!([{}, { "name": "gold" }]);
    let file = loaded("glb", cube_buffer().glb(scene.clone()));
    let materials: Vec<_> = file.parts.iter().map(|part| part.material.as_deref()).collect();
    assert_eq!(materials, [Some("gold"), None, Some("material 0")]);
    assert_eq!(
        file.placements.iter().map(|p| (p.name.as_str(), p.part)).collect::<Vec<_>>(),
        [("here", 0), ("here", 1), ("here", 2)]
    );
    scene["meshes"][0]["primitives"][1]["material"] = 2.into();
    let expected = "mesh.glb: primitive 1 of mesh `Cube`: there is no material 2";
    assert_eq!(error("glb", cube_buffer().glb(scene)), expected);
}

#[test]
fn buffers_may_stand_beside_the_file() {
    let buffer = cube_buffer();
    let text = buffer.document(Some("my%20buffer.bin"), cube_on(json!([{ "mesh": 0 }]))).to_string();
    let file = load_beside("gltf", text.as_bytes(), &[("my buffer.bin", &buffer.bytes)]).unwrap();
    assert_eq!(placed(&file).len(), 12);
    let short = load_beside("gltf", text.as_bytes(), &[("my buffer.bin", &buffer.bytes[..100])]).unwrap_err();
    assert!(short.to_string().ends_with("buffer 0 ends after 100 bytes, expected 168"), "{short}");
    match load_bytes("gltf", text.as_bytes()) {
        Err(LoadError::Read { path, .. }) => assert!(path.ends_with("my buffer.bin")),
        other => panic!("{other:?}"),
    }
    let remote = text.replace("my%20buffer.bin", "https://example.org/buffer.bin");
    assert_eq!(
        error("gltf", remote),
        "mesh.gltf: primitive 0 of mesh `Cube`: buffer 0 is at https://example.org/buffer.bin: only files are read"
    );
}

#[test]
fn required_extensions() {
    let with = |required: Value| {
        let mut scene = cube_on(json!([{ "mesh": 0 }]));
        scene["extensionsRequired"] = required;
        scene["extensionsUsed"] = json!(["KHR_lights_punctual", "KHR_materials_ior"]);
        cube_buffer().glb(scene)
    };
    let refused =
        load_bytes("glb", &with(json!(["KHR_materials_ior", "KHR_draco_mesh_compression", "EXT_meshopt_compression"])));
    match refused {
        Err(LoadError::Extensions { names, .. }) => {
            assert_eq!(names, ["KHR_draco_mesh_compression", "EXT_meshopt_compression"]);
        }
        other => panic!("{other:?}"),
    }
    let file = loaded("glb", with(json!(["KHR_materials_ior", "KHR_texture_transform", "KHR_mesh_quantization"])));
    let expected = [
        "the file requires KHR_materials_ior: its materials and pictures are not read",
        "the file requires KHR_texture_transform: its materials and pictures are not read",
        "the file uses KHR_lights_punctual, which was passed over: a scene has lights of its own",
    ];
    assert_eq!(file.notes, expected);
}

#[test]
fn what_is_not_shown_is_noted() {
    let mut scene = cube_on(json!([{ "mesh": 0, "skin": 0, "children": [1] },
                                   { "name": "shy", "mesh": 0, "scale": [1, 0, 1] }]));
    scene["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": 0 }]);
    scene["meshes"].as_array_mut().unwrap().push(json!({ "primitives": [] }));
    let file = loaded("glb", cube_buffer().glb(scene));
    assert_eq!(file.placements.len(), 1);
    let expected = [
        "`node 0` has a skin: it is shown as modelled, without its bones",
        "`Cube` has morph targets: it is shown without them",
        "`shy` is scaled to nothing and was skipped",
        "1 mesh shown by no node of the scene: not read",
    ];
    assert_eq!(file.notes, expected);
}

#[test]
fn mistakes_are_named() {
    let wrong = |change: fn(&mut Value), expected: &str| {
        let mut root = cube_buffer().document(None, cube_on(json!([{ "mesh": 0, "children": [1] }, {}])));
        change(&mut root);
        let bytes = cube_buffer().glb(root);
        assert_eq!(error("glb", bytes), format!("mesh.glb: {expected}"));
    };
    let in_cube = |expected: &str| format!("primitive 0 of mesh `Cube`: {expected}");
    wrong(|root| root["asset"]["version"] = "1.0".into(), "it is glTF 1.0, expected 2.0");
    wrong(|root| root["scene"] = 1.into(), "there is no scene 1");
    wrong(|root| root["nodes"][1]["children"] = json!([0]), "node 0 hangs in the scene twice: nodes must be a tree");
    wrong(|root| root["nodes"][1]["children"] = json!([2]), "there is no node 2");
    wrong(|root| root["nodes"][1]["mesh"] = 1.into(), "there is no mesh 1");
    wrong(|root| root["nodes"][1]["camera"] = 1.into(), "there is no camera 1");
    wrong(
        |root| root["nodes"][1]["rotation"] = json!([0, 0, 0, 0]),
        "node 1: its rotation [0.0, 0.0, 0.0, 0.0] is no quaternion of length 1",
    );
    wrong(
        |root| root["nodes"][1]["matrix"] = json!([0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]),
        "node 1: the last row of its matrix is [1.0, 0.0, 0.0, 1.0], expected [0, 0, 0, 1]",
    );
    let huge = "node 0: a number of its transform is 1e300; \
                single precision wants sizes and coordinates within 1e-15 … 1e15 (choose another unit)";
    wrong(|root| root["nodes"][0]["scale"] = json!([1e300, 1e300, 1e300]), huge);
    wrong(
        |root| root["accessors"][0]["count"] = 9.into(),
        &in_cube("accessor 0: 9 elements from byte 0 reach beyond the 96 bytes of view 0"),
    );
    wrong(
        |root| root["accessors"][1]["count"] = (1u64 << 31).into(),
        &in_cube("accessor 1: 2147483648 elements from byte 0 reach beyond the 72 bytes of view 1"),
    );
    wrong(
        |root| root["accessors"][1]["count"] = u64::MAX.into(),
        &in_cube("accessor 1: 18446744073709551615 elements from byte 0 reach beyond the 72 bytes of view 1"),
    );
    wrong(
        |root| root["accessors"][0]["type"] = "VEC2".into(),
        &in_cube("accessor 0: it is of type VEC2, expected VEC3"),
    );
    wrong(
        |root| root["accessors"][0]["componentType"] = 5130.into(),
        &in_cube("accessor 0: 5130 is no type of a component"),
    );
    wrong(|root| root["accessors"][0]["bufferView"] = 7.into(), &in_cube("accessor 0: there is no buffer view 7"));
    wrong(
        |root| root["accessors"][1]["componentType"] = 5126.into(),
        &in_cube("accessor 1: indices must be unsigned integers"),
    );
    wrong(
        |root| root["bufferViews"][0]["byteLength"] = 999.into(),
        &in_cube("accessor 0: view 0 of 999 bytes from 0 reaches beyond buffer 0 of 168"),
    );
    wrong(
        |root| root["bufferViews"][0]["byteStride"] = 8.into(),
        &in_cube("accessor 0: the stride of 8 bytes is less than the 12 of an element"),
    );
    wrong(
        |root| root["buffers"][0]["byteLength"] = 999.into(),
        &in_cube("buffer 0 ends after 168 bytes, expected 999"),
    );
    wrong(
        |root| root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 1.into(),
        &in_cube("accessor 1 has 36 elements for 8 vertices"),
    );
    wrong(|root| root["meshes"][0]["primitives"][0]["mode"] = 7.into(), &in_cube("7 is no mode of a primitive"));
    assert_eq!(
        error("gltf", "{\n  \"asset\": 3\n}"),
        "mesh.gltf:2: column 12: invalid type: integer `3`, expected struct Asset"
    );
}

#[test]
fn instances_stand_where_they_stand_on_paper() {
    let mut buffer = cube_buffer();
    let translations = buffer.floats(&[[1.0, 2.0, 3.0], [-4.0, 0.0, 0.0]]);
    let scales = buffer.floats(&[[1.0, 1.0, 1.0], [2.0, 3.0, 4.0]]);
    let instancing = json!({ "attributes": { "TRANSLATION": translations, "SCALE": scales } });
    let nodes = json!([{ "name": "many", "mesh": 0, "translation": [10, 0, 0],
                         "extensions": { "EXT_mesh_gpu_instancing": instancing } }]);
    let mut scene = cube_on(nodes);
    scene["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    let file = loaded("glb", buffer.glb(scene));
    assert_eq!((file.parts.len(), file.notes.len()), (1, 0), "{:?}", file.notes);
    let places: Vec<_> = file.placements.iter().map(|p| (p.name.as_str(), p.transform.translation)).collect();
    assert_eq!(places, [("many", DVec3::new(11.0, -3.0, 2.0)), ("many", DVec3::new(6.0, 0.0, 0.0))]);
    assert!((volume(&placed(&file)) - 25.0).abs() < 1e-12);
}

#[test]
fn lights_that_a_file_requires_are_passed_over() {
    let mut scene = cube_on(json!([{ "mesh": 0 }]));
    scene["extensionsRequired"] = json!(["KHR_lights_punctual"]);
    scene["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    let file = loaded("glb", cube_buffer().glb(scene));
    assert_eq!(file.notes, ["the file uses KHR_lights_punctual, which was passed over: a scene has lights of its own"]);
    assert_eq!(file.parts.len(), 1);
    for name in ["KHR_draco_mesh_compression", "EXT_meshopt_compression"] {
        let mut scene = cube_on(json!([{ "mesh": 0 }]));
        scene["extensionsRequired"] = json!([name]);
        let expected = format!("mesh.glb: it requires {name}, which spectrel does not support; export it without");
        assert_eq!(error("glb", cube_buffer().glb(scene)), expected);
    }
}

#[test]
fn matrices_may_be_rounded() {
    let node = |last: f64| json!([{ "mesh": 0, "matrix": [1, 0, 0, 1e-8, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, last] }]);
    let file = loaded("glb", cube_buffer().glb(cube_on(node(1.0000001))));
    assert!((volume(&placed(&file)) - 1.0).abs() < 1e-6);
    assert!(error("glb", cube_buffer().glb(cube_on(node(1.1)))).contains("the last row of its matrix"));
}

#[test]
fn older_versions_are_told() {
    let text = r#"{"asset":{"version":"1.0"},"scene":"s","scenes":{"s":{"nodes":[]}},"nodes":{}}"#;
    let expected = "mesh.gltf: it is glTF 1.0, expected 2.0: export it as glTF 2.0";
    assert_eq!(error("gltf", text), expected);
    assert_eq!(error("gltf", text.replace("\"1.0\"", "1.0")), expected);
    assert_eq!(error("gltf", text.replace("\"asset\":{\"version\":\"1.0\"},", "")), expected);
}
