//! What PLY has of its own.

use super::write;
use super::*;

/// A triangle under this header.
fn ply(header: &str, body: &str) -> String {
    format!("ply\nformat ascii 1.0\n{header}end_header\n{body}")
}

const XYZ: &str = "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n";
const FACE: &str = "element face 1\nproperty list uint8 uint32 vertex_index\n";
const CORNERS: &str = "0 0 0\n1 0 0\n0 1 0\n";

#[test]
fn normals_coordinates_and_strangers() {
    let header = "obj_info scanned\nelement camera 1\nproperty float a\nproperty list uchar float b\n\
                  element vertex 3\nproperty uchar red\nproperty float x\nproperty list int int q\nproperty short y\n\
                  property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float s\n\
                  property float t\nelement face 1\nproperty list uchar float texcoord\n\
                  property list uchar ushort vertex_indices\n\
                  property int group\nelement edge 1\nproperty int a\n";
    let body = "7 2 0.5 0.5\n9 0 0 0 0 0 0 2 0 0.25\n9 1.5 2 8 8 0 0 0 0 1 1 0.5\n9 0 1 8 1 0 0 0 1 0.5 1\n\
                6 0 0 1 0 1 1 3 0 1 2 4\n5\n";
    let file = loaded("ply", ply(header, body));
    assert_eq!(file.notes, Vec::<String>::new());
    let triangles = &file.parts[0].triangles;
    assert_eq!(corners(triangles), [[Vec3::ZERO, Vec3::new(1.5, 0.0, 0.0), Vec3::Y]]);
    assert_eq!(triangles.normals, [2.0 * Vec3::Z, Vec3::Z, Vec3::Z]);
    assert_eq!(triangles.uvs[1].to_array(), [1.0, 0.5]);
    for [u, v] in [["u", "v"], ["texture_u", "texture_v"]] {
        let header = header.replace("float s\n", &format!("float {u}\n")).replace("float t\n", &format!("float {v}\n"));
        assert_eq!(loaded("ply", ply(&header, body)), file);
    }
}

#[test]
fn numbers_of_every_type_in_both_orders() {
    let header = "element vertex 3\nproperty int8 x\nproperty float64 y\nproperty int16 z\n\
                  element face 1\nproperty list uint16 int8 vertex_indices\n";
    for big in [false, true] {
        let form = if big { "binary_big_endian" } else { "binary_little_endian" };
        let mut bytes = format!("ply\nformat {form} 1.0\n{header}end_header\n").into_bytes();
        for (x, y, z) in [(-3_i8, 0.5_f64, -300_i16), (100, 0.25, 7), (1, -2.0, 300)] {
            bytes.extend(x.to_be_bytes());
            bytes.extend(if big { y.to_be_bytes() } else { y.to_le_bytes() });
            bytes.extend(if big { z.to_be_bytes() } else { z.to_le_bytes() });
        }
        bytes.extend(if big { 3_u16.to_be_bytes() } else { 3_u16.to_le_bytes() });
        bytes.extend([2, 0, 1]);
        let file = loaded("ply", bytes);
        let expected = [[1.0, -2.0, 300.0], [-3.0, 0.5, -300.0], [100.0, 0.25, 7.0]].map(Vec3::from_array);
        assert_eq!(corners(&file.parts[0].triangles), [expected]);
    }
}

#[test]
fn thin_faces_and_trailing_data_are_noted() {
    let two = FACE.replace("face 1", "face 2");
    let file = loaded("ply", ply(&format!("{XYZ}{two}"), &format!("{CORNERS}3 0 1 2\n2 0 1\nmore\n")));
    let expected =
        ["1 face of fewer than 3 vertices skipped", "the text from line 15 on belongs to no element of the header"];
    assert_eq!(file.notes, expected);
    let mut bytes = write::ply_binary(false);
    bytes.push(0);
    assert_eq!(loaded("ply", bytes).notes, ["1 byte at the end, of no element of the header"]);
}

#[test]
fn mistakes_have_their_place() {
    let wrong = |header: &str, body: &str, expected: &str| assert_eq!(error("ply", ply(header, body)), expected);
    let both = &format!("{XYZ}{FACE}");
    wrong(
        both,
        &format!("{CORNERS}3 0 1 3\n"),
        "mesh.ply:13: face 0 names vertex 3, but the file has 3 (counted from 0)",
    );
    wrong(
        both,
        &format!("{CORNERS}3 0 1 -1\n"),
        "mesh.ply:13: face 0 names vertex -1, but the file has 3 (counted from 0)",
    );
    wrong(both, &format!("{CORNERS}3 0 1 1.5\n"), "mesh.ply:13: `1.5` is not a whole number");
    wrong(both, &format!("{CORNERS}3 0 1\n"), "mesh.ply:13: the line ends before its last number");
    wrong(both, &format!("{CORNERS}3 0 1 2 0\n"), "mesh.ply:13: `0` follows the last number of the row");
    wrong(both, CORNERS, "mesh.ply:13: the file ends before `face` 1 of 1");
    wrong(both, "0 0 x\n", "mesh.ply:10: `x` is not a number");
    wrong(XYZ, CORNERS, "mesh.ply: the header has no element `face`");
    wrong(FACE, "", "mesh.ply: the header has no element `vertex`");
    wrong(
        &both.replace("double z", "double w"),
        "",
        "mesh.ply:3: the element `vertex` lacks one of the properties `x`, `y`, `z`",
    );
    wrong(&both.replace("uint32", "float"), "", "mesh.ply:7: the vertices of a face are not of an integer type");
    wrong(
        &both.replace("uint8", "float"),
        "",
        "mesh.ply:8: the length of the list `vertex_index` is of type float, expected an integer",
    );
    wrong(&both.replace("double y", "number y"), "", "mesh.ply:5: `number` is no type of a property");
    wrong(&both.replace("vertex 3", "vertex many"), "", "mesh.ply:3: `many` is not a count of elements");
    assert_eq!(error("ply", "plyx\n"), "mesh.ply:1: the file does not begin with `ply`");
    assert_eq!(error("ply", "ply\nformat ascii 1.0\n"), "mesh.ply:3: the file ends before `end_header`");
    assert_eq!(error("ply", "ply\nend_header\n"), "mesh.ply: the header has no `format` line");
    let none = ply(&both.replace("face 1", "face 0"), CORNERS);
    assert_eq!(error("ply", none), "mesh.ply: the file has no face to show: `mesh` has no faces and was dropped");
}

#[test]
fn errors_of_bytes_name_element_and_place() {
    let header = write::ply_header("binary_little_endian").len();
    let mut bytes = write::ply_binary(false);
    let face_2 = header + 8 * 12 + 2 * 17;
    bytes[face_2 + 1] = 8;
    let expected = format!("mesh.ply, byte {face_2}: face 2 names vertex 8, but the file has 8 (counted from 0)");
    assert_eq!(error("ply", &bytes), expected);
    bytes.truncate(header + 17);
    let expected = format!("mesh.ply, byte {}: the file ends in `vertex` 1, at byte {}", header + 12, header + 17);
    assert_eq!(error("ply", &bytes), expected);
}

#[test]
fn strips_are_triangles() {
    let header = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                  element tristrips 1\nproperty list int int vertex_indices\n";
    let body = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
    let strip =
        |numbers: &str| loaded("ply", ply(header, &format!("{body}{numbers}\n"))).parts[0].triangles.indices.clone();
    assert_eq!(strip("4 0 1 2 3"), [[0, 1, 2], [1, 3, 2]]);
    // A new strip begins with its own first side; a vertex twice only joins.
    assert_eq!(strip("8 0 1 2 3 -1 2 1 0"), [[0, 1, 2], [1, 3, 2], [2, 1, 0]]);
    assert_eq!(strip("6 0 1 2 2 1 3"), [[0, 1, 2], [2, 3, 1]]);
    let both = header
        .replace("element tristrips", "element face 1\nproperty list uchar int vertex_indices\nelement tristrips");
    let file = loaded("ply", ply(&both, &format!("{body}3 0 1 3\n3 0 3 2\n")));
    assert_eq!((file.parts[0].triangles.indices.len(), file.notes.len()), (2, 0));
    let wrong = error("ply", ply(header, &format!("{body}3 0 1 4\n")));
    assert_eq!(wrong, "mesh.ply:14: strip 0 names vertex 4, but the file has 4 (counted from 0)");
}

#[test]
fn every_encoding_is_the_same_file() {
    let plain = write::ply_ascii();
    let expected = loaded("ply", &plain);
    let utf16: Vec<u8> = format!("\u{feff}{plain}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    for bytes in [format!("\u{feff}{plain}").into_bytes(), utf16, plain.replace('\n', "\r").into_bytes()] {
        assert_eq!(loaded("ply", &bytes), expected);
    }
    // Bytes after a header of carriage returns, of which the first may be a line feed.
    let head = write::ply_header("binary_little_endian");
    let mut bytes = head.replace('\n', "\r").into_bytes();
    bytes.extend(&write::ply_binary(false)[head.len()..]);
    bytes[head.len()] = b'\n';
    let first = f32::from_bits(u32::from(b'\n'));
    let file = loaded("ply", bytes);
    assert!(file.parts[0].triangles.positions.iter().any(|p| p.x == first), "the first number");
    assert_eq!(file.parts[0].triangles.indices.len(), 12);
}
