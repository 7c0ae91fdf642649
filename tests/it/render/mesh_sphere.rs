//! Balls of 1.3 million triangles and balls by formula: one picture.
//!
//! A still life of three, smooth gold, rough gold and glass, each with the others' reflections in it; the mesh is an icosahedron
//! cut eight times, with the ball's normals, read from one binary PLY file. Its triangles are 0.003 wide, so its outline and its
//! glass are within 1e-6 of the ball's. Sixteen independent renders of each, in 12 regions; other metals, another roughness and another
//! glass one per cent off must be rejected.

use crate::common::compare::{Apart, apart, renders};
use crate::common::files::ply;
use crate::common::meshes;
use crate::common::{lanes::with, scene};
use spectrel::film::Film;
use spectrel::geometry::Triangles;

const SAMPLES: u32 = 96;

/// What the balls are of: gold's n and k are multiplied, and so are roughness and the index of glass.
struct Stuff {
    gold: f64,
    roughness: f64,
    glass: f64,
}

const RIGHT: Stuff = Stuff { gold: 1.0, roughness: 1.0, glass: 1.0 };

fn still_life(shape: &str, stuff: &Stuff) -> String {
    let ball = |material: &str, x: f64, y: f64| {
        format!("[[objects]]\nmaterial = \"{material}\"\n{shape}\ntransform.translate = [{x}, {y}, 0]\n")
    };
    let (n, k) = (0.35 * stuff.gold, 2.7 * stuff.gold);
    format!(
        "meters_per_unit = 1
        render = {{ width = 36, height = 12, filter = \"box\", samples = {SAMPLES} }}
        camera = {{ position = [0, -12, 4], look_at = [0, 0, 0], fov = 32 }}
        environment.gradient.zenith = {{ spectrum = \"D65\", luminance = 200 }}
        environment.gradient.horizon = {{ spectrum = \"A\", luminance = 60 }}
        environment.gradient.nadir = {{ spectrum = \"A\", luminance = 20 }}
        materials.smooth.conductor.ior = {{ n = {n}, k = {k} }}
        materials.rough.conductor = {{ ior = {{ n = {n}, k = {k} }}, roughness = {} }}
        materials.glass.dielectric = {{ ior = {}, absorption = 0.2 }}
        [[objects]]
        shape.rectangle = {{ size = [8, 8], center = [0, -6, 8], normal = [0, 6, -8] }}
        emission = {{ spectrum = \"D65\", luminance = 300 }}
        {}{}{}",
        0.3 * stuff.roughness,
        1.5 * stuff.glass,
        ball("smooth", -2.2, 0.0),
        ball("rough", 0.0, 0.3),
        ball("glass", 2.2, 0.0),
    )
}

/// A ball whose normals are its corners.
fn fine_ball() -> Triangles {
    let ball = meshes::icosphere(8);
    Triangles { normals: ball.positions.clone(), ..ball }
}

const FORMULA: &str = "shape.sphere = { radius = 1 }";

fn pictures(shape: &str, stuff: &Stuff, first: u64) -> Vec<Film> {
    renders(&mut scene(&still_life(shape, stuff), &with(8, SAMPLES)), first..first + 16)
}

fn compare(name: &str, a: &[Film], b: &[Film]) -> Apart {
    let found = apart(a, b, [6, 2]);
    println!("{name}: {found:.4?}");
    found
}

#[test]
fn balls_of_a_million_triangles_look_like_balls() {
    let folder = tempfile::tempdir().expect("a folder");
    let ball = fine_ball();
    assert!(ball.indices.len() > 1_000_000);
    let shape = ply(folder.path(), "ball", &ball);
    let formula = pictures(FORMULA, &RIGHT, 0);
    let mesh = pictures(&shape, &RIGHT, 100);
    let found = compare("mesh and formula", &formula, &mesh);
    assert!(found.agrees() && found.relative < 5e-3, "{found:?}");
    for (name, wrong) in [
        ("gold 1 % off", Stuff { gold: 1.01, ..RIGHT }),
        ("roughness 3 % off", Stuff { roughness: 1.03, ..RIGHT }),
        ("glass 1 % off", Stuff { glass: 1.01, ..RIGHT }),
    ] {
        let found = compare(name, &pictures(FORMULA, &wrong, 0), &mesh);
        assert!(!found.agrees(), "{name}: {found:?}");
    }
    // The counter-check of the shape: a ball of 1280 flat triangles.
    let coarse = ply(folder.path(), "coarse", &meshes::icosphere(3));
    let found = compare("1280 triangles", &formula, &pictures(&coarse, &RIGHT, 100));
    assert!(!found.agrees(), "{found:?}");
}
