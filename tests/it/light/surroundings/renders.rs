//! Light from the texels at surfaces, against other ways to it.

use super::Picture;
use crate::common::paper::{HEAD, check};
use crate::common::{replicates, t_of_pairs};
use spectrel::fresnel::exact::reflect;
use spectrel::scene::Overrides;
use std::f64::consts::PI;

/// |t| beyond which one of three channels differs: 15 degrees of freedom, three comparisons, one failure in a thousand.
const CRITICAL: f64 = 4.6;

const BALL: &str = "[[objects]]\nmaterial = \"m\"\nshape.sphere = { radius = 1 }\n";

const MATERIALS: [(&str, &str); 5] = [
    ("grey", "materials.m.diffuse.reflectance = 0.5\n"),
    ("smooth gold", "materials.m.conductor = { ior = \"Au/olmon-2012-evaporated\" }\n"),
    ("rough gold", "materials.m.conductor = { ior = \"Au/olmon-2012-evaporated\", roughness = 0.2 }\n"),
    ("glass", "materials.m.dielectric = { ior = \"SCHOTT/sf11\" }\n"),
    ("rough glass", "materials.m.dielectric = { ior = 1.5, roughness = 0.3 }\n"),
];

fn ball(environment: &str, material: &str) -> String {
    format!("{HEAD}camera = {{ position = [0, -6, 2], look_at = [0, 0, 0], fov = 22 }}\n{environment}{material}{BALL}")
}

const SEEDS: u64 = 48;

fn renders(text: &str, samples: u32, lanes: u32) -> Vec<[f64; 3]> {
    replicates(text, &Overrides { samples: Some(samples), lanes: Some(lanes), ..Overrides::default() }, 0, SEEDS)
}

#[test]
fn a_constant_picture_lights_rough_gold_as_the_constant_environment() {
    constant_picture(&MATERIALS[2..3], &[8]);
}

#[test]
#[ignore = "long: five materials, three times 48 renders each"]
fn a_constant_picture_is_the_constant_environment() {
    constant_picture(&MATERIALS, &[1, 8]);
}

fn constant_picture(materials: &[(&str, &str)], lanes: &[u32]) {
    // Values that files and arithmetic hold exactly: 2.5 × 40.
    let picture = Picture::constant(16, 8, 2.5);
    let sky = picture.environment("scale = 40");
    let constant = |y: f64| format!("environment.constant = {{ spectrum = \"E\", luminance = {y} }}\n");
    for &(name, material) in materials {
        for &lanes in lanes {
            let samples = 2048 / lanes;
            let map = renders(&ball(&sky, material), samples, lanes);
            let (same, more) = (ball(&constant(100.0), material), ball(&constant(101.0), material));
            let (same, more) = (renders(&same, samples, lanes), renders(&more, samples, lanes));
            let off = |other: &[[f64; 3]]| {
                let mean =
                    |renders: &[[f64; 3]], i: usize| renders.iter().map(|xyz| xyz[i]).sum::<f64>() / SEEDS as f64;
                (0..3).map(|i| (mean(&map, i) / mean(other, i) - 1.0).abs()).fold(0.0, f64::max)
            };
            let t = t_of_pairs(&map, &same);
            println!("{name}, {lanes} lanes: t = {t:.1}, off by {:.1e}", off(&same));
            assert!(t < CRITICAL || off(&same) < 1e-5, "{name}, {lanes} lanes: t = {t:.1}, {:.1e}", off(&same));
            assert!(off(&same) < 1e-3, "{name}: {:.1e}", off(&same));
            assert!(t_of_pairs(&map, &more) > CRITICAL, "{name}: one per cent is seen");
        }
    }
}

/// A level grey plane from the side.
fn plane(environment: &str, objects: &str) -> String {
    format!(
        "{HEAD}camera = {{ position = [6, 0, 6], look_at = [0, 0, 0], fov = 0.05 }}
        {environment}
        materials.grey.diffuse.reflectance = 0.5
        {objects}
        [[objects]]\nmaterial = \"grey\"\nshape.rectangle = {{ size = [100, 100] }}"
    )
}

#[test]
fn a_bright_texel_lights_a_plane_for_eight_lanes() {
    bright_texel(&[8]);
}

#[test]
#[ignore = "long: lanes alone"]
fn one_bright_texel_lights_a_plane_as_its_solid_angle_says() {
    bright_texel(&[1]);
}

fn bright_texel(lanes: &[u32]) {
    // At the zenith, in the middle, across the horizon.
    for (width, height, texel) in [(64, 32, [0, 5]), (64, 32, [7, 40]), (31, 15, [7, 3]), (1, 1, [0, 0])] {
        let sky = Picture::bright(width, height, texel, 1000.0);
        for &lanes in lanes {
            check("texel", &plane(&sky.environment(""), ""), 256, lanes, 0.5 * sky.irradiance() / PI);
        }
    }
}

#[test]
fn a_sun_of_one_texel_keeps_its_energy_beside_the_sky_and_beside_a_lamp() {
    let mut sky = vec![[1.0; 3]; 1024 * 512];
    sky[1024 * 150 + 700] = [2e6; 3];
    let sky = Picture::new(1024, sky);
    let sun = 2e6 * sky.directions([150, 700]).map(|([_, _, z], part)| z * part).sum::<f64>();
    let expected = 0.5 * (sun + PI) / PI;
    check("sun and sky", &plane(&sky.environment(""), ""), 256, 8, expected);
    // A ball lamp of form factor 1/9, as strong; it hides no sun, but a part of the sky that it outshines.
    let lamp = "[[objects]]\nshape.sphere = { radius = 0.01, center = [0, 0, 3] }\nemission = { spectrum = \"E\", luminance = 1e6 }\n";
    let form_factor = 0.01f64.powi(2) / 9.0;
    let both = expected + 0.5 * (1e6 - 1.0) * form_factor;
    check("sun, sky and lamp", &plane(&sky.environment(""), lamp), 1024, 8, both);
}

#[test]
fn mirrors_and_glass_show_a_bright_texel_to_eight_lanes() {
    mirrors_and_glass(8);
}

#[test]
#[ignore = "long: lanes alone"]
fn mirrors_and_glass_show_a_bright_texel_as_it_is() {
    mirrors_and_glass(1);
}

fn mirrors_and_glass(lanes: u32) {
    // +y is the middle of this one.
    let sky = Picture::bright(63, 31, [15, 31], 1000.0);
    let grey = "materials.grey.diffuse.reflectance = 0.5\n";
    let mirror = "materials.m.conductor = { ior = { n = 1e-6, k = 1 } }\n[[objects]]\nmaterial = \"m\"\nshape.rectangle = { size = [9, 9], normal = [0, 1, 0] }\n";
    let pane =
        "materials.m.dielectric = { ior = 1.5 }\n[[objects]]\nmaterial = \"m\"\nshape.box = { size = [9, 1, 9] }\n";
    let camera = |y: f64| format!("{HEAD}camera = {{ position = [0, {y}, 0.001], look_at = [0, 0, 0], fov = 0.1 }}\n");
    let r = reflect(1.0, 1.5, 0.0, 1.0).r;
    // A lamp and a grey ball elsewhere, so that lights are sampled.
    let more = "[[objects]]\nmaterial = \"grey\"\nshape.sphere = { radius = 1, center = [90, 0, 0] }\n";
    let text = format!("{}{}{grey}{mirror}{more}", camera(5.0), sky.environment(""));
    check("mirror", &text, 2048 / lanes, lanes, 1000.0);
    let text = format!("{}{}{grey}{pane}{more}", camera(-5.0), sky.environment(""));
    check("pane", &text, 8192 / lanes, lanes, 1000.0 * (1.0 - r) / (1.0 + r));
}

#[test]
#[ignore = "long: light that few paths find"]
fn light_of_a_texel_comes_through_a_pane_onto_a_plane() {
    // No shadow ray comes through glass: only directions that the plane chooses find the texel, and it counts in full.
    let sky = Picture::bright(8, 4, [0, 6], 1000.0);
    let pane = "materials.m.dielectric = { ior = 1.5 }\n[[objects]]\nmaterial = \"m\"\nshape.box = { size = [10000, 10000, 1], center = [0, 0, 20] }\n";
    // Plane, two faces, light; so nothing is reflected twice.
    let text = plane(&sky.environment(""), pane).replace("filter = \"box\"", "filter = \"box\", max_depth = 3");
    let through: f64 = sky
        .directions([0, 6])
        .map(|([_, _, z], part)| {
            let r = reflect(1.0, 1.5, 0.0, z).r;
            (1.0 - r) * (1.0 - r) * z * part
        })
        .sum();
    check("through a pane", &text, 8192, 8, 0.5 * 1000.0 * through / PI);
}

#[test]
fn a_matt_ball_sees_a_sunny_sky_alike_by_either_way_of_finding_it() {
    either_way(&MATERIALS[..1]);
}

#[test]
#[ignore = "long: five materials"]
fn rough_metal_sees_a_sunny_sky_alike_by_either_way_of_finding_it() {
    either_way(&MATERIALS);
}

fn either_way(materials: &[(&str, &str)]) {
    // The same light from a gradient that only surfaces find: zenith 900, horizon 100, in narrow rows.
    let rows = 512;
    let row = |i: usize| {
        let z = (PI * (i as f64 + 0.5) / rows as f64).cos();
        100.0 + z.abs() * if z > 0.0 { 800.0 } else { -90.0 }
    };
    let sky = Picture::new(4, (0..4 * rows).map(|i| [row(i / 4) as f32; 3]).collect());
    let part = |name: &str, y: u32| format!("environment.gradient.{name} = {{ spectrum = \"E\", luminance = {y} }}\n");
    let gradient = &[part("zenith", 900), part("horizon", 100), part("nadir", 10)].concat();
    for &(name, material) in materials {
        let map = renders(&ball(&sky.environment(""), material), 1024, 8);
        let t = t_of_pairs(&map, &renders(&ball(gradient, material), 1024, 8));
        let mean = |renders: &[[f64; 3]]| renders.iter().map(|xyz| xyz[1]).sum::<f64>();
        let off = mean(&map) / mean(&renders(&ball(gradient, material), 1024, 8)) - 1.0;
        println!("{name}: t = {t:.1}, off by {off:.1e}");
        assert!(t < CRITICAL || off.abs() < 1e-4, "{name}: t = {t:.1}, {off:.1e}");
    }
}
