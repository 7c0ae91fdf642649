//! What STL has of its own.

use super::write;
use super::*;

#[test]
fn a_binary_file_may_begin_with_solid() {
    for head in ["solid", "solid cube\r\n", "binary", ""] {
        let file = loaded("stl", write::stl_cube(head));
        assert_eq!(placed(&file).len(), 12, "{head}");
        assert_eq!(file.parts[0].name, "mesh");
    }
    // Cut short, its size no longer tells, but its bytes do.
    let mut bytes = write::stl_cube("solid cube");
    bytes.truncate(84 + 50 * 7 + 3);
    assert_eq!(error("stl", bytes), "mesh.stl, byte 437: the file ends in triangle 7 of 12");
}

#[test]
fn vertices_are_joined_by_their_bits() {
    let [a, b, c, d] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let next = 1.0_f32.next_up();
    let facets = [[a, b, c], [[-0.0, 0.0, -0.0], c, d], [a, [next, 0.0, 0.0], c]];
    let triangles = loaded("stl", write::stl_binary("", &facets)).parts[0].triangles.clone();
    assert_eq!(triangles.indices, [[0, 1, 2], [0, 2, 3], [0, 4, 2]]);
    assert_eq!(triangles.positions.len(), 5);
}

#[test]
fn normals_that_contradict_are_counted() {
    let text = write::stl_ascii();
    // The first facet lies in z = 0 and looks down.
    let down = text.replacen("normal 0 0 0", "normal 0 0 -1", 1);
    assert_eq!(loaded("stl", down).notes, Vec::<String>::new());
    let up = text.replacen("normal 0 0 0", "normal 0 0 1", 1);
    let file = loaded("stl", up);
    assert_eq!(file.notes, ["1 facet normal of `a cube` points against the order of its corners, which counts"]);
    assert!((volume(&placed(&file)) - 1.0).abs() < 1e-12);
}

#[test]
fn solids_of_a_text_are_parts() {
    let two = write::stl_ascii() + &write::stl_ascii().replace("a cube", "").to_uppercase();
    let file = loaded("stl", two);
    let names: Vec<_> = file.parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["a cube", "mesh"]);
    assert_eq!(placed(&file).len(), 24);
}

#[test]
fn mistakes_have_their_place() {
    let text = write::stl_ascii();
    let wrong = |from: &str, to: &str, expected: &str| assert_eq!(error("stl", text.replacen(from, to, 1)), expected);
    wrong("outer loop", "loop", "mesh.stl:3: `loop`, expected `outer`");
    wrong("vertex 0 0 0", "vertex 0 zero 0", "mesh.stl:4: `zero` is not a number");
    let far = error("stl", text.replacen("vertex 0 0 0", "vertex 0 1e16 0", 1));
    assert!(far.starts_with("mesh.stl:4: a coordinate is 1e16; single precision wants "), "{far}");
    wrong("endloop", "vertex 1 1 1", "mesh.stl:7: `vertex`, expected `endloop`");
    wrong("endsolid a cube\n", "", "mesh.stl:85: the file ends, expected `facet` or `endsolid`");
    assert_eq!(
        error("stl", "solid x\nendsolid x\n"),
        "mesh.stl: the file has no face to show: `x` has no faces and was dropped"
    );
    assert_eq!(error("stl", "short"), "mesh.stl: the file ends after 5 bytes, in the head of 84");
    let far = write::stl_binary("", &[[[0.0; 3], [1.0; 3], [2e15, 0.0, 0.0]]]);
    assert!(error("stl", far).starts_with("mesh.stl, byte 84: triangle 0: a coordinate is 1.999999973982208e15; "));
    let mut longer = write::stl_cube("");
    longer.extend([0; 60]);
    assert_eq!(loaded("stl", longer).notes, ["60 bytes follow the last triangle"]);
}

#[test]
fn normals_may_be_no_numbers_in_any_spelling() {
    let text = write::stl_ascii();
    let expected = loaded("stl", &text);
    for odd in ["-nan(ind)", "-1.#IND", "1.#QNAN", "nan", "-NaN", "1.#INF", "nan(0x8000)"] {
        let file = loaded("stl", text.replacen("normal 0 0 0", &format!("normal {odd} {odd} {odd}"), 3));
        assert_eq!(file, expected, "{odd}");
    }
    assert_eq!(error("stl", text.replacen("normal 0 0 0", "normal up 0 0", 1)), "mesh.stl:2: `up` is not a number");
    let wrong = error("stl", text.replacen("vertex 0 0 0", "vertex -1.#IND 0 0", 1));
    assert_eq!(wrong, "mesh.stl:4: `-1.#IND` is not a number");
}

#[test]
fn every_encoding_is_the_same_file() {
    let plain = write::stl_ascii();
    let expected = loaded("stl", &plain);
    let utf16: Vec<u8> = format!("\u{feff}{plain}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    for bytes in [format!("\u{feff}{plain}").into_bytes(), utf16, plain.replace('\n', "\r").into_bytes()] {
        assert_eq!(loaded("stl", &bytes), expected);
    }
}
