//! A brilliant as a mesh and as a convex solid: two ways for light through a stone, one picture.
//!
//! The solid is traced alone, from facet to facet with eight wavelengths at once, in single precision and without a tree; the mesh is
//! the same facets as a file of triangles, traced by rays that ask the whole scene, one wavelength each. The stone disperses and
//! absorbs, and 16 independent renders of each are compared in 16 regions. An index one per cent off must be rejected, and so must
//! an absorption five per cent off.

use crate::common::compare::{Apart, apart, renders};
use crate::common::files::{obj, ply};
use crate::common::meshes;
use crate::common::{film, lanes::with, scene};
use spectrel::geometry::Brilliant;

const SAMPLES: u32 = 64;

/// A stone on its own under a lamp and an uneven sky.
fn stone(shape: &str, ior: &str, absorption: f64) -> String {
    format!(
        "meters_per_unit = 0.001
        render = {{ width = 24, height = 24, filter = \"box\", samples = {SAMPLES} }}
        camera = {{ position = [0, -8, 9], look_at = [0, 0, 0.45], fov = 9.5 }}
        environment.gradient.zenith = {{ spectrum = \"D65\", luminance = 200 }}
        environment.gradient.horizon = {{ spectrum = \"A\", luminance = 60 }}
        environment.gradient.nadir = {{ spectrum = \"A\", luminance = 20 }}
        materials.stone.dielectric = {{ ior = {ior}, absorption = {absorption} }}
        [[objects]]
        shape.rectangle = {{ size = [6, 6], center = [0, 7, 8.4], normal = [0, -7, -8] }}
        emission = {{ spectrum = \"D65\", luminance = 500 }}
        [[objects]]
        material = \"stone\"
        {shape}
        transform.rotate = [0, 0, 10]\n"
    )
}

const DIAMOND: &str = "\"C/peter-1923\"";
const ABSORPTION: f64 = 150.0;
const CUT: &str = "shape.brilliant = { diameter = 2 }";

/// Two stones seen by seeds of their own.
fn compare(name: &str, [a, b]: [String; 2]) -> Apart {
    let [a, b] = [(a, 0..16), (b, 100..116)].map(|(text, seeds)| renders(&mut scene(&text, &with(8, SAMPLES)), seeds));
    let found = apart(&a, &b, [4, 4]);
    println!("{name}: {found:.4?}");
    found
}

#[test]
fn a_mesh_diamond_looks_like_the_convex_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = meshes::of_convex(&Brilliant { diameter: 2.0, ..Brilliant::default() }.solid().expect("a stone"));
    let [text, binary] = [obj(folder.path(), "stone", &mesh), ply(folder.path(), "stone", &mesh)]
        .map(|shape| stone(&shape, DIAMOND, ABSORPTION));
    let found = compare("mesh and solid", [stone(CUT, DIAMOND, ABSORPTION), text.clone()]);
    assert!(found.agrees() && found.relative < 0.01, "{found:?}");
    let [text, binary] = [text, binary].map(|text| film(&scene(&text, &with(8, 4))));
    assert!(text == binary, "one mesh in two files gives one picture");
}

#[test]
fn a_diamond_of_another_index_or_absorption_is_told_apart() {
    for (name, right, wrong) in [
        ("index", (2.417, ABSORPTION), (1.01 * 2.417, ABSORPTION)),
        ("absorption", (2.417, ABSORPTION), (2.417, 1.05 * ABSORPTION)),
    ] {
        let [right, wrong] = [right, wrong].map(|(n, absorption)| stone(CUT, &n.to_string(), absorption));
        let found = compare(name, [right, wrong]);
        assert!(!found.agrees(), "{name}: {found:?}");
    }
}
