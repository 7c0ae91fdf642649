//! Pictures on surfaces: the right texel at the right place, its colour and its roughness, and their mean from afar.

use crate::common::paper::{HEAD, check};
use crate::common::pictures::{hdr, write_exr, write_png, write_png_with};
use crate::common::{film, mean, replicates, scene};
use glam::Vec2;
use png::{BitDepth, ColorType};
use spectrel::scene::{Needs, Overrides, Physics};
use spectrel::spectrum::{Chromaticities, RgbSpace, UpsampleTable, decode_srgb};
use std::path::PathBuf;
use tempfile::TempDir;

fn folder() -> (TempDir, impl Fn(&str) -> PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().to_owned();
    (folder, move |name: &str| path.join(name))
}

/// An object in even light of 100 cd/m², seen from a place towards another: what is matt shows a hundred times its reflectance.
fn furnace(position: [f64; 3], look_at: [f64; 3], material: &str, shape: &str) -> String {
    let up =
        if (position[0] - look_at[0]).abs() + (position[1] - look_at[1]).abs() < 1e-6 { [0, 1, 0] } else { [0, 0, 1] };
    format!(
        "{HEAD}camera = {{ position = {position:?}, look_at = {look_at:?}, up = {up:?}, fov = 0.05 }}
        environment.constant = {{ spectrum = \"D65\", luminance = 100 }}
        materials.m.{material}
        [[objects]]\nmaterial = \"m\"\nshape.{shape}"
    )
}

/// XYZ, with every wavelength once.
fn seen(text: &str) -> [f64; 3] {
    mean(&film(&scene(text, &Overrides { samples: Some(256), ..Overrides::default() })))
}

/// A quarter of codes each: 0.2, 0.4 above 0.6, 0.8, linear.
fn quarters(path: &std::path::Path) {
    write_exr(path, 2, &[[0.2; 3], [0.4; 3], [0.6; 3], [0.8; 3]]);
}

#[test]
fn flat_pictures_stand_upright_on_flat_shapes() {
    let (_folder, path) = folder();
    quarters(&path("a.exr"));
    let material = format!("diffuse.reflectance = {{ image = {:?}, wrap = \"clamp\" }}", path("a.exr"));
    // A wall seen from where it faces, a table from above with +y up, a round one. Quarters by their sides: right, up.
    let wall = |x: f64, z: f64| {
        furnace([x, -5.0, z], [x, 0.0, z], &material, "rectangle = { size = [4, 2], normal = [0, -1, 0] }")
    };
    let table = |x: f64, y: f64| furnace([x, y, 5.0], [x, y, 0.0], &material, "rectangle = { size = [4, 2] }");
    for (x, y, expected) in [(-1.9, 0.9, 20.0), (1.9, 0.9, 40.0), (-1.9, -0.9, 60.0), (1.9, -0.9, 80.0)] {
        for (name, text) in [("wall", wall(x, y)), ("table", table(x, y))] {
            let found = seen(&text)[1];
            assert!((found / expected - 1.0).abs() < 4e-3, "{name} at {x} {y}: {found}, expected {expected}");
        }
    }
    // In the middle of a side the mean of two, in the middle the mean of all.
    for (x, y, expected) in [(0.0, 0.9, 30.0), (-1.9, 0.0, 40.0), (0.0, 0.0, 50.0), (0.5, 0.9, 35.0)] {
        let found = seen(&table(x, y))[1];
        assert!((found / expected - 1.0).abs() < 4e-3, "{x} {y}: {found}, expected {expected}");
    }
    let disk = |angle: f64| {
        let (sin, cos) = angle.to_radians().sin_cos();
        let at = [0.95 * cos, 0.95 * sin];
        seen(&furnace([at[0], at[1], 5.0], [at[0], at[1], 0.0], &material, "disk = { radius = 1 }"))[1]
    };
    let mut around: Vec<i64> = [45.0, 135.0, 225.0, 315.0].map(|angle| disk(angle).round() as i64).to_vec();
    around.sort_unstable();
    assert_eq!(around, [20, 40, 60, 80], "each quarter of a disk shows one");
}

#[test]
fn meshes_wear_pictures_by_the_coordinates_of_their_file() {
    let (_folder, path) = folder();
    quarters(&path("a.exr"));
    // A table whose file turns the picture by a quarter: u runs along +y, v along −x.
    let table = "v -2 -1 0\nv 2 -1 0\nv 2 1 0\nv -2 1 0\nvt 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3 4/4\n";
    std::fs::write(path("table.obj"), table).expect("a file");
    let material = format!("diffuse.reflectance = {{ image = {:?}, wrap = \"clamp\" }}", path("a.exr"));
    let mesh = format!("mesh = {{ file = {:?} }}", path("table.obj"));
    // The picture's upper left is at −x, −y.
    for (x, y, expected) in
        [(-1.9, -0.9, 20.0), (-1.9, 0.9, 40.0), (1.9, -0.9, 60.0), (1.9, 0.9, 80.0), (0.0, 0.0, 50.0)]
    {
        let found = seen(&furnace([x, y, 5.0], [x, y, 0.0], &material, &mesh))[1];
        assert!((found / expected - 1.0).abs() < 4e-3, "{x} {y}: {found}, expected {expected}");
    }
}

#[test]
fn spheres_wear_pictures_around_their_axis() {
    let (_folder, path) = folder();
    // Four columns around, each with its own grey, darker below.
    let row = |factor: f32| [0.2, 0.4, 0.6, 0.8].map(|value: f32| [value * factor; 3]);
    write_exr(&path("a.exr"), 4, &[row(1.0), row(0.5)].concat());
    let material = format!("diffuse.reflectance = {{ image = {:?} }}", path("a.exr"));
    for (quarter, expected) in [(0, 20.0), (1, 40.0), (2, 60.0), (3, 80.0)] {
        let azimuth = f64::to_radians(45.0 + 90.0 * f64::from(quarter));
        for (z, factor) in [(1.0f64, 1.0), (-1.0, 0.5)] {
            let from = [4.0 * azimuth.cos(), 4.0 * azimuth.sin(), 4.0 * z];
            let found = seen(&furnace(from, [0.0; 3], &material, "sphere = { radius = 1 }"))[1];
            assert!((found / expected / factor - 1.0).abs() < 4e-3, "quarter {quarter}, {z}: {found}");
        }
    }
}

#[test]
fn colours_of_a_picture_are_those_of_the_same_numbers() {
    let (_folder, path) = folder();
    let shape = "rectangle = { size = [9, 9] }";
    let look = |source: &str| {
        seen(&furnace([0.5, 0.0, 5.0], [0.5, 0.0, 0.0], &format!("diffuse.reflectance = {source}"), shape))
    };
    for rgb in [[0.4, 0.12, 0.06], [0.05, 0.3, 0.7], [0.9, 0.8, 0.1], [0.01, 0.02, 0.015], [0.5, 0.5, 0.5]] {
        let direct = look(&format!("{{ rgb = {rgb:?} }}"));
        let same = |found: [f64; 3], tolerance: f64| {
            assert!(
                found.iter().zip(direct).all(|(a, b)| (a / b - 1.0).abs() < tolerance),
                "{rgb:?}: {found:?} {direct:?}"
            );
        };
        write_exr(&path("a.exr"), 1, &[rgb.map(|value| value as f32)]);
        same(look(&format!("{{ image = {:?} }}", path("a.exr"))), 0.015);
        std::fs::write(
            path("a.hdr"),
            hdr(1, &[rgb.map(|value| value as f32)], crate::common::pictures::Rows::Flat, ""),
        )
        .expect("a file");
        same(look(&format!("{{ image = {:?} }}", path("a.hdr"))), 0.03);
        let codes: Vec<u8> = rgb
            .iter()
            .flat_map(|&value| ((spectrel::spectrum::encode_srgb(value) * 65535.0).round() as u16).to_be_bytes())
            .collect();
        write_png(&path("a.png"), 1, ColorType::Rgb, BitDepth::Sixteen, &codes);
        same(look(&format!("{{ image = {:?} }}", path("a.png"))), 0.015);
        same(look(&format!("{{ image = {:?}, color_space = \"srgb\" }}", path("a.png"))), 0.015);
        let plain: Vec<u8> = rgb.iter().flat_map(|value| ((value * 65535.0f64).round() as u16).to_be_bytes()).collect();
        write_png(&path("b.png"), 1, ColorType::Rgb, BitDepth::Sixteen, &plain);
        same(look(&format!("{{ image = {:?}, color_space = \"linear\" }}", path("b.png"))), 0.015);
    }
}

#[test]
fn codes_of_a_png_are_the_colours_that_its_file_says() {
    let (_folder, path) = folder();
    let shape = "rectangle = { size = [9, 9] }";
    let look = |source: &str| {
        seen(&furnace([0.5, 0.0, 5.0], [0.5, 0.0, 0.0], &format!("diffuse.reflectance = {source}"), shape))
    };
    let check = |source: &str, linear: [f64; 3]| {
        let (found, expected) = (look(source), look(&format!("{{ rgb = {linear:?} }}")));
        // The table of spectra is off by up to ΔE 1 where a channel is next to nothing.
        let largest = expected.into_iter().fold(0.0, f64::max);
        let near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.01 * largest);
        assert!(near, "{source}: {found:?} {expected:?}");
    };
    let png = path("a.png");
    let write = |codes: &[u8], color, chunks: &[(&[u8; 4], Vec<u8>)]| {
        write_png_with(&png, 1, color, BitDepth::Eight, codes, chunks);
    };
    let plain = format!("{{ image = {png:?} }}");
    let named = |space: &str| format!("{{ image = {png:?}, color_space = {space:?} }}");
    write(&[128], ColorType::Grayscale, &[(b"gAMA", 100_000u32.to_be_bytes().to_vec())]);
    check(&plain, [128.0 / 255.0; 3]);
    check(&named("srgb"), [0.2158605; 3]);
    write(&[200, 60, 40], ColorType::Rgb, &[(b"cICP", vec![12, 13, 0, 1])]);
    check(&plain, [0.6967, 0.0227, 0.0077]);
    write(&[200, 60, 40], ColorType::Rgb, &[]);
    check(&named("display-p3"), [0.6967, 0.0227, 0.0077]);
    check(&named("p3"), [0.6967, 0.0227, 0.0077]);
    check(&plain, [0.5776, 0.0452, 0.0212]);
    write(&[150, 140, 120], ColorType::Rgb, &[]);
    for (space, stated) in [("adobe", Chromaticities::ADOBE_RGB), ("ap0", Chromaticities::ACES2065_1)] {
        let gamma = if space == "ap0" { 1.0 } else { 563.0 / 256.0 };
        let light = [150.0, 140.0, 120.0].map(|code| libm::pow(code / 255.0, gamma));
        check(&named(space), stated.to(RgbSpace::Srgb).expect("colours").apply(light));
    }
}

/// What a picture of many texels and few colours shows is what its texels say, at each of them.
#[test]
fn a_large_png_is_kept_by_the_numbers_of_its_colours() {
    let (_folder, path) = folder();
    let code = |i: usize| [(i % 251) as u8, (i / 7 % 256) as u8, (i * i % 13) as u8];
    let codes: Vec<u8> = (0..40 * 30).flat_map(code).collect();
    write_png(&path("a.png"), 40, ColorType::Rgb, BitDepth::Eight, &codes);
    let text = format!("diffuse.reflectance = {{ image = {:?} }}", path("a.png"));
    let scene =
        scene(&furnace([0.0, 0.0, 5.0], [0.0; 3], &text, "rectangle = { size = [9, 9] }"), &Overrides::default());
    let shown = scene.patterns.values().find_map(|pattern| pattern.reflectance.as_ref()).expect("a picture");
    let library = spectrel::spectrum::Library::default();
    let table = UpsampleTable::for_reflectance(&library).expect("a table");
    for i in (0..40 * 30).step_by(17) {
        let linear = code(i).map(|code| decode_srgb(f64::from(f32::from(code) / 255.0)) as f32);
        let at = Vec2::new(((i % 40) as f32 + 0.5) / 40.0, 1.0 - ((i / 40) as f32 + 0.5) / 30.0);
        let around = shown.around(at);
        let (tint, _) = around.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).expect("texels");
        assert_eq!(tint, table.tint(linear), "{i}");
    }
}

#[test]
fn single_wavelengths_see_the_same_picture() {
    let (_folder, path) = folder();
    write_exr(&path("a.exr"), 2, &[[0.7, 0.4, 0.35], [0.5, 0.8, 0.4]]);
    let material = format!("diffuse.reflectance = {{ image = {:?} }}", path("a.exr"));
    let text = furnace([0.5, 0.0, 5.0], [0.5, 0.0, 0.0], &material, "rectangle = { size = [9, 9] }");
    let lanes = |lanes, samples| {
        mean(&film(&scene(&text, &Overrides { samples: Some(samples), lanes: Some(lanes), ..Overrides::default() })))
    };
    let (eight, four, one) = (lanes(8, 256), lanes(4, 512), lanes(1, 2048));
    for other in [four, one] {
        assert!(eight.iter().zip(other).all(|(a, b)| (a / b - 1.0).abs() < 5e-4), "{eight:?} {other:?}");
    }
}

#[test]
fn a_fine_picture_from_afar_is_its_mean() {
    let (_folder, path) = folder();
    let board: Vec<u8> = (0..64 * 64).map(|i| if (i / 64 + i % 64) % 2 == 0 { 255 } else { 0 }).collect();
    write_png(&path("board.png"), 64, ColorType::Grayscale, BitDepth::Eight, &board);
    let material = format!("diffuse.reflectance = {{ image = {:?}, scale = [40, 30] }}", path("board.png"));
    let text = furnace([3.0, 1.0, 50.0], [3.1, 1.2, 0.0], &material, "rectangle = { size = [20, 20] }")
        .replace("fov = 0.05", "fov = 9");
    // White is 0.99994.
    check("checkerboard", &text, 64, 8, 50.0);
}

/// Mean renders of a ball of a material under a lamp and a sky.
fn ball(material: &str, samples: u32) -> Vec<[f64; 3]> {
    let text = format!(
        "{HEAD}camera = {{ position = [0, -8, 3], look_at = [0, 0, 0], fov = 14 }}
        environment.gradient.zenith = {{ spectrum = \"D65\", luminance = 100 }}
        environment.gradient.horizon = {{ spectrum = \"D65\", luminance = 30 }}
        environment.gradient.nadir = {{ spectrum = \"D65\", luminance = 5 }}
        materials.m.{material}
        [[objects]]\nmaterial = \"m\"\nshape.sphere = {{ radius = 1 }}
        [[objects]]\nshape.sphere = {{ radius = 0.5, center = [2, -4, 4] }}\nemission = {{ spectrum = \"D65\", luminance = 3000 }}"
    );
    replicates(&text, &Overrides { samples: Some(samples), ..Overrides::default() }, 0, 4)
}

#[test]
fn roughness_of_a_picture_is_that_of_the_same_number() {
    let (_folder, path) = folder();
    // 51/255 is 0.2.
    write_png(&path("a.png"), 2, ColorType::Grayscale, BitDepth::Eight, &[51; 4]);
    write_png(&path("c.png"), 2, ColorType::Rgb, BitDepth::Eight, &[51; 12]);
    let image = |name: &str| format!("{{ image = {:?} }}", path(name));
    for of in [
        |roughness: String| format!("conductor = {{ ior = {{ n = 0.2, k = 3 }}, {roughness} }}"),
        |roughness: String| format!("dielectric = {{ ior = 1.5, {roughness} }}"),
    ] {
        for (word, name) in [("roughness", "a.png"), ("perceptual_roughness", "a.png"), ("roughness", "c.png")] {
            // The same α to the bit, since paths of other α part sooner or later: texels are squared in single precision.
            let alpha = if word == "roughness" { 0.2f32 } else { 0.2 * 0.2 };
            let number = ball(&of(format!("roughness = {}", f64::from(alpha))), 64);
            let picture = ball(&of(format!("{word} = {}", image(name))), 64);
            let other = ball(&of(format!("{word} = 0.21")), 64);
            for (a, b) in number.iter().zip(&picture) {
                assert!(a.iter().zip(b).all(|(a, b)| (a / b - 1.0).abs() < 1e-4), "{word}: {a:?} {b:?}");
            }
            assert!((number[0][1] / other[0][1] - 1.0).abs() > 1e-4, "another roughness is seen");
        }
    }
}

#[test]
fn smooth_and_rough_places_of_one_picture_are_what_they_are() {
    let (_folder, path) = folder();
    // Smooth at the left, rough at the right.
    write_png(&path("a.png"), 2, ColorType::Grayscale, BitDepth::Eight, &[0, 102]);
    let metal = |roughness: &str| format!("conductor = {{ ior = {{ n = 0.2, k = 3 }}, roughness = {roughness} }}");
    let image = format!("{{ image = {:?}, wrap = \"clamp\" }}", path("a.png"));
    let lit = |x: f64, roughness: &str| {
        let lamp = "\n[[objects]]\nshape.sphere = { radius = 1, center = [0, 6, 5] }\nemission = { spectrum = \"E\", luminance = 900 }";
        let text = furnace([x, -5.0, 5.0], [x, 0.0, 0.0], &metal(roughness), "rectangle = { size = [4, 4] }");
        mean(&film(&scene(&format!("{text}{lamp}"), &Overrides { samples: Some(1024), ..Overrides::default() })))[1]
    };
    for (x, number) in [(-1.5, "0"), (1.5, "0.4")] {
        let (picture, number) = (lit(x, &image), lit(x, number));
        assert!((picture / number - 1.0).abs() < 1e-4, "at {x}: {picture} {number}");
    }
    assert!((lit(-1.5, &image) / lit(1.5, &image) - 1.0).abs() > 0.02);
}

#[test]
fn a_scene_says_which_pictures_it_uses_and_what_was_wrong_with_them() {
    let (_folder, path) = folder();
    write_exr(&path("a.exr"), 2, &[[0.5; 3], [1.5, 0.5, f32::NAN], [-0.1, 0.5, 0.5], [1.0; 3]]);
    let material = format!("diffuse.reflectance = {{ image = {:?} }}", path("a.exr"));
    let text = furnace([0.5, 0.0, 5.0], [0.5, 0.0, 0.0], &material, "rectangle = { size = [9, 9] }");
    let scene = scene(&text, &Overrides::default());
    assert!(
        scene.warnings[0].contains("a.exr`: 2 of 4 texels are no colours of a reflectance"),
        "{:?}",
        scene.warnings
    );
    let needs = Needs::of(&scene);
    let said = needs.decisions.iter().find(|decision| decision.part == "textures").expect("a decision");
    assert!(said.used && said.reason.contains("a.exr") && said.reason.contains("object 1"), "{said:?}");
    assert!(mean(&film(&scene)).iter().all(|value| value.is_finite() && *value <= 110.0));
    let plain = crate::common::scene(
        &furnace([0.0, 0.0, 5.0], [0.0; 3], "diffuse.reflectance = 0.5", "rectangle = { size = [9, 9] }"),
        &Overrides::default(),
    );
    let needs = Needs::of(&plain);
    assert!(!needs.pictures && !needs.physics.contains(Physics::TEXTURES));
    assert!(needs.decisions.iter().any(|decision| decision.part == "textures" && !decision.used));
}
