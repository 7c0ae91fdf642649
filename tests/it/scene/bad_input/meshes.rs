//! Mesh files that are missing, broken or say what cannot be.

use super::*;

const TETRAHEDRON: &str =
    "o Tip\nusemtl Metal\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

fn mesh(keys: &str) -> String {
    scene_with(&format!("[[objects]]\nmaterial = \"gold\"\nshape.mesh = {keys}\n"))
}

#[test]
fn meshes_that_are_missing_or_broken() {
    type Files<'a> = &'a [(&'a str, &'a str)];
    let cases: &[(&str, Files, &[&str])] = &[
        ("{ file = §\"none.obj\" }", &[], &["none.obj"]),
        ("{ file = §\"ring.step\" }", &[("ring.step", "ISO-10303")], &["obj", "ply", "stl", "gltf", "glb"]),
        ("{ file = §\"a.obj\" }", &[("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")], &["no face"]),
        ("{ file = §\"a.obj\" }", &[("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n")], &["a.obj:3", "9"]),
        ("{ file = §\"a.obj\" }", &[("a.obj", "v 0 0 0\nv 1 zero 0\n")], &["a.obj:2"]),
        ("{ file = §\"a.ply\" }", &[("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n")], &["a.ply"]),
        ("{ file = §\"a.obj\" }", &[("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")], &["a.obj"]),
        ("{ file = §\"a.glb\" }", &[("a.glb", "glTF")], &["a.glb"]),
        ("{ file = \"t.obj\", part = §\"Top\" }", &[("t.obj", TETRAHEDRON)], &["no part `Top`", "did you mean `Tip`?"]),
        ("{ file = \"t.obj\", crease_angle = §200 }", &[("t.obj", TETRAHEDRON)], &["0 … 180"]),
        ("{ §fil = \"t.obj\" }", &[("t.obj", TETRAHEDRON)], &["file"]),
    ];
    for (keys, files, says) in cases {
        refused_at_mark(&mesh(keys), files, says);
    }
}

#[test]
fn materials_that_only_a_file_knows() {
    let scene = scene_with("[[objects]]\nshape.mesh = { file = \"t.obj\" }\n");
    let outcome = render(scene, &[("t.obj", TETRAHEDRON)], &["-q"]);
    assert_refused(&outcome, &["this file calls a material `Metal`", "[replace]", "`material = "]);
    let scene = scene_with("[[objects]]\nshape.mesh = { file = \"t.obj\" }\n[replace]\n\"Metal\" = §\"golt\"\n");
    refused_at_mark(&scene, &[("t.obj", TETRAHEDRON)], &["golt", "gold"]);
}

#[test]
fn transforms_that_flatten_a_mesh() {
    let scene = mesh("{ file = \"t.obj\" }\ntransform = §{ scale = [1, 1, 0] }");
    refused_at_mark(&scene, &[("t.obj", TETRAHEDRON)], &["no inverse"]);
    let scene = mesh("{ file = \"t.obj\" }\ncopies = [{ scale = 1 }, §{ scale = [0, 1, 1] }]");
    refused_at_mark(&scene, &[("t.obj", TETRAHEDRON)], &["no inverse"]);
}

#[test]
fn extensions_that_are_required_and_unknown() {
    let gltf =
        r#"{ "asset": { "version": "2.0" }, "extensionsRequired": ["KHR_draco_mesh_compression"], "meshes": [] }"#;
    refused_at_mark(&mesh("{ file = §\"a.gltf\" }"), &[("a.gltf", gltf)], &["KHR_draco_mesh_compression"]);
}

#[test]
fn triangles_without_area_are_counted() {
    let with_sliver = format!("{TETRAHEDRON}f 1 2 2\nv nan 0 0\nf 1 2 5\n");
    let outcome = render(mesh("{ file = \"t.obj\" }"), &[("t.obj", &with_sliver)], &[]);
    assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("skipped"), "{}", outcome.stderr);
}
