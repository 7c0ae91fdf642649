//! Colours through the whole pipeline against integrals done apart from it.

use crate::common::{film, library, scene};
use spectrel::film::{Develop, Exposure, Gamut};
use spectrel::fresnel::exact;
use spectrel::scene::Overrides;
use spectrel::spectrum::{Observer, Outside, RgbSpace, Spectrum, Table, bradford, tristimulus, white_xyz};
use std::path::Path;

/// Mean linear sRGB of a picture developed at EV 0 with the scene's own white.
fn mean_rgb(text: &str) -> [f64; 3] {
    let scene = scene(text, &Overrides::default());
    let film = film(&scene);
    let develop =
        Develop { exposure: Exposure::Ev(0.0), white: scene.picture.white, space: RgbSpace::Srgb, gamut: Gamut::Clip };
    let developed = film.develop(&develop).expect("a picture");
    let sum =
        developed.rgb.iter().fold([0.0; 3], |sum: [f64; 3], rgb| std::array::from_fn(|i| sum[i] + f64::from(rgb[i])));
    sum.map(|value| value / developed.rgb.len() as f64)
}

fn perfect_reflector(illuminant: &str) -> String {
    format!(
        r#"
        render = {{ width = 64, height = 64, samples = 256 }}
        camera = {{ position = [0, 0, 5], look_at = [0, 0, 0], up = [0, 1, 0], fov = 40 }}
        picture.white_balance = "{illuminant}"
        environment.constant = {{ spectrum = "{illuminant}", luminance = 1 }}
        materials.white.diffuse.reflectance = 1.0
        [[objects]]
        material = "white"
        shape.rectangle = {{ size = [100, 100] }}
        "#
    )
}

fn largest_error(rgb: [f64; 3]) -> f64 {
    rgb.iter().map(|value| (value - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn a_perfect_reflector_is_white_under_smooth_illuminants() {
    for name in ["A", "D50", "D65", "E"] {
        let rgb = mean_rgb(&perfect_reflector(name));
        println!("perfect reflector under {name}: off by {:.1e}", largest_error(rgb));
        assert!(largest_error(rgb) < 2e-5, "{name}: {rgb:?}");
    }
}

#[test]
fn a_perfect_reflector_is_white_under_lamps() {
    let lamps = (1..=12).map(|i| format!("FL{i}")).chain((1..=5).map(|i| format!("LED-B{i}")));
    for name in lamps {
        let rgb = mean_rgb(&perfect_reflector(&name));
        println!("perfect reflector under {name}: off by {:.1e}", largest_error(rgb));
        assert!(largest_error(rgb) < 1e-4, "{name}: {rgb:?}");
    }
}

#[test]
fn the_white_test_sees_a_reflector_that_lacks_a_ten_thousandth() {
    let text = perfect_reflector("D65").replace("reflectance = 1.0", "reflectance = 0.9999");
    assert!(largest_error(mean_rgb(&text)) > 2e-5);
}

/// F0 in linear sRGB from f64 reflectances at every nanometre, integrated as a piecewise-linear spectrum.
fn f0_integrated(ior: &str) -> [f64; 3] {
    let library = library();
    let ior = library.ior(ior, Path::new("")).expect("in the library");
    let points: Vec<(f64, f64)> = (360..=830)
        .map(f64::from)
        .map(|nm| (nm, ior.at(nm)))
        .map(|(nm, (n, k))| (nm, exact::reflect(1.0, n, k, 1.0).r))
        .collect();
    let reflectance = Spectrum::Table(Table::from_points(&points, Outside::Hold));
    let observer = library.observer(Observer::Cie1931).expect("built in");
    let light = library.illuminant("D65", Path::new("")).expect("built in").spectrum.clone();
    let white = white_xyz(&light, &observer).expect("has light");
    let scale = tristimulus(&[&light], &observer)[1];
    let xyz = tristimulus(&[&light, &reflectance], &observer).map(|value| value / scale);
    RgbSpace::Srgb.rgb_from_xyz().after(&bradford(white, RgbSpace::Srgb.white_xyz())).apply(xyz)
}

/// A mirror that faces a constant light, seen along its normal.
fn f0_rendered(material: &str) -> [f64; 3] {
    mean_rgb(&format!(
        r#"
        render = {{ width = 16, height = 16, samples = 256 }}
        camera = {{ position = [0, 0, 5], look_at = [0, 0, 0], up = [0, 1, 0], fov = 0.5 }}
        environment.constant = {{ spectrum = "D65", luminance = 1 }}
        [[objects]]
        material = "{material}"
        shape.rectangle = {{ size = [100, 100] }}
        "#
    ))
}

#[test]
fn a_mirror_shows_its_f0() {
    let metals = [
        ("silver", "Ag/yang-2015"),
        ("gold", "Au/olmon-2012-evaporated"),
        ("copper", "Cu/mcpeak-2015"),
        ("aluminium", "Al/mcpeak-2015"),
        ("iron", "Fe/johnson-christy-1974"),
    ];
    for (material, ior) in metals {
        let (rendered, integrated) = (f0_rendered(material), f0_integrated(ior));
        for channel in 0..3 {
            let error = (rendered[channel] - integrated[channel]).abs();
            println!("F0 of {material}, channel {channel}: rendered off by {error:.1e}");
            assert!(error < 1e-3, "{material} channel {channel}: {rendered:?} against {integrated:?}");
        }
    }
    let (gold, silver) = (f0_rendered("gold"), f0_integrated("Ag/yang-2015"));
    assert!((gold[2] - silver[2]).abs() > 0.1, "the test tells metals apart");
}
