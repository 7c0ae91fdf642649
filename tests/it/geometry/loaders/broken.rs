//! Files that are cut, that lie, or that are no files of their kind at all.

use std::sync::LazyLock;
use std::time::Instant;

use super::write::{self, Buffer, cube_buffer, cube_on};
use super::*;
use proptest::prelude::*;
use serde_json::json;

/// A cube in every format.
static CUBES: LazyLock<[(&str, Vec<u8>); 9]> = LazyLock::new(cubes);

fn cubes() -> [(&'static str, Vec<u8>); 9] {
    let on_a_node = || cube_on(json!([{ "mesh": 0, "children": [1] }, { "camera": 0, "rotation": [0, 0, 0, 1] }]));
    let mut scene = on_a_node();
    scene["cameras"] = json!([{ "perspective": { "yfov": 1 } }]);
    [
        ("obj", write::obj().into_bytes()),
        (
            "obj",
            b"o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\nusemtl m\nf 1/1/1 2/1/1 3/-1/-1 4//1\n".into(),
        ),
        ("ply", write::ply_ascii().into_bytes()),
        ("ply", write::ply_binary(false)),
        ("ply", write::ply_binary(true)),
        ("stl", write::stl_ascii().into_bytes()),
        ("stl", write::stl_cube("solid")),
        ("glb", cube_buffer().glb(scene.clone())),
        ("gltf", cube_buffer().gltf(scene)),
    ]
}

/// What every file that loads may be relied upon for.
fn check(file: &MeshFile) {
    assert!(!file.parts.is_empty());
    for part in &file.parts {
        let Triangles { positions, normals, uvs, indices } = &part.triangles;
        assert!(!indices.is_empty());
        assert!(positions.iter().all(|p| p.is_finite() && p.abs().max_element() <= 1e15));
        assert!(normals.is_empty() || normals.len() == positions.len());
        assert!(uvs.is_empty() || uvs.len() == positions.len());
        for [a, b, c] in corners(&part.triangles).into_iter().map(|t| t.map(|p| p.as_dvec3())) {
            assert_ne!((b - a).cross(c - a), DVec3::ZERO);
        }
    }
    assert!(file.placements.iter().all(|p| p.part < file.parts.len() && p.transform.is_finite()));
}

#[test]
fn a_cut_anywhere_is_told() {
    for (extension, bytes) in CUBES.iter() {
        let is_text = *extension == "obj" || bytes.starts_with(b"ply\nformat ascii");
        // Nothing but the name that ends a text STL may be lost.
        let name = bytes.windows(8).position(|word| word == b"endsolid").map_or(usize::MAX, |at| at + 8);
        for length in 0..bytes.len() {
            let cut = &bytes[..length];
            match load_bytes(extension, cut) {
                Err(LoadError::Content { message, .. }) => assert!(!message.is_empty()),
                Err(other) => panic!("{extension} of {length} bytes: {other}"),
                Ok(file) => {
                    check(&file);
                    // A text without end of line is suspect; an OBJ of whole lines is a smaller OBJ.
                    let noted = file.notes.iter().any(|note| note.contains("may have been cut short"));
                    let whole = *extension == "obj" && cut.ends_with(b"\n");
                    assert!(length >= name || (is_text && (noted || whole)), "{extension} of {length} bytes");
                }
            }
        }
    }
}

#[test]
fn cut_binaries_say_where_they_end() {
    let cut = |extension: &str, bytes: Vec<u8>, less: usize| error(extension, &bytes[..bytes.len() - less]);
    let ply = write::ply_binary(true);
    assert!(cut("ply", ply.clone(), 1).ends_with(&format!("the file ends in `face` 5, at byte {}", ply.len() - 1)));
    assert!(cut("stl", write::stl_cube("x"), 51).ends_with("the file ends in triangle 10 of 12"));
    let glb = cube_buffer().glb(cube_on(json!([{ "mesh": 0 }])));
    let (length, end) = (glb.len(), glb.len() - 5);
    let expected = format!("mesh.glb, byte {end}: the file ends here, but its head promises {length} bytes");
    assert_eq!(cut("glb", glb, 5), expected);
}

#[test]
fn bad_triangles_are_skipped_and_counted() {
    let vertices = "o Ring\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\nv nan 0 0\nv 0 -inf 0\n";
    let faces = "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 2 4 5\nf 1 1 2\nf 1 2 6\nf 7 2 3\n";
    let file = loaded("obj", format!("{vertices}{faces}"));
    check(&file);
    assert_eq!(file.parts[0].triangles.indices, [[0, 1, 2]]);
    let expected = [
        "1 triangle of `Ring` names the same vertex twice and was skipped",
        "2 triangles of `Ring` have corners that are not finite numbers and were skipped",
        "3 triangles of `Ring` have no area and were skipped",
    ];
    assert_eq!(file.notes, expected);
    let nothing = error("obj", format!("{vertices}f 1 2 4\n"));
    let expected = "mesh.obj: the file has no face to show: 1 triangle of `Ring` has no area and was skipped; \
                    `Ring` has no faces and was dropped";
    assert_eq!(nothing, expected);
    // Thin is not flat: an edge of 1e-30 beside one of 1.
    let thin = loaded("obj", "v 0 0 0\nv 1 0 0\nv 0 1e-30 0\nf 1 2 3\n");
    assert_eq!(thin.parts[0].triangles.indices.len(), 1);
}

#[test]
fn a_part_without_faces_is_dropped() {
    let file = loaded("stl", format!("solid empty\nendsolid\n{}", write::stl_ascii()));
    assert_eq!((file.parts.len(), file.placements[0].part), (1, 0));
    assert_eq!(file.notes, ["`empty` has no faces and was dropped"]);
}

#[test]
fn normals_without_direction_leave_a_part_faceted() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt nan 0\nvn 0 0 1\nvn 0 0 0\nf 1/1/1 2/1/1 3/1/2\n";
    let file = loaded("obj", text);
    check(&file);
    let triangles = &file.parts[0].triangles;
    assert_eq!((triangles.normals.len(), triangles.uvs.len()), (0, 0));
    let expected = [
        "1 normal of `mesh` is zero or not finite: its normals were dropped, it is faceted",
        "`mesh` has texture coordinates that are not finite numbers: they were dropped",
    ];
    assert_eq!(file.notes, expected);
    // Any length will do, as long as squares of it are numbers.
    let far = loaded("obj", text.replace("vn 0 0 0", "vn 0 0 1e-30").replace("nan", "0"));
    assert_eq!(far.parts[0].triangles.normals[2], Vec3::Z);
}

#[test]
fn headers_that_promise_billions_cost_nothing() {
    let start = Instant::now();
    let many = u32::MAX.to_string();
    for count in [many.as_str(), "18446744073709551615"] {
        for big in [false, true] {
            let bytes =
                String::from_utf8_lossy(&write::ply_binary(big)).replace("vertex 8", &format!("vertex {count}"));
            assert!(error("ply", bytes).contains("the file ends in `vertex`"));
        }
        let faces = write::ply_ascii().replace("face 6", &format!("face {count}"));
        assert!(error("ply", faces).contains("the file ends before `face` 7 of "));
        let list = write::ply_ascii().replacen("\n4 0 ", &format!("\n{count} 0 "), 1);
        assert!(load_bytes("ply", list.as_bytes()).is_err());
    }
    let mut stl = write::stl_cube("x");
    stl[80..84].fill(255);
    assert!(error("stl", stl).ends_with("the file ends in triangle 12 of 4294967295"));
    for view in [json!({}), json!({ "bufferView": 0 })] {
        for count in [4_000_000_000_u64, u64::MAX] {
            let mut buffer = Buffer::default();
            buffer.view(&[0; 12]);
            let mut accessor = view.clone();
            accessor["componentType"] = 5126.into();
            accessor["count"] = count.into();
            accessor["type"] = "VEC3".into();
            buffer.accessor(accessor);
            let scene = json!({ "nodes": [{ "mesh": 0 }],
                                "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }] });
            assert!(load_bytes("glb", &buffer.glb(scene)).is_err());
        }
    }
    assert!(start.elapsed().as_secs() < 10);
}

/// One change to a file.
#[derive(Clone, Debug)]
enum Change {
    Byte(usize, u8),
    /// The nth digit of the file becomes this character: texts stay texts.
    Digit(usize, char),
    Cut(usize),
    Remove(usize, usize),
    Repeat(usize, usize),
}

fn changes() -> impl Strategy<Value = Vec<Change>> {
    let change = prop_oneof![
        2 => (any::<usize>(), any::<u8>()).prop_map(|(at, byte)| Change::Byte(at, byte)),
        6 => (any::<usize>(), prop::char::ranges(vec!['0'..='9', '-'..='/', ' '..=' ', 'e'..='e'].into()))
            .prop_map(|(at, digit)| Change::Digit(at, digit)),
        1 => any::<usize>().prop_map(Change::Cut),
        1 => (any::<usize>(), 1..40_usize).prop_map(|(at, length)| Change::Remove(at, length)),
        1 => (any::<usize>(), 1..40_usize).prop_map(|(at, length)| Change::Repeat(at, length)),
    ];
    prop::collection::vec(change, 1..4)
}

fn apply(bytes: &mut Vec<u8>, change: &Change) {
    let place = |at: usize| at % bytes.len().max(1);
    match *change {
        _ if bytes.is_empty() => {}
        Change::Byte(at, byte) => {
            let at = place(at);
            bytes[at] = byte;
        }
        Change::Digit(at, digit) => {
            let digits: Vec<usize> = (0..bytes.len()).filter(|&i| bytes[i].is_ascii_digit()).collect();
            if let Some(&at) = digits.get(at % digits.len().max(1)) {
                bytes[at] = digit as u8;
            }
        }
        Change::Cut(at) => bytes.truncate(place(at)),
        Change::Remove(at, length) => {
            let at = place(at);
            bytes.drain(at..(at + length).min(bytes.len()));
        }
        Change::Repeat(at, length) => {
            let at = place(at);
            let piece = bytes[at..(at + length).min(bytes.len())].to_vec();
            bytes.splice(at..at, piece);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn changed_files_load_soundly_or_not_at_all(which in 0..9_usize, changes in changes()) {
        let (extension, mut bytes) = CUBES[which].clone();
        for change in &changes {
            apply(&mut bytes, change);
        }
        if let Ok(file) = load_bytes(extension, &bytes) {
            check(&file);
        }
    }

    #[test]
    fn random_bytes_are_no_mesh(
        which in 0..9_usize, keep in 0..120_usize, noise in prop::collection::vec(any::<u8>(), 0..400)
    ) {
        let (extension, mut bytes) = CUBES[which].clone();
        bytes.truncate(keep);
        bytes.extend(noise);
        if let Ok(file) = load_bytes(extension, &bytes) {
            check(&file);
        }
    }
}

/// Triangles without area alone are an error that counts them; corners up to 2³¹ name what is missing.
#[test]
fn files_of_nothing_but_flat_triangles_and_corners_beyond_all_counts_are_errors() {
    let ply = |face: &str| {
        let head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                    element face 1\nproperty list uchar uint vertex_indices\nend_header\n";
        format!("{head}0 0 0\n1 0 0\n2 0 0\n{face}\n")
    };
    let stl = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 2 0 0\nendloop\nendfacet\nendsolid s\n";
    let flat =
        [("obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n".to_owned()), ("ply", ply("3 0 1 2")), ("stl", stl.to_owned())];
    for (extension, text) in flat {
        let message = error(extension, &text);
        assert!(message.contains("no face to show") && message.contains("1 triangle"), "{message}");
    }
    for index in ["2147483648", "4294967295"] {
        let far =
            [("obj", format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 {index}\n")), ("ply", ply(&format!("3 0 1 {index}")))];
        for (extension, text) in far {
            let message = error(extension, &text);
            assert!(message.contains(index) && message.contains('3'), "{message}");
        }
    }
}
