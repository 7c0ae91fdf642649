//! What OBJ has of its own.

use super::*;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn negative_indices_count_backwards() {
    let file = loaded("obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -4 -3 -1\n");
    let triangles = corners(&file.parts[0].triangles);
    assert_eq!(triangles[0], [Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert_eq!(triangles[1], [Vec3::ZERO, Vec3::X, Vec3::splat(5.0)]);
    // The vertex that no face names is gone.
    assert_eq!(file.parts[0].triangles.positions.len(), 4);
    assert_eq!(error("obj", "v 0 0 0\nf -1 -2 -1\n"), "mesh.obj:2: the face names vertex -2, but 1 stand before it");
}

#[test]
fn corners_have_their_own_normals_and_coordinates() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0.25\nvt 1 0.75\nvn 0 0 1\nvn 0 0 2\n\
                f 1/1/1 2/2/1 3/1/1\nf 1/1/1 3/1/1 2/1/2\n";
    let triangles = loaded("obj", text).parts[0].triangles.clone();
    assert_eq!(triangles.indices, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(triangles.positions[3], triangles.positions[1]);
    assert_eq!(triangles.normals[1], Vec3::Z);
    assert_eq!(triangles.normals[3], 2.0 * Vec3::Z);
    assert_eq!(triangles.uvs[1].to_array(), [1.0, 0.75]);
    assert_eq!(triangles.uvs[3].to_array(), [0.0, 0.25]);
    let without_uvs = loaded("obj", format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1 4//-1\n"));
    let triangles = &without_uvs.parts[0].triangles;
    assert_eq!((triangles.normals.len(), triangles.uvs.len()), (4, 0));
    let uvs_only = loaded("obj", format!("{SQUARE}vt 1\nf 1/1 2/1 3/1/ 4/1\n"));
    assert_eq!(uvs_only.parts[0].triangles.uvs[2].to_array(), [1.0, 0.0]);
}

#[test]
fn parts_are_objects_and_groups_of_one_material() {
    let text = format!(
        "{SQUARE}mtllib a.mtl\nf 1 2 3\no Ring\nusemtl gold leaf\nf 1 2 3\ng shank\nf 1 3 4\ng\nusemtl ruby\nf 1 2 4\n\
         usemtl gold leaf\nf 2 3 4\no \nusemtl\ng shank head\nf 2 3 4\n"
    );
    let file = loaded("obj", text);
    let parts: Vec<_> =
        file.parts.iter().map(|p| (p.name.as_str(), p.material.as_deref(), p.triangles.indices.len())).collect();
    let expected = [
        ("mesh", None, 1),
        ("Ring", Some("gold leaf"), 2),
        ("Ring/shank", Some("gold leaf"), 1),
        ("Ring", Some("ruby"), 1),
        ("shank head", None, 1),
    ];
    assert_eq!(parts, expected);
    assert_eq!(file.placements.iter().map(|p| p.part).collect::<Vec<_>>(), [0, 1, 2, 3, 4]);
}

#[test]
fn untidy_lines_are_read() {
    let text =
        "# comment\r\n\r\n  v 0 0 0 1.0 # w\r\nv\t1 0 0\nv 1e0 +1. 0 0.5 0.5 0.5\nf 1 \\\n 2 \\\n3 # that's all\ns 1\n";
    let file = loaded("obj", text);
    assert_eq!(corners(&file.parts[0].triangles), [[Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0)]]);
    assert_eq!(file.notes, Vec::<String>::new());
    // Faces may come before their vertices, and names in any encoding.
    let early = loaded("obj", [b"o caf\xe9\nf 1 2 3\n".as_slice(), SQUARE.as_bytes()].concat());
    assert_eq!(early.parts[0].triangles.indices.len(), 1);
    let notes = loaded("obj", format!("{SQUARE}l 1 2\nl 2 3\np 1\nf 1 2 3")).notes;
    let expected = [
        "2 lines of `l` passed over: only polygons are read",
        "1 line of `p` passed over: only polygons are read",
        "the last line has no end: the file may have been cut short",
    ];
    assert_eq!(notes, expected);
}

#[test]
fn mixed_corners_lose_what_some_lack() {
    let file = loaded("obj", format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\n"));
    assert!(file.parts[0].triangles.normals.is_empty());
    assert_eq!(file.notes, ["some corners of `mesh` have no normal: those of the others were dropped"]);
}

#[test]
fn mistakes_have_their_line() {
    let wrong = |more: &str, expected: &str| assert_eq!(error("obj", format!("{SQUARE}{more}")), expected);
    wrong("f 1 2 9\n", "mesh.obj:5: the face names vertex 9, but the file has 4");
    wrong("f 1 2 0\n", "mesh.obj:5: `0` names a vertex 0, they count from 1");
    wrong("f 1 2 99999999999\n", "mesh.obj:5: the face names vertex 99999999999, but the file has 4");
    wrong(
        "f 1 2\n",
        "mesh.obj: the file has no face to show: 1 face of fewer than 3 corners skipped; `mesh` has no faces and was dropped",
    );
    wrong("f 1 2 x\n", "mesh.obj:5: `x` is not a corner, expected `v`, `v/vt`, `v//vn` or `v/vt/vn`");
    wrong("f 1 2 1/1/1/1\n", "mesh.obj:5: `1/1/1/1` is not a corner, expected `v`, `v/vt`, `v//vn` or `v/vt/vn`");
    wrong("v 1 2\n", "mesh.obj:5: 2 numbers, expected 3");
    wrong("v 1 2 three\n", "mesh.obj:5: `three` is not a number");
    wrong("", "mesh.obj: the file has no face to show");
    wrong("v 0 0 1e99\n", "mesh.obj:5: 1e99 is beyond the range of numbers");
    let far = error("obj", "v 0 -2251799813685248 0\n");
    assert!(far.starts_with("mesh.obj:1: a coordinate is 2.251799813685248e15; single precision wants "), "{far}");
}

#[test]
fn absent_normals_and_coordinates_are_left_out() {
    let shown = |faces: &str, note: &str| {
        let file = loaded("obj", format!("{SQUARE}{faces}"));
        assert_eq!(file.notes.first().map(String::as_str), Some(note));
        let triangles = &file.parts[0].triangles;
        assert_eq!((triangles.indices.len(), triangles.normals.len(), triangles.uvs.len()), (1, 0, 0), "{faces}");
    };
    shown(
        "f 1//1 2//2 3//3\n",
        "faces name normals that the file does not have (line 5 the 3 of 0): such are left out",
    );
    shown(
        "f 1/1 2/1 3/1\n",
        "faces name texture coordinates that the file does not have (line 5 the 1 of 0): such are left out",
    );
    shown(
        "vn 0 0 1\nf 1//1 2//1 3//2\n",
        "faces name normals that the file does not have (line 6 the 2 of 1): such are left out",
    );
    shown("vn 0 0 1\nf 1//0 2//1 3//1\n", "some corners of `mesh` have no normal: those of the others were dropped");
}

#[test]
fn faces_of_two_corners_are_skipped_and_counted() {
    let file = loaded("obj", format!("{SQUARE}f 1 2\nf 1 2 3\nf 4\n"));
    assert_eq!(file.notes, ["2 faces of fewer than 3 corners skipped"]);
    assert_eq!(file.parts[0].triangles.indices, [[0, 1, 2]]);
}

#[test]
fn every_encoding_is_the_same_file() {
    let plain = format!("{SQUARE}usemtl a\nf 1 2 3 4\n");
    let expected = loaded("obj", &plain);
    let utf16 = |order: fn(u16) -> [u8; 2], mark: &str| {
        format!("{mark}{plain}").encode_utf16().flat_map(order).collect::<Vec<u8>>()
    };
    let mut odd = utf16(u16::to_le_bytes, "\u{feff}");
    odd.push(0);
    for bytes in [
        format!("\u{feff}{plain}").into_bytes(),
        utf16(u16::to_le_bytes, "\u{feff}"),
        utf16(u16::to_be_bytes, "\u{feff}"),
        utf16(u16::to_le_bytes, ""),
        utf16(u16::to_be_bytes, ""),
        odd,
        plain.replace('\n', "\r").into_bytes(),
        plain.replace('\n', "\r\n").into_bytes(),
        format!("\u{feff}{}", plain.replace('\n', "\r")).into_bytes(),
    ] {
        assert_eq!(loaded("obj", &bytes), expected, "{:?}", String::from_utf8_lossy(&bytes));
    }
    let latin: Vec<u8> = plain.replace("usemtl a", "usemtl Ros\u{e9}").chars().map(|letter| letter as u8).collect();
    assert_eq!(loaded("obj", latin).parts[0].material.as_deref(), Some("Ros\u{e9}"));
    assert_eq!(
        error("obj", plain.replace('\n', "\r").replace("f 1 2", "f 1 x")),
        "mesh.obj:6: `x` is not a corner, expected `v`, `v/vt`, `v//vn` or `v/vt/vn`"
    );
}
