//! Furnaces: a scene in which all light has the same radiance shows what surfaces lose, and nothing else.

use crate::common::{replicates, z_against};
use spectrel::bsdf::albedo::albedo;
use spectrel::fresnel::exact;
use spectrel::scene::Overrides;
use spectrel::spectrum::{Observer, Outside, Spectrum, Table, tristimulus};
use std::path::Path;

/// |z| beyond which one of three channels is wrong: 15 degrees of freedom, three comparisons, one failure in a thousand.
const CRITICAL: f64 = 4.6;

fn furnace(objects: &str) -> String {
    format!(
        r#"
        meters_per_unit = 1
        render = {{ width = 24, height = 24, samples = 64, filter = "box" }}
        camera = {{ position = [0, -20, 7], look_at = [0, 0, 0], fov = 6 }}
        environment.constant = {{ spectrum = "E", luminance = 100 }}
        {objects}
        "#
    )
}

/// XYZ of the furnace's walls, cd/m².
fn walls() -> [f64; 3] {
    let observer = crate::common::library().observer(Observer::Cie1931).expect("built in");
    let light = crate::common::library().illuminant("E", Path::new("")).expect("built in");
    let xyz = tristimulus(&[&light.spectrum], &observer);
    xyz.map(|value| value / xyz[1] * 100.0)
}

fn z_in_furnace(objects: &str) -> f64 {
    z_against(&replicates(&furnace(objects), &Overrides::default(), 0, 16), walls())
}

/// Means and largest deviation from the walls, relative: for what is so nearly exact that it has no noise to speak of.
fn error_in_furnace(objects: &str) -> f64 {
    let (renders, walls) = (replicates(&furnace(objects), &Overrides::default(), 0, 16), walls());
    let error = |i: usize| renders.iter().map(|xyz| xyz[i]).sum::<f64>() / 16.0 / walls[i] - 1.0;
    (0..3).map(|i| error(i).abs()).fold(0.0, f64::max)
}

const STONES: [(&str, &str); 4] = [
    ("glass sphere", r#"objects = [{ material = "fused-silica", shape.sphere = { radius = 1 } }]"#),
    (
        "diamond",
        r#"objects = [{ material = "diamond", shape.brilliant = { diameter = 2 }, transform.translate = [0, 0, -0.5] }]"#,
    ),
    (
        "box of SF11 that does not absorb",
        r#"
        materials.sf11 = { dielectric = { ior = "SCHOTT/sf11", absorption = 0 } }
        objects = [{ material = "sf11", shape.box = { size = [1.5, 1.5, 1] }, transform.rotate = [10, 20, 30] }]"#,
    ),
    ("stone cut in steps", r#"objects = [{ material = "sapphire", shape.step-cut = { width = 1.5, length = 2 } }]"#),
];

#[test]
fn clear_solids_are_invisible() {
    for (name, objects) in STONES {
        let (z, error) = (z_in_furnace(objects), error_in_furnace(objects));
        println!("{name} in a furnace: z = {z:.1}, off by {error:.1e}");
        assert!(z < CRITICAL || error < 2e-6, "{name}: z = {z:.1}, relative error {error:.1e}");
    }
}

#[test]
fn a_solid_that_absorbs_a_thousandth_is_seen() {
    let objects = r#"
        materials.glass = { dielectric = { ior = "SiO2/malitson-1965", absorption = 0.001 } }
        objects = [{ material = "glass", shape.sphere = { radius = 1 } }]"#;
    assert!(error_in_furnace(objects) > 1e-4);
    assert!(z_in_furnace(objects) > CRITICAL);
}

const ALPHA: f64 = 0.4;

/// XYZ, as a share of the walls', of a rough gold sphere: the directional albedo at each pixel's angle, for F times a factor.
fn gold_sphere(factor: f64) -> [f64; 3] {
    let library = crate::common::library();
    let gold = library.ior("Au/olmon-2012-evaporated", Path::new("")).expect("in the library");
    let observer = library.observer(Observer::Cie1931).expect("built in");
    let light = library.illuminant("E", Path::new("")).expect("built in");
    let distance = (20.0f64 * 20.0 + 7.0 * 7.0).sqrt();
    let half = 3.0f64.to_radians().tan();
    // Cosines over the picture, from a grid far finer than its pixels; the sphere fills it.
    let grid = 96;
    let at = |i: usize| half * (2.0 * (i as f64 + 0.5) / f64::from(grid) - 1.0);
    let cosines: Vec<f64> = (0..grid as usize * grid as usize)
        .map(|i| {
            let (x, y) = (at(i % grid as usize), at(i / grid as usize));
            let sin = (x * x + y * y).sqrt() / (1.0 + x * x + y * y).sqrt() * distance / RADIUS;
            (1.0 - sin * sin).sqrt()
        })
        .collect();
    // The albedo is smooth in wavelength and angle: every 5 nm, and a table over cosines.
    let steps = 64;
    let (low, high) = (cosines.iter().copied().fold(1.0, f64::min), 1.0);
    let mean_albedo = |nm: f64| {
        let (n, k) = gold.at(nm);
        let f = |cos: f64| factor * exact::reflect(1.0, n, k, cos).r;
        let table: Vec<f64> =
            (0..=steps).map(|i| albedo(ALPHA, low + (high - low) * f64::from(i) / f64::from(steps), f)).collect();
        let look_up = |cos: f64| {
            let at = (cos - low) / (high - low) * f64::from(steps);
            let cell = (at as usize).min(steps as usize - 1);
            table[cell] + (table[cell + 1] - table[cell]) * (at - cell as f64)
        };
        cosines.iter().map(|&cos| look_up(cos)).sum::<f64>() / cosines.len() as f64
    };
    let points: Vec<(f64, f64)> =
        (0..=94).map(|i| 360.0 + 5.0 * f64::from(i)).map(|nm| (nm, mean_albedo(nm))).collect();
    let spectrum = Spectrum::Table(Table::from_points(&points, Outside::Hold));
    let whole = tristimulus(&[&light.spectrum], &observer);
    let reflected = tristimulus(&[&light.spectrum, &spectrum], &observer);
    std::array::from_fn(|i| reflected[i] / whole[i])
}

const RADIUS: f64 = 2.0;

fn gold_error(factor: f64) -> f64 {
    let objects = format!(
        r#"materials.rough = {{ conductor = {{ ior = "Au/olmon-2012-evaporated", roughness = {ALPHA} }} }}
        objects = [{{ material = "rough", shape.sphere = {{ radius = {RADIUS} }} }}]"#
    );
    let renders = replicates(&furnace(&objects), &Overrides { samples: Some(256), ..Overrides::default() }, 0, 16);
    let (expected, walls) = (gold_sphere(factor), walls());
    (0..3)
        .map(|i| (renders.iter().map(|xyz| xyz[i]).sum::<f64>() / 16.0 / walls[i] / expected[i] - 1.0).abs())
        .fold(0.0, f64::max)
}

#[test]
fn a_rough_gold_sphere_shows_its_albedo() {
    let error = gold_error(1.0);
    println!("rough gold sphere in a furnace: off by {error:.1e}");
    assert!(error < 2e-3, "relative error {error:.1e}");
}

#[test]
fn the_gold_test_sees_a_reflectance_one_per_cent_too_high() {
    assert!(gold_error(1.01) > 2e-3);
}
