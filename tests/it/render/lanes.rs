//! Lanes that share their random choices against wavelengths traced alone, by the spread of independent renders.

use crate::common::lanes::{RENDERS, ball, slab, solid, t_of_lanes, with};
use crate::common::{replicates, t_of_pairs};

/// |t| beyond which one of three channels differs: 15 degrees of freedom, three comparisons, one failure in a thousand.
const CRITICAL: f64 = 4.6;

fn diamond(material: &str) -> String {
    solid("shape.brilliant = { diameter = 2 }", material)
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
    for (name, t) in [("box", t_of_lanes(slab, SF11, SF11, 256)), ("ball", t_of_lanes(ball, SF11, SF11, 64))] {
        assert!(t < CRITICAL, "{name}: t = {t:.1}");
    }
}

#[test]
fn the_stone_test_sees_a_reflectance_one_per_cent_too_high() {
    for (name, t) in [
        ("diamond", t_of_lanes(diamond, &constant(2.417), &one_per_cent_brighter(2.417), 64)),
        ("glass", t_of_lanes(slab, &constant(1.78), &one_per_cent_brighter(1.78), 256)),
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
