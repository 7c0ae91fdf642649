//! Stones half under water, and water seen from within, against what Fresnel and Snell say on paper.
//!
//! Radiance over n² is what refraction keeps (F. E. Nicodemus, "Radiance", Am. J. Phys. 31, 1963): a sky of radiance L is n²(1 − R)L
//! to a diver within the window of sin θ < 1/n, 48.6° wide for water (n_D = 1.3330: CRC Handbook), and beyond it the surface is a
//! perfect mirror of the ground.

use crate::common::files::obj;
use crate::common::meshes;
use crate::common::plates::{Layer, check, check_by, fresnel, looking, pile};
use crate::common::{lanes::with, library, scene};
use glam::DVec3;
use spectrel::geometry::Brilliant;
use std::path::Path;

const DIAMOND: (f64, f64) = (2.42, 0.1);
const WATER: (f64, f64) = (4.0 / 3.0, 0.02);

fn materials() -> String {
    let ((stone, stone_absorbs), (water, water_absorbs)) = (DIAMOND, WATER);
    format!(
        "materials.diamond.dielectric = {{ ior = {stone}, absorption = {stone_absorbs} }}
        materials.water.dielectric = {{ ior = {water}, absorption = {water_absorbs} }}\n"
    )
}

fn lamp(center: DVec3, normal: DVec3, luminance: f64) -> String {
    let (center, normal) = (center.to_array(), normal.to_array());
    format!(
        "[[objects]]\nshape.rectangle = {{ size = [150, 150], center = {center:?}, normal = {normal:?} }}
        emission = {{ spectrum = \"E\", luminance = {luminance} }}\n"
    )
}

/// A lamp through a solid and whatever is around it, at normal incidence.
fn through(name: &str, objects: &str, from: DVec3, lamp_at: DVec3, layers: &[Layer], wrong: &[&[Layer]]) {
    let lamp = lamp(lamp_at, (from - lamp_at).normalize(), 100.0);
    let text = format!("{}{}{objects}{lamp}", looking(from, lamp_at, 160), materials());
    let light = |layers: &[Layer]| 100.0 * pile(1.0, layers, 1.0, 1.0).t;
    let wrong: Vec<f64> = wrong.iter().map(|layers| light(layers)).collect();
    check_by(64, name, &mut scene(&text, &with(8, 160)), light(layers), &wrong);
}

fn layer((n, absorption): (f64, f64), thickness: f64) -> Layer {
    (n, absorption, thickness)
}

/// Its surface is the plane z = 0.
const LAKE: &str = "[[objects]]\nmaterial = \"water\"\nshape.box = { size = [100, 100, 5], center = [0, 0, -2.5] }\n";

#[test]
#[ignore = "long: many seconds of paths"]
fn a_block_of_diamond_half_under_water_is_in_two_media() {
    let block = "[[objects]]\nmaterial = \"diamond\"\nshape.box = { size = [2, 2, 2] }\n";
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = obj(folder.path(), "block", &crate::common::files::cuboid([0.0; 3], [2.0; 3]));
    let mesh = format!("[[objects]]\nmaterial = \"diamond\"\n{mesh}\n");
    let stone = layer(DIAMOND, 2.0);
    for (kind, block) in [("box", block), ("mesh", &mesh)] {
        let objects = format!("{LAKE}{block}");
        let up = 20.0 * DVec3::Z;
        let down = [stone, layer(WATER, 4.0)];
        let dry = [stone, (1.0, 0.0, 1.0), layer(WATER, 4.0)];
        through(&format!("{kind}, from above"), &objects, up, -up, &down, &[&[stone], &dry]);
        through(&format!("{kind}, from below"), &objects, -up, up, &down, &[&[stone], &dry]);
        let aside = |z: f64| (DVec3::new(70.0, 0.1, z), DVec3::new(-70.0, 0.1, z));
        let (from, to) = aside(0.5);
        let wet = [layer(WATER, 49.0), stone, layer(WATER, 49.0)];
        through(&format!("{kind}, above water"), &objects, from, to, &[stone], &[&wet]);
        let (from, to) = aside(-0.5);
        let air = [layer(WATER, 49.0), (1.0, 0.0, 1.0), stone, (1.0, 0.0, 1.0), layer(WATER, 49.0)];
        through(&format!("{kind}, under water"), &objects, from, to, &wet, &[&[stone], &air]);
    }
}

/// Straight down through table and culet, and straight up.
#[test]
fn a_brilliant_half_under_water_is_in_two_media() {
    let cut = Brilliant { diameter: 2.0, culet: 0.2, ..Brilliant::default() };
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = obj(folder.path(), "brilliant", &meshes::of_convex(&cut.solid().expect("a stone")));
    let height = cut.height();
    for (kind, shape) in [("brilliant", "shape.brilliant = { diameter = 2, culet = 0.2 }"), ("mesh", &mesh)] {
        let objects =
            format!("{LAKE}[[objects]]\nmaterial = \"diamond\"\n{shape}\ntransform.translate = [0, 0, -0.5]\n");
        let (stone, up) = (layer(DIAMOND, height), 20.0 * DVec3::Z);
        let layers = [stone, layer(WATER, 4.5)];
        let dry = [stone, (1.0, 0.0, 1.0), layer(WATER, 4.5)];
        through(&format!("{kind}, from above"), &objects, up, -up, &layers, &[&[stone], &dry]);
        through(&format!("{kind}, from below"), &objects, -up, up, &layers, &[&[stone], &dry]);
    }
}

/// A deep lake with a glowing ground, seen from within, looking up at an angle against the vertical.
fn dive(lake: &str, degrees: f64, sky: &str, over: &str) -> String {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let from = 9.0 * DVec3::new(sin, 0.0, -cos);
    let ground = lamp(-15.0 * DVec3::Z, DVec3::Z, 50.0);
    format!("{}{sky}{lake}{over}{ground}", looking(from, DVec3::ZERO, 64))
}

fn lakes(folder: &Path, ior: &str) -> [(&'static str, String); 2] {
    let material =
        format!("materials.w.dielectric = {{ ior = {ior}, absorption = 0 }}\n[[objects]]\nmaterial = \"w\"\n");
    let mesh = obj(folder, "lake", &crate::common::files::cuboid([0.0, 0.0, -10.0], [160.0, 160.0, 20.0]));
    [
        ("box", format!("{material}shape.box = {{ size = [160, 160, 20], center = [0, 0, -10] }}\n")),
        ("mesh", format!("{material}{mesh}\n")),
    ]
}

#[test]
fn a_diver_sees_the_sky_in_a_window() {
    let folder = tempfile::tempdir().expect("a folder");
    const N: f64 = 4.0 / 3.0;
    let sky = "environment.constant = { spectrum = \"E\", luminance = 100 }\n";
    for (kind, lake) in lakes(folder.path(), &N.to_string()) {
        for degrees in [0.0, 30.0, 45.0, 48.0f64] {
            let (r, _) = fresnel(N, 1.0, degrees.to_radians().cos());
            let (right, plain) = (N * N * 100.0 * (1.0 - r) + 50.0 * r, 100.0 * (1.0 - r) + 50.0 * r);
            let mut scene = scene(&dive(&lake, degrees, sky, ""), &with(8, 64));
            check(&format!("{kind}, sky at {degrees}°"), &mut scene, right, &[plain, 1.01 * right]);
        }
        for degrees in [49.2f64, 60.0, 75.0] {
            let mut scene = scene(&dive(&lake, degrees, sky, ""), &with(8, 64));
            check(&format!("{kind}, mirror at {degrees}°"), &mut scene, 50.0, &[50.1]);
        }
    }
}

#[test]
fn the_window_of_water_ends_at_its_critical_angle() {
    let folder = tempfile::tempdir().expect("a folder");
    let n = library().ior("H2O/daimon-2007-20c", Path::new("")).expect("in the library").n.at(589.3);
    let critical = (1.0 / n).asin().to_degrees();
    assert!((critical - 48.6).abs() < 0.05, "{critical}");
    let sky = "environment.constant = { spectrum = { lines = [[589.3, 1]] }, luminance = 100 }\n";
    for (kind, lake) in lakes(folder.path(), "\"H2O/daimon-2007-20c\"") {
        let light = |degrees: f64| {
            let text = dive(&lake, degrees, sky, "").replace("luminance = 50", "luminance = 0");
            crate::common::mean(&crate::common::film(&scene(&text, &with(8, 64))))[1]
        };
        let (inside, outside) = (light(critical - 0.01), light(critical + 0.01));
        println!("{kind}: {inside} and {outside} a hundredth of a degree on either side of {critical:.3}°");
        let (r, _) = fresnel(n, 1.0, (critical - 0.01).to_radians().cos());
        assert!((inside / (n * n * 100.0 * (1.0 - r)) - 1.0).abs() < 0.05, "{kind}: {inside}");
        assert_eq!(outside, 0.0, "{kind}");
    }
}

#[test]
fn a_lamp_over_water_is_brighter_to_a_diver_by_the_square_of_the_index() {
    let folder = tempfile::tempdir().expect("a folder");
    const N: f64 = 4.0 / 3.0;
    let over = lamp(7.0 * DVec3::Z, DVec3::NEG_Z, 100.0);
    for (kind, lake) in lakes(folder.path(), &N.to_string()) {
        for degrees in [0.0, 30.0f64] {
            let (r, _) = fresnel(N, 1.0, degrees.to_radians().cos());
            let right = N * N * 100.0 * (1.0 - r) + 50.0 * r;
            let mut scene = scene(&dive(&lake, degrees, "", &over), &with(8, 64));
            check(&format!("{kind}, lamp at {degrees}°"), &mut scene, right, &[right / N / N, right / N]);
        }
    }
}
