//! Lanes that share their random choices against wavelengths traced alone, by the spread of independent renders.

mod common;

use common::{replicates, z_between};
use spectrel::scene::Overrides;

/// |z| beyond which one of three channels differs: Welch with 15–30 degrees of freedom, one failure in a thousand.
const CRITICAL: f64 = 4.2;
const RENDERS: u64 = 16;

fn with(lanes: u32, samples: u32) -> Overrides {
    Overrides { lanes: Some(lanes), samples: Some(samples), ..Overrides::default() }
}

/// Lanes of eight against paths of one wavelength each, of the same scene but for the material given to the second.
fn z_of_lanes(scene: impl Fn(&str) -> String, material: &str, other: &str, samples: u32) -> f64 {
    let together = replicates(&scene(material), &with(8, samples), 0, RENDERS);
    let alone = replicates(&scene(other), &with(1, 2 * samples), 1000, RENDERS);
    z_between(&together, &alone)
}

/// A solid that reflects and refracts a lamp above into the camera, on a ground that catches its colours.
fn solid(shape: &str, material: &str) -> String {
    format!(
        r#"
        meters_per_unit = 0.001
        render = {{ width = 24, height = 24 }}
        camera = {{ position = [0, -8, 9], look_at = [0, 0, 0.4], fov = 16 }}
        environment.gradient.zenith = {{ spectrum = "D65", luminance = 300 }}
        environment.gradient.horizon = {{ spectrum = "A", luminance = 20 }}
        environment.gradient.nadir = {{ spectrum = "A", luminance = 1 }}
        {material}
        [[objects]]
        shape.rectangle = {{ size = [4, 4], center = [2, 3, 6], normal = [-1, -1.5, -3] }}
        emission = {{ spectrum = "D65", luminance = 500 }}
        [[objects]]
        material = "ground"
        shape.rectangle = {{ size = [30, 30], center = [0, 0, -0.01] }}
        [[objects]]
        material = "stone"
        {shape}
        [materials.ground]
        diffuse.reflectance = 0.5
        "#
    )
}

fn diamond(material: &str) -> String {
    solid("shape.brilliant = { diameter = 2 }", material)
}

fn glass(material: &str) -> String {
    solid("shape.box = { size = [1.4, 1.0, 0.7] }\ntransform = { rotate = [0, 0, 30], translate = [0, 0, 0.36] }", material)
}

fn ball(material: &str) -> String {
    solid("shape.sphere = { radius = 0.8, center = [0, 0, 0.81] }", material)
}

const DIAMOND: &str = r#"materials.stone = { dielectric = { ior = "C/peter-1923" } }"#;
const SF11: &str = r#"materials.stone = { dielectric = { ior = "SCHOTT/sf11" } }"#;

/// n with F0 one per cent above that of `n`.
fn one_per_cent_brighter(n: f64) -> String {
    let r = (1.01f64).sqrt() * (n - 1.0) / (n + 1.0);
    format!("materials.stone = {{ dielectric = {{ ior = {} }} }}", (1.0 + r) / (1.0 - r))
}

fn constant(n: f64) -> String {
    format!("materials.stone = {{ dielectric = {{ ior = {n} }} }}")
}

#[test]
fn lanes_of_a_diamond_agree_with_single_wavelengths() {
    let z = z_of_lanes(diamond, DIAMOND, DIAMOND, 64);
    assert!(z < CRITICAL, "z = {z:.1}");
}

#[test]
fn lanes_of_sf11_agree_with_single_wavelengths() {
    for (name, z) in [("box", z_of_lanes(glass, SF11, SF11, 64)), ("ball", z_of_lanes(ball, SF11, SF11, 64))] {
        assert!(z < CRITICAL, "{name}: z = {z:.1}");
    }
}

#[test]
fn the_stone_test_sees_a_reflectance_one_per_cent_too_high() {
    for (name, z) in [
        ("diamond", z_of_lanes(diamond, &constant(2.417), &one_per_cent_brighter(2.417), 64)),
        ("glass", z_of_lanes(glass, &constant(1.78), &one_per_cent_brighter(1.78), 64)),
    ] {
        assert!(z > CRITICAL, "{name}: z = {z:.1}");
    }
}

/// Metals that light each other.
fn metals(material: &str) -> String {
    solid("shape.sphere = { radius = 0.8, center = [0, 0, 0.81] }", material)
}

const GOLD: &str = r#"materials.stone = { conductor = { ior = "Au/olmon-2012-evaporated", roughness = 0.2 } }"#;

#[test]
fn eight_lanes_and_one_agree_on_metal() {
    let z = z_of_lanes(metals, GOLD, GOLD, 64);
    assert!(z < CRITICAL, "z = {z:.1}");
    let four = replicates(&metals(GOLD), &with(4, 64), 0, RENDERS);
    let z = z_between(&four, &replicates(&metals(GOLD), &with(8, 64), 500, RENDERS));
    assert!(z < CRITICAL, "four lanes: z = {z:.1}");
}

#[test]
fn the_metal_test_sees_a_reflectance_one_per_cent_too_high() {
    // F0 = 0.81 against 0.8181 at every wavelength.
    let metal = |n: f64| format!("materials.stone = {{ conductor = {{ ior = {n}, roughness = 0.2 }} }}");
    let n = |f0: f64| (1.0 + f0.sqrt()) / (1.0 - f0.sqrt());
    let z = z_of_lanes(metals, &metal(n(0.81)), &metal(n(0.8181)), 64);
    assert!(z > CRITICAL, "z = {z:.1}");
}
