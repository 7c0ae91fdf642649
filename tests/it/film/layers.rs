//! Layers beside the film: as reproducible as it, and saying what they mean.

use crate::common::{film, mean_and_error, scene};
use spectrel::film::{Layers, Wanted, Window};
use spectrel::render::{FirstHit, Guides, Kernel, Recorder, Samples, first_hits, render};
use spectrel::scene::{Needs, Overrides, Scene};
use spectrel::spectrum::{Bins, Matrix3, RgbSpace};
use std::sync::atomic::AtomicBool;

const SCENE: &str = include_str!("../../data/reproducible.toml");
const ALL: Wanted = Wanted { features: true, replicates: true, bands: 41 };

/// A scene's layers over some windows of it and ranges of samples, one after another.
fn layers_of(scene: &Scene, wanted: Wanted, window: Window, ranges: &[[u64; 2]]) -> Layers {
    let needs = Needs::of(scene);
    let kernel = Kernel::new(scene, &needs);
    let guides = wanted.features.then(|| Guides::first_hit(scene, &needs, RgbSpace::Srgb));
    let bins = (wanted.bands > 0).then(Bins::default);
    let recorder = Recorder::new(&kernel, guides, bins.as_ref());
    let mut layers = Layers::new([scene.settings.width, scene.settings.height], window, wanted).expect("memory");
    for &[first, end] in ranges {
        render(&recorder, &mut layers, Samples::Same(first..end), &(), &AtomicBool::new(false));
    }
    layers
}

fn whole(scene: &Scene, wanted: Wanted) -> Layers {
    let window = Window::full(scene.settings.width, scene.settings.height);
    layers_of(scene, wanted, window, &[[0, u64::from(scene.settings.samples)]])
}

#[test]
fn features_and_bands_leave_the_picture_as_it_is() {
    let scene = scene(SCENE, &Overrides::default());
    for wanted in [Wanted::default(), Wanted { replicates: false, ..ALL }] {
        assert!(*whole(&scene, wanted).film() == film(&scene), "{wanted:?}");
    }
    assert!(*whole(&scene, ALL).film() != film(&scene), "replicates are another cut of the samples");
}

#[test]
fn layers_are_the_same_for_any_threads_ranges_and_windows() {
    let scene = scene(SCENE, &Overrides::default());
    let expected = whole(&scene, ALL);
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        assert!(pool.install(|| whole(&scene, ALL)) == expected, "{threads} threads");
    }
    let full = Window::full(48, 32);
    assert!(layers_of(&scene, ALL, full, &[[13, 20], [0, 5], [5, 13]]) == expected, "ranges");
    let part = Window { x0: 7, y0: 11, width: 9, height: 5 };
    let cut = layers_of(&scene, ALL, part, &[[0, 20]]);
    let inside = |i: usize| full.index(7 + i as u32 % 9, 11 + i as u32 / 9).expect("inside");
    for i in 0..45 {
        assert_eq!(cut.features()[i], expected.features()[inside(i)]);
        assert_eq!(cut.replicates()[i], expected.replicates()[inside(i)]);
    }
    let band = |layers: &Layers| layers.band(17).collect::<Vec<_>>();
    assert!((0..45).all(|i| band(&cut)[i] == band(&expected)[inside(i)]), "windows");
}

/// A sheet of a material seen at 45° that fills the picture.
fn sheet(material: &str) -> String {
    format!(
        "render = {{ width = 4, height = 4 }}
        camera = {{ position = [6, 0, 6], look_at = [0, 0, 0], fov = 0.05 }}
        environment.constant = {{ spectrum = \"E\", luminance = 100 }}
        materials.m = {material}
        [[objects]]\nmaterial = \"m\"\nshape.rectangle = {{ size = [190, 190] }}\n"
    )
}

fn albedo_and_normal(text: &str, guides: impl Fn(&Scene, &Needs, RgbSpace) -> Guides) -> ([f32; 3], [f32; 3]) {
    let scene = scene(text, &Overrides { samples: Some(16), ..Overrides::default() });
    let needs = Needs::of(&scene);
    let kernel = Kernel::new(&scene, &needs);
    let recorder = Recorder::new(&kernel, Some(guides(&scene, &needs, RgbSpace::Srgb)), None);
    let wanted = Wanted { features: true, ..Wanted::default() };
    let mut layers = Layers::new([4, 4], Window::full(4, 4), wanted).expect("memory");
    render(&recorder, &mut layers, Samples::Same(0..16), &(), &AtomicBool::new(false));
    let pixel = layers.features()[5];
    (pixel.albedo(), pixel.normal())
}

fn near(a: [f32; 3], b: [f32; 3], tolerance: f32) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < tolerance)
}

#[test]
fn the_albedo_of_a_picture_is_its_colour() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("paper.exr");
    for rgb in [[0.5; 3], [0.6, 0.2, 0.1], [0.05, 0.3, 0.7]] {
        crate::common::pictures::write_exr(&file, 2, &[rgb; 4]);
        let picture = format!("{{ diffuse = {{ reflectance = {{ image = {:?} }} }} }}", file.display().to_string());
        let (albedo, _) = albedo_and_normal(&sheet(&picture), Guides::first_hit);
        assert!(near(albedo, rgb, 1e-3), "{albedo:?} of {rgb:?}");
    }
}

#[test]
fn albedo_is_the_colour_of_the_surface_whatever_its_light() {
    let of = |material: &str| albedo_and_normal(&sheet(material), Guides::first_hit).0;
    assert!(near(of("{ diffuse = { reflectance = 0.25 } }"), [0.25; 3], 1e-6));
    let glass = sheet("{ dielectric = { ior = 1.5 } }")
        .replace("rectangle = { size = [190, 190]", "box = { size = [190, 190, 1]");
    assert!(near(albedo_and_normal(&glass, Guides::first_hit).0, [1.0; 3], 1e-6), "glass counts as white");
    // R = ((n − 1)² + k²) / ((n + 1)² + k²) = 9.64 / 10.44 at every wavelength, rough or not.
    for roughness in [0.0, 0.3] {
        let metal = of(&format!("{{ conductor = {{ ior = {{ n = 0.2, k = 3 }}, roughness = {roughness} }} }}"));
        assert!(near(metal, [(0.64 + 9.0) / (1.44 + 9.0); 3], 1e-6), "{metal:?}");
    }
    // Linear sRGB of gold's F0 under D65; its red is 1.04 and cut.
    let gold = of("{ conductor = { ior = \"Au/olmon-2012-evaporated\" } }");
    assert!(gold[0] == 1.0 && (0.7..0.8).contains(&gold[1]) && (0.25..0.4).contains(&gold[2]), "{gold:?}");
}

#[test]
fn normals_point_to_the_camera_from_either_side() {
    let front = sheet("{ diffuse = { reflectance = 0.25 } }");
    assert!(near(albedo_and_normal(&front, Guides::first_hit).1, [0.0, 0.0, 1.0], 1e-6));
    let back = front.replace("[6, 0, 6]", "[6, 0, -6]");
    assert!(near(albedo_and_normal(&back, Guides::first_hit).1, [0.0, 0.0, -1.0], 1e-6));
    let nothing = front.replace("[0, 0, 0], fov", "[12, 0, 12], fov");
    assert_eq!(albedo_and_normal(&nothing, Guides::first_hit), ([0.0; 3], [0.0; 3]));
}

#[test]
fn denoisers_look_into_mirrors_and_no_further() {
    let mirror = sheet("{ conductor = { ior = { n = 0.2, k = 3 } } }");
    let f0 = 9.64 / 10.44;
    // What is reflected: a grey wall that faces the mirror from the other side.
    let wall = "[materials.grey.diffuse]\nreflectance = 0.5
        [[objects]]\nmaterial = \"grey\"\nshape.rectangle = { size = [90, 90], center = [-20, 0, 0], normal = [1, 0, 0] }\n";
    let text = format!("{mirror}{wall}");
    let (albedo, normal) = albedo_and_normal(&text, Guides::behind_mirrors);
    assert!(near(albedo, [0.5 * f0; 3], 1e-6) && near(normal, [1.0, 0.0, 0.0], 1e-6), "{albedo:?} {normal:?}");
    let (albedo, normal) = albedo_and_normal(&text, Guides::first_hit);
    assert!(near(albedo, [f0; 3], 1e-6) && near(normal, [0.0, 0.0, 1.0], 1e-6), "{albedo:?} {normal:?}");
    let (albedo, normal) = albedo_and_normal(&mirror, Guides::behind_mirrors);
    assert!(near(albedo, [f0; 3], 1e-6) && near(normal, [0.0, 0.0, 1.0], 1e-6), "a mirror of the sky");
}

#[test]
fn depth_is_along_the_view_and_objects_are_not_mixed() {
    let text = "render = { width = 9, height = 9 }
        camera = { position = [0, -10, 0], look_at = [0, 0, 0], fov = 60 }
        materials.m.diffuse.reflectance = 0.5
        [[objects]]\nmaterial = \"m\"\nshape.rectangle = { size = [4, 4], normal = [0, -1, 0] }
        [[objects]]\nmaterial = \"m\"\nshape.sphere = { radius = 0.5, center = [0, -3, 0] }";
    let hits = first_hits(&scene(text, &Overrides::default()), Window::full(9, 9));
    let object = |object, depth| Some(FirstHit { depth, object });
    assert_eq!(hits[4 * 9 + 4], object(1, 6.5), "the middle of the sphere");
    assert_eq!(hits[4 * 9 + 5].map(|hit| hit.object), Some(0));
    // The sheet is 10 units ahead under every angle.
    assert!(hits.iter().flatten().filter(|hit| hit.object == 0).all(|hit| (hit.depth - 10.0).abs() < 1e-5));
    assert_eq!(hits[0], None);
}

/// A lamp's edge, its penumbra and noise of every strength; the sky alone, where only wavelengths vary; a rough metal.
const NOISY: &str = r#"
    render = { width = 8, height = 8 }
    camera = { position = [0, -6, 3], look_at = [0, 0, 0.4], fov = 40 }
    environment.gradient.zenith = { spectrum = "D65", luminance = 30 }
    environment.gradient.horizon = { spectrum = "A", luminance = 10 }
    environment.gradient.nadir = { spectrum = "A", luminance = 10 }
    materials.ground.diffuse.reflectance = 0.4
    materials.gold.conductor = { ior = "Au/olmon-2012-evaporated", roughness = 0.3 }
    [[objects]]
    shape.rectangle = { size = [1, 1], center = [1, 1, 3], normal = [-1, -1, -3] }
    emission = { spectrum = "D65", luminance = 500 }
    [[objects]]
    material = "ground"
    shape.rectangle = { size = [6, 6] }
    [[objects]]
    material = "gold"
    shape.sphere = { radius = 0.6, center = [0, 0, 0.61] }
    "#;

const FLAT: &str = r#"
    render = { width = 8, height = 8 }
    camera = { position = [0, -6, 3], look_at = [0, 0, 0.4], fov = 40 }
    environment.constant = { spectrum = "D65", luminance = 30 }
    "#;

/// Mean of the estimated variances over the true one, with its standard error: pixel by pixel, both from `seeds` renders.
fn ratio_of_variances(text: &str, samples: u32, seeds: u64) -> (f64, f64) {
    let wanted = Wanted { replicates: true, ..Wanted::default() };
    let (mut means, mut estimates) = (vec![Vec::new(); 64], vec![0.0; 64]);
    for seed in 0..seeds {
        let overrides = Overrides { seed: Some(seed), samples: Some(samples), ..Overrides::default() };
        let layers = whole(&scene(text, &overrides), wanted);
        for (i, (pixel, replicates)) in layers.film().pixels().iter().zip(layers.replicates()).enumerate() {
            means[i].push(pixel.mean()[1]);
            estimates[i] += replicates.variance_of_mean(&Matrix3::IDENTITY)[1] / seeds as f64;
        }
    }
    // `mean_and_error` gives √(variance/n) of the means; pixels are independent, so their ratios are.
    let ratio = |(means, estimate): (&Vec<f64>, &f64)| {
        let (_, error) = mean_and_error(means);
        estimate / (error * error * seeds as f64)
    };
    mean_and_error(&means.iter().zip(&estimates).map(ratio).collect::<Vec<_>>())
}

#[test]
fn estimated_variance_is_the_variance_over_seeds() {
    // 1/s² of 200 normal values is 1 % too large in the mean; three standard errors of the mean over 64 pixels are about 5 %.
    for (name, text, samples) in [("noisy", NOISY, 16), ("noisy", NOISY, 64), ("flat", FLAT, 64), ("flat", FLAT, 20)] {
        let (ratio, error) = ratio_of_variances(text, samples, 200);
        println!("{name}, {samples} samples: estimated / true variance {ratio:.3} ± {error:.3}");
        assert!((ratio - 1.0).abs() < 0.1, "{name}, {samples}: {ratio}");
        assert!(error < 0.034, "the test must see 10 %: {error}");
    }
}
