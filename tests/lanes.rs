//! Lanes that share their random choices against wavelengths traced alone, by the spread of independent renders.

mod common;

use common::{replicates, t_of_pairs};
use spectrel::scene::Overrides;

/// |t| beyond which one of three channels differs: 15 degrees of freedom, three comparisons, one failure in a thousand.
const CRITICAL: f64 = 4.6;
const RENDERS: u64 = 16;

fn with(lanes: u32, samples: u32) -> Overrides {
    Overrides { lanes: Some(lanes), samples: Some(samples), ..Overrides::default() }
}

/// Lanes of eight against paths of one wavelength each, of the same scene but for the material given to the second.
fn t_of_lanes(scene: impl Fn(&str) -> String, material: &str, other: &str, samples: u32) -> f64 {
    let together = replicates(&scene(material), &with(8, samples), 0, RENDERS);
    let alone = replicates(&scene(other), &with(1, samples), 0, RENDERS);
    t_of_pairs(&together, &alone)
}

/// A solid that reflects a lamp into the camera and refracts the rest, on a dark ground that catches its colours.
fn solid(shape: &str, material: &str) -> String {
    format!(
        r#"
        meters_per_unit = 0.001
        render = {{ width = 24, height = 24 }}
        camera = {{ position = [0, -8, 9], look_at = [0, 0, 0.7], fov = 5.5 }}
        environment.gradient.zenith = {{ spectrum = "D65", luminance = 3 }}
        environment.gradient.horizon = {{ spectrum = "A", luminance = 1 }}
        environment.gradient.nadir = {{ spectrum = "A", luminance = 1 }}
        {material}
        [[objects]]
        shape.rectangle = {{ size = [4, 4], center = [0, 7, 8.4], normal = [0, -7, -8] }}
        emission = {{ spectrum = "D65", luminance = 500 }}
        [[objects]]
        material = "ground"
        shape.rectangle = {{ size = [30, 30], center = [0, 0, -0.01] }}
        [[objects]]
        material = "stone"
        {shape}
        [materials.ground]
        diffuse.reflectance = 0.02
        "#
    )
}

fn diamond(material: &str) -> String {
    solid("shape.brilliant = { diameter = 2 }", material)
}

fn glass(material: &str) -> String {
    solid("shape.box = { size = [6, 5, 0.7] }\ntransform = { rotate = [0, 0, 30], translate = [0, 0, 0.36] }", material)
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
    let t = t_of_lanes(diamond, DIAMOND, DIAMOND, 64);
    assert!(t < CRITICAL, "t = {t:.1}");
}

#[test]
fn lanes_of_sf11_agree_with_single_wavelengths() {
    for (name, t) in [("box", t_of_lanes(glass, SF11, SF11, 256)), ("ball", t_of_lanes(ball, SF11, SF11, 64))] {
        assert!(t < CRITICAL, "{name}: t = {t:.1}");
    }
}

#[test]
fn the_stone_test_sees_a_reflectance_one_per_cent_too_high() {
    for (name, t) in [
        ("diamond", t_of_lanes(diamond, &constant(2.417), &one_per_cent_brighter(2.417), 64)),
        ("glass", t_of_lanes(glass, &constant(1.78), &one_per_cent_brighter(1.78), 256)),
    ] {
        assert!(t > CRITICAL, "{name}: t = {t:.1}");
    }
}

/// Metals that light each other.
fn metals(material: &str) -> String {
    solid("shape.sphere = { radius = 0.8, center = [0, 0, 0.81] }", material)
}

const GOLD: &str = r#"materials.stone = { conductor = { ior = "Au/olmon-2012-evaporated", roughness = 0.2 } }"#;

#[test]
fn eight_lanes_and_one_agree_on_metal() {
    let t = t_of_lanes(metals, GOLD, GOLD, 64);
    assert!(t < CRITICAL, "t = {t:.1}");
    let four = replicates(&metals(GOLD), &with(4, 64), 0, RENDERS);
    let t = t_of_pairs(&four, &replicates(&metals(GOLD), &with(8, 64), 0, RENDERS));
    assert!(t < CRITICAL, "four lanes: t = {t:.1}");
}

#[test]
fn the_metal_test_sees_a_reflectance_one_per_cent_too_high() {
    // F0 = 0.81 against 0.8181 at every wavelength.
    let metal = |n: f64| format!("materials.stone = {{ conductor = {{ ior = {n}, roughness = 0.2 }} }}");
    let n = |f0: f64| (1.0 + f0.sqrt()) / (1.0 - f0.sqrt());
    let t = t_of_lanes(metals, &metal(n(0.81)), &metal(n(0.8181)), 64);
    assert!(t > CRITICAL, "t = {t:.1}");
}
