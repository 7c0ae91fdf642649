//! What is seen of the texels themselves: where, how bright, in which colour.

use super::Picture;
use crate::common::paper::{HEAD, check};
use crate::common::pictures::{write_exr, write_exr_with};
use crate::common::{film, mean, scene};
use exr::prelude::{Image, SpecificChannels, Vec2, WritableImage};
use spectrel::light::Environment;
use spectrel::scene::{Needs, Overrides};
use spectrel::spectrum::{Chromaticities, RgbSpace};
use std::f64::consts::PI;

/// A camera at the origin that looks one way.
fn looking(direction: [f64; 3]) -> String {
    let up = if direction[2].abs() > 0.9 { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
    format!("{HEAD}camera = {{ position = [0, 0, 0], look_at = {direction:?}, up = {up:?}, fov = 0.1 }}\n")
}

/// XYZ, with every wavelength once.
fn seen(text: &str) -> [f64; 3] {
    mean(&film(&scene(text, &Overrides { samples: Some(256), ..Overrides::default() })))
}

#[test]
fn every_texel_stands_where_the_picture_says() {
    let (width, height) = (8, 4);
    let sky = Picture::new(width, (0..32).map(|i| [1.0 + i as f32; 3]).collect());
    let towards = |row: f64, column: f64, turn: f64| {
        let (theta, psi) = (PI * row / height as f64, 2.0 * PI * column / width as f64 - PI - turn);
        [theta.sin() * psi.sin(), theta.sin() * psi.cos(), theta.cos()]
    };
    for index in [0, 3, 4, 9, 15, 20, 30, 31] {
        let (row, column) = ((index / width) as f64 + 0.4, (index % width) as f64 + 0.3);
        for degrees in [0.0, 45.0, -100.0, 725.0] {
            let direction = towards(row, column, f64::to_radians(degrees));
            let text = format!("{}{}", looking(direction), sky.environment(&format!("rotate = {degrees}")));
            let found = seen(&text)[1];
            assert!((found / (1.0 + index as f64) - 1.0).abs() < 2e-5, "texel {index} turned by {degrees}: {found}");
        }
    }
    // In words: the middle is +y, right of it +x; a quarter against the clock moves the middle to −x.
    let half = |direction| seen(&format!("{}{}", looking(direction), sky.environment("")))[1];
    assert!((half([0.05, 1.0, 0.05]) - 13.0).abs() < 1e-3 && (half([1.0, -0.05, 0.05]) - 15.0).abs() < 1e-3);
    let turned = |direction| seen(&format!("{}{}", looking(direction), sky.environment("rotate = 90")))[1];
    assert!((turned([-1.0, 0.05, 0.05]) - 13.0).abs() < 1e-3);
}

#[test]
fn a_red_texel_is_seen_in_a_mirror_where_it_is_reflected() {
    let mut pixels = vec![[0.1, 0.1, 0.1]; 32 * 16];
    pixels[4 * 32 + 25] = [5.0, 0.1, 0.1];
    let sky = Picture::new(32, pixels);
    let (theta, psi) = (PI * 4.5 / 16.0, 2.0 * PI * 25.5 / 32.0 - PI);
    let [x, y, z] = [theta.sin() * psi.sin(), theta.sin() * psi.cos(), theta.cos()];
    let mirror = "materials.m.conductor = { ior = { n = 1e-6, k = 1 } }\n[[objects]]\nmaterial = \"m\"\nshape.rectangle = { size = [9, 9] }\n";
    let view = |x: f64, y: f64| {
        let camera =
            format!("camera = {{ position = {:?}, look_at = [0, 0, 0], fov = 0.1 }}", [-x, -y, z].map(|v| 3.0 * v));
        seen(&format!("{HEAD}{camera}\n{}{mirror}", sky.environment("")))
    };
    let ([rx, ry, _], [gx, gy, _]) = (view(x, y), view(-x, y));
    assert!(rx > 1.5 * ry && rx > 1.0, "red where the texel is: {rx} {ry}");
    assert!((gy - 0.1).abs() < 1e-4 && (gx - 0.1).abs() < 1e-3, "grey elsewhere: {gx} {gy}");
}

#[test]
fn strengths_are_those_asked_for() {
    let mut pixels = vec![[3.0; 3]; 64];
    pixels.extend([[1.0; 3]; 64]);
    let halves = Picture::new(16, pixels);
    let look = |z: f64, more: &str| format!("{}{}", looking([0.3, 0.4, z]), halves.environment(more));
    for lanes in [1, 8] {
        check("file's own", &look(0.5, ""), 2048 / lanes, lanes, 3.0);
        check("scaled", &look(0.5, "scale = 20"), 2048 / lanes, lanes, 60.0);
        check("mean above", &look(0.5, "luminance = 100"), 2048 / lanes, lanes, 150.0);
        check("mean below", &look(-0.5, "luminance = 100"), 2048 / lanes, lanes, 50.0);
    }
    for illuminant in ["A", "FL2", "LED-B3"] {
        let text = look(0.5, "scale = 20").replace("\"E\"", &format!("{illuminant:?}"));
        let constant = format!(
            "{}environment.constant = {{ spectrum = {illuminant:?}, luminance = 60 }}",
            looking([0.3, 0.4, 0.5])
        );
        let (map, constant) = (seen(&text), seen(&constant));
        assert!(
            map.iter().zip(constant).all(|(a, b)| (a / b - 1.0).abs() < 1e-5),
            "{illuminant}: {map:?} {constant:?}"
        );
    }
}

#[test]
fn colours_come_back_under_their_white() {
    let colors = [[0.8, 0.2, 0.1], [0.1, 0.7, 0.2], [20.0, 30.0, 80.0], [0.02, 0.02, 0.01f32]];
    let folder = tempfile::tempdir().expect("a folder");
    for space in RgbSpace::ALL {
        for color in colors {
            let path = folder.path().join("one.exr");
            write_exr_with(&path, 1, &[color], |attributes| {
                let stated = space.chromaticities();
                let xy = |[x, y]: [f64; 2]| exr::math::Vec2(x as f32, y as f32);
                let [red, green, blue] = stated.primaries_xy.map(xy);
                let white = xy(stated.white_xy);
                attributes.chromaticities = Some(exr::meta::attribute::Chromaticities { red, green, blue, white });
            });
            let stated = format!("{}[environment.image]\nfile = {path:?}\n", looking([0.0, 1.0, 0.0]));
            let expected = space.xyz_from_rgb().apply(color.map(f64::from));
            let found = seen(&stated);
            // ACES has another white, which the illuminant stands for; luminance stays.
            let channels = if space == RgbSpace::AcesCg { 1..2 } else { 0..3 };
            for i in channels {
                assert!((found[i] / expected[i] - 1.0).abs() < 0.01, "{space:?} {color:?}: {found:?} {expected:?}");
            }
            let asked = format!("{stated}color_space = {:?}\n", space.name());
            write_exr_with(&path, 1, &[color], |_| {});
            let found_again = seen(&asked);
            assert!(found.iter().zip(found_again).all(|(a, b)| (a / b - 1.0).abs() < 1e-6), "{space:?}");
        }
    }
}

#[test]
fn files_of_xyz_are_seen_as_what_they_are() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("xyz.exr");
    let xyz = [0.5f32, 0.4, 0.3];
    write_exr_with(&path, 1, &[xyz], |attributes| {
        let third = 1.0 / 3.0;
        let v = exr::math::Vec2;
        attributes.chromaticities = Some(exr::meta::attribute::Chromaticities {
            red: v(1.0, 0.0),
            green: v(0.0, 1.0),
            blue: v(0.0, 0.0),
            white: v(third, third),
        });
    });
    let found = seen(&format!("{}[environment.image]\nfile = {path:?}\n", looking([0.0, 1.0, 0.0])));
    assert!(found.iter().zip(xyz).all(|(a, b)| (a / f64::from(b) - 1.0).abs() < 0.01), "{found:?}");
}

#[test]
fn adobe_rgb_and_aces_are_named_and_a_white_in_the_file_is_its_scale() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("one.exr");
    let look = |more: &str| format!("{}[environment.image]\nfile = {path:?}\n{more}", looking([0.0, 1.0, 0.0]));
    let rgb = [0.3f32, 0.4, 0.2];
    write_exr(&path, 1, &[rgb]);
    for (name, stated) in [
        ("adobe-rgb", Chromaticities::ADOBE_RGB),
        ("adobe", Chromaticities::ADOBE_RGB),
        ("ap0", Chromaticities::ACES2065_1),
        ("aces2065-1", Chromaticities::ACES2065_1),
        ("ap1", RgbSpace::AcesCg.chromaticities()),
        ("p3", RgbSpace::DisplayP3.chromaticities()),
    ] {
        let linear = stated.to(RgbSpace::Srgb).expect("colours").apply(rgb.map(f64::from));
        let expected = RgbSpace::Srgb.xyz_from_rgb().apply(linear);
        let found = seen(&look(&format!("color_space = {name:?}\n")));
        assert!(found.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 0.01), "{name}: {found:?} {expected:?}");
    }
    let channels = SpecificChannels::rgb(|_: Vec2<usize>| (rgb[0], rgb[1], rgb[2]));
    let mut image = Image::from_channels((1, 1), channels);
    image.layer_data.attributes.white_luminance = Some(40.0);
    let plain = seen(&look(""));
    image.write().to_file(&path).expect("a file");
    let (stated, asked) = (seen(&look("")), seen(&look("scale = 3\n")));
    assert!((0..3).all(|i| (stated[i] / plain[i] / 40.0 - 1.0).abs() < 1e-4), "{stated:?} {plain:?}");
    assert!((0..3).all(|i| (asked[i] / plain[i] / 3.0 - 1.0).abs() < 1e-4), "{asked:?} {plain:?}");
    let said = scene(&look(""), &Overrides::default()).warnings;
    assert!(said.iter().any(|warning| warning.contains("a white of 40 cd/m²")), "{said:?}");
}

#[test]
fn texels_that_no_light_has_are_counted_and_dark() {
    let mut pixels = vec![[1.0; 3]; 8];
    pixels[1] = [f32::NAN, 1.0, 1.0];
    pixels[2] = [-3.0, 1.0, 1.0];
    pixels[5] = [f32::INFINITY; 3];
    pixels[6] = [7.0; 3];
    let sky = Picture::new(4, pixels);
    let scene = scene(&format!("{}{}", looking([0.0, 1.0, 0.0]), sky.environment("")), &Overrides::default());
    let said = scene.warnings.join("\n");
    assert!(said.contains("2 of 8 texels have values that are negative or no numbers"), "{said}");
    assert!(said.contains("1 of 8 texels are infinite: they count as the largest"), "{said}");
    assert!(matches!(&scene.lights.environment, Environment::Map(map) if map.chosen().is_finite()));
    assert!(matches!(&scene.lights.environment, Environment::Map(map) if map.brightest() == 7.0));
    let xyz = mean(&film(&scene));
    assert!(xyz.iter().all(|value| value.is_finite()), "{xyz:?}");
}

#[test]
fn a_scene_says_that_it_uses_a_picture_and_one_without_does_not() {
    let sky = Picture::constant(4, 2, 1.0);
    let with = scene(&format!("{}{}", looking([0.0, 1.0, 0.0]), sky.environment("")), &Overrides::default());
    let needs = Needs::of(&with);
    let said = needs.decisions.iter().find(|decision| decision.part == "environment").expect("a decision");
    assert!(needs.pictures && said.used && said.reason.contains("4 × 2 texels"), "{said:?}");
    assert_eq!(with.warnings, Vec::<String>::new());
    assert!(!Needs::of(&scene(&looking([0.0, 1.0, 0.0]), &Overrides::default())).pictures);
    let odd = Picture::constant(3, 2, 1.0);
    let odd = scene(&format!("{}{}", looking([0.0, 1.0, 0.0]), odd.environment("")), &Overrides::default());
    assert!(
        odd.warnings[0].contains("3 × 2 texels") && odd.warnings[0].contains("twice as wide"),
        "{:?}",
        odd.warnings
    );
}
