//! The same cube in each format.

use super::write;
use super::*;
use serde_json::json;

fn check_cube(file: &MeshFile) {
    assert_eq!(file.notes, Vec::<String>::new());
    assert_eq!((file.parts.len(), file.placements.len()), (1, 1));
    assert_eq!(file.parts[0].triangles.positions.len(), 8);
    let triangles = placed(file);
    assert_eq!(triangles.len(), 12);
    assert!((volume(&triangles) - 1.0).abs() < 1e-12);
    assert!(is_closed(&triangles));
    let centre = triangles.as_flattened().iter().sum::<DVec3>() / 36.0;
    for [a, b, c] in triangles {
        let normal = (b - a).cross(c - a);
        assert!(normal.dot(a - centre) > 0.0);
        assert!((normal.length() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_cube_is_a_cube_in_every_format() {
    check_cube(&loaded("obj", write::obj()));
    check_cube(&loaded("ply", write::ply_ascii()));
    check_cube(&loaded("ply", write::ply_ascii().replace('\n', "\r\n")));
    check_cube(&loaded("ply", write::ply_binary(false)));
    check_cube(&loaded("ply", write::ply_binary(true)));
    check_cube(&loaded("stl", write::stl_ascii()));
    check_cube(&loaded("stl", write::stl_cube("made by hand")));
    let on_a_node = || write::cube_on(json!([{ "mesh": 0 }]));
    check_cube(&loaded("glb", write::cube_buffer().glb(on_a_node())));
    check_cube(&loaded("gltf", write::cube_buffer().gltf(on_a_node())));
}

#[test]
fn the_check_of_a_cube_can_fail() {
    let inside_out = write::obj().replace("f 1 4 3 2", "f 1 2 3 4");
    let triangles = placed(&loaded("obj", inside_out));
    assert!(!is_closed(&triangles));
    let open = write::obj().replace("f 1 4 3 2\n", "");
    assert!(!is_closed(&placed(&loaded("obj", open))));
}

#[test]
fn extensions_tell_the_format_in_either_case() {
    check_cube(&loaded("OBJ", write::obj()));
    assert_eq!(
        error("fbx", "x"),
        "mesh.fbx: `.fbx` is no mesh format known here; the mesh formats are .obj, .ply, .stl, .gltf, .glb"
    );
    let nowhere = load(std::path::Path::new("nowhere.obj")).unwrap_err().to_string();
    assert!(nowhere.starts_with("cannot read nowhere.obj: "), "{nowhere}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("folder.ply");
    fs::create_dir(&path).unwrap();
    assert!(matches!(load(&path), Err(LoadError::Read { .. })));
}
