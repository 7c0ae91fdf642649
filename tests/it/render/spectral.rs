//! Bands of wavelength against what they should be: Fresnel, ray tracing, single wavelengths, and the picture itself.

use crate::common::{mean_and_error, prism, scene, t_of_pairs};
use spectrel::film::{Layers, Wanted, Window};
use spectrel::fresnel::exact::reflect;
use spectrel::render::{Kernel, Recorder, Samples, render};
use spectrel::scene::{Metal, Needs, Overrides, Scene, Surface};
use spectrel::spectrum::{Bins, LUMENS_PER_WATT};
use std::sync::atomic::AtomicBool;

/// ∫ ȳ dλ over 360–830 nm (CIE 1931): light of equal energy of 1 cd/m² has 1 / (683 · this) W m⁻² sr⁻¹ nm⁻¹.
const Y_INTEGRAL_NM: f64 = 106.8569;

/// |t| beyond which one of a few comparisons differs: 15 degrees of freedom, one failure in a thousand for five of them.
const CRITICAL: f64 = 4.9;

fn bins(text: &str) -> Bins {
    text.parse().expect("bins")
}

/// The bands of a whole picture.
fn layers(scene: &Scene, bins: &Bins) -> Layers {
    let needs = Needs::of(scene);
    let kernel = Kernel::new(scene, &needs);
    let recorder = Recorder::new(&kernel, None, Some(bins));
    let size = [scene.settings.width, scene.settings.height];
    let wanted = Wanted { bands: bins.count(), ..Wanted::default() };
    let mut layers = Layers::new(size, Window::full(size[0], size[1]), wanted).expect("memory");
    let samples = Samples::Same(0..u64::from(scene.settings.samples));
    render(&recorder, &mut layers, samples, &(), &AtomicBool::new(false));
    layers
}

/// Each band's mean over the picture, in units of light of equal energy of 1 cd/m².
fn means(layers: &Layers, bins: &Bins) -> Vec<f64> {
    let pixels = layers.film().pixels().len() as f64;
    let unit = 1.0 / (LUMENS_PER_WATT * Y_INTEGRAL_NM);
    (0..bins.count()).map(|band| layers.band(band).sum::<f64>() / pixels / unit).collect()
}

/// [`means`] for each of 16 seeds.
fn renders(text: &str, bins: &Bins, samples: u32, lanes: u32, first: u64) -> Vec<Vec<f64>> {
    let render = |seed| {
        let overrides =
            Overrides { seed: Some(seed), samples: Some(samples), lanes: Some(lanes), ..Overrides::default() };
        means(&layers(&scene(text, &overrides), bins), bins)
    };
    (first..first + 16).map(render).collect()
}

fn band(renders: &[Vec<f64>], band: usize) -> Vec<f64> {
    renders.iter().map(|bands| bands[band]).collect()
}

#[test]
fn a_metal_has_its_reflectance_in_every_band() {
    let text = "render = { width = 2, height = 2 }
        camera = { position = [6, 0, 6], look_at = [0, 0, 0], fov = 0.05 }
        environment.constant = { spectrum = \"E\", luminance = 100 }
        [[objects]]\nmaterial = \"gold\"\nshape.rectangle = { size = [190, 190] }";
    // Every 256 samples visit each wavelength once, so that nothing is left to chance.
    let scene = scene(text, &Overrides { samples: Some(256), ..Overrides::default() });
    let Surface::Conductor(Metal { n, k, .. }) = scene.surfaces[0] else { panic!("gold is a metal") };
    let [n, k] = [n, k].map(|id| scene.spectra.get(id));
    let bins = bins("380:10:780");
    let mut worst: f64 = 0.0;
    for (i, mean) in means(&layers(&scene, &bins), &bins).into_iter().enumerate() {
        let at = |step: u32| bins.edges_nm(i).0 + (f64::from(step) + 0.5) * bins.step_nm() / 200.0;
        let reflectance = |nm| reflect(1.0, n.at(nm), k.at(nm), std::f64::consts::FRAC_1_SQRT_2).r;
        let expected = 100.0 * (0..200).map(|step| reflectance(at(step))).sum::<f64>() / 200.0;
        worst = worst.max((mean / expected - 1.0).abs());
    }
    println!("gold at 45°, 41 bands: largest relative error {worst:.1e}");
    assert!(worst < 2e-4, "{worst}");
}

#[test]
fn a_dispersive_prism_refracts_each_band_by_its_own_index() {
    // So small that its absorption does not count.
    let head = "meters_per_unit = 1e-8\nrender = { width = 8, height = 8, filter = \"box\" }\n";
    let height = 0.5;
    let text = format!("{head}{}", prism::scene("\"SCHOTT/sf11\"", height));
    let bins = bins("410:90:770");
    let resolved = scene(&text, &Overrides::default());
    let index = resolved.spectra.get(resolved.media.last().expect("glass").n);
    for lanes in [1, 8] {
        let renders = renders(&text, &bins, 1024, lanes, 0);
        for i in 0..bins.count() {
            let at = |step: u32| bins.edges_nm(i).0 + (f64::from(step) + 0.5) * bins.step_nm() / 100.0;
            let over_band = |f: &dyn Fn(f64) -> f64| (0..100).map(|step| f(at(step))).sum::<f64>() / 100.0;
            let expected = over_band(&|nm| prism::expected(index.at(nm), height));
            let (mean, error) = mean_and_error(&band(&renders, i));
            let z = (mean - expected).abs() / error;
            println!("{} nm, {lanes} lanes: {mean:.4}, expected {expected:.4}, z = {z:.1}", bins.center_nm(i));
            assert!(z < CRITICAL, "{} nm: {mean} against {expected}, z = {z:.1}", bins.center_nm(i));
            let opposite = prism::expected(index.at(bins.center_nm(bins.count() - 1 - i)), height);
            let seen = (mean - opposite).abs() > CRITICAL * error;
            assert!(seen || i == 2, "the test must see the index of another wavelength: {opposite} ± {error}");
        }
    }
}

/// A brilliant in light of equal energy, of one index or of diamond's.
fn diamond(ior: &str) -> String {
    let material = format!("materials.stone = {{ dielectric = {{ ior = {ior} }} }}");
    let text = crate::common::lanes::solid("shape.brilliant = { diameter = 2 }", &material);
    text.replace("\"D65\"", "\"E\"").replace("\"A\"", "\"E\"")
}

const DIAMOND: &str = "\"C/peter-1923\"";

#[test]
fn bands_of_a_diamond_are_renders_of_single_wavelengths() {
    let bins = bins("440:4:440");
    let resolved = scene(&diamond(DIAMOND), &Overrides::default());
    let index = resolved.media.iter().find(|medium| medium.dispersive).expect("diamond").n;
    let alone = |nm: f64| {
        let n = resolved.spectra.get(index).at(nm);
        let luminances =
            crate::common::replicates(&diamond(&n.to_string()), &crate::common::lanes::with(1, 64), 500, 16);
        luminances.iter().map(|xyz| [xyz[1]; 3]).collect::<Vec<_>>()
    };
    let bands = renders(&diamond(DIAMOND), &bins, 256, 8, 0);
    let bands: Vec<[f64; 3]> = band(&bands, 0).iter().map(|mean| [*mean; 3]).collect();
    let (right, wrong) = (t_of_pairs(&bands, &alone(440.0)), t_of_pairs(&bands, &alone(700.0)));
    println!("440 nm: t = {right:.1}; against 700 nm: t = {wrong:.1}");
    assert!(right < CRITICAL, "t = {right:.1}");
    assert!(wrong > CRITICAL, "the test must see another wavelength's index: t = {wrong:.1}");
}

#[test]
fn eight_lanes_and_one_give_the_same_bands() {
    let bins = bins("430:70:710");
    let (together, alone) = (renders(&diamond(DIAMOND), &bins, 64, 8, 0), renders(&diamond(DIAMOND), &bins, 64, 1, 0));
    for i in 0..bins.count() {
        let pairs = |renders: &[Vec<f64>]| band(renders, i).iter().map(|mean| [*mean; 3]).collect::<Vec<_>>();
        let t = t_of_pairs(&pairs(&together), &pairs(&alone));
        assert!(t < CRITICAL, "{} nm: t = {t:.1}", bins.center_nm(i));
    }
}

#[test]
fn bands_through_the_observer_are_the_picture() {
    let scene = scene(include_str!("../../data/reproducible.toml"), &Overrides::default());
    let bins = bins("360.5:1:829.5");
    let layers = layers(&scene, &bins);
    let observer = &scene.picture.observer;
    let mut xyz = vec![[0.0; 3]; layers.film().pixels().len()];
    for i in 0..bins.count() {
        let weight = observer.at(bins.center_nm(i)).map(|c| c * bins.step_nm() * LUMENS_PER_WATT);
        for (pixel, radiance) in xyz.iter_mut().zip(layers.band(i)) {
            (0..3).for_each(|c| pixel[c] += radiance * weight[c]);
        }
    }
    let (mut sum, mut off, mut total) = ([0.0; 3], [0.0; 3], [0.0; 3]);
    for (pixel, bands) in layers.film().pixels().iter().zip(&xyz) {
        (0..3).for_each(|c| {
            sum[c] += pixel.mean()[c];
            off[c] += (pixel.mean()[c] - bands[c]).abs();
            total[c] += pixel.mean()[c] - bands[c];
        });
    }
    let of = |difference: [f64; 3]| [0, 1, 2].map(|c| difference[c].abs() / sum[c]);
    println!("bands of 1 nm through the observer: off by {:.5?} in a pixel, {:.5?} in all", of(off), of(total));
    // Wavelengths lie up to half a nanometre beside the middle of their band; over the picture that averages out.
    assert!(of(off).iter().all(|error| *error < 4e-3) && of(total).iter().all(|error| *error < 5e-4));
}

#[test]
fn errors_of_bands_do_not_repeat_from_pixel_to_pixel() {
    // A grey sky with few samples: what varies is which wavelengths they carry.
    let text = "render = { width = 64, height = 64 }
        camera = { position = [0, 0, 0], look_at = [0, 1, 0], fov = 40 }
        environment.constant = { spectrum = \"E\", luminance = 100 }";
    let scene = scene(text, &Overrides { samples: Some(8), ..Overrides::default() });
    let bins = bins("380:10:780");
    let layers = layers(&scene, &bins);
    let pixels = 64 * 64;
    for i in [3, 17, 33] {
        let band: Vec<f64> = layers.band(i).map(|s| s * LUMENS_PER_WATT * Y_INTEGRAL_NM / 100.0 - 1.0).collect();
        let (mean, error) = mean_and_error(&band);
        assert!(mean.abs() < 4.0 * error && error > 0.0, "unbiased at {} nm: {mean} ± {error}", bins.center_nm(i));
        let variance = band.iter().map(|e| e * e).sum::<f64>() / f64::from(pixels);
        for (dx, dy) in [(1, 0), (0, 1), (1, 1), (2, 0), (8, 0), (0, 16)] {
            let place = |x: i32, y: i32| band[((y & 63) * 64 + (x & 63)) as usize];
            let products = (0..pixels).map(|p| place(p % 64, p / 64) * place(p % 64 + dx, p / 64 + dy)).sum::<f64>();
            let correlation = products / f64::from(pixels) / variance;
            // Of independent pixels it has the standard deviation 1/64; it may be less than nothing, where neighbours' errors cancel.
            assert!(correlation < 4.0 / 64.0, "({dx}, {dy}) at {} nm: {correlation}", bins.center_nm(i));
        }
    }
}

/// Wavelengths go to lamps by their power, of which a tiny lamp has next to none: yet what is seen of it must fit the film.
#[test]
fn a_blinding_lamp_with_lines_of_its_own_beside_strong_ones_fits_the_film() {
    let many: Vec<String> = (0..40).map(|i| format!("[{}, 1]", 420.1 + 6.3 * f64::from(i))).collect();
    for (lines, samples) in
        [("[532.2, 1]".to_owned(), 64), ("[546.1, 2], [611, 1]".to_owned(), 64), (many.join(", "), 256)]
    {
        let text = format!(
            "render = {{ width = 8, height = 8, samples = {samples}, filter = \"box\" }}
            camera = {{ position = [0, 0, 5], look_at = [0, 0, 0], up = [0, 1, 0], fov = 0.05 }}
            [[objects]]\nshape.sphere = {{ radius = 0.01 }}
            emission = {{ spectrum = {{ lines = [{lines}] }}, luminance = 9e10 }}
            [[objects]]\nshape.rectangle = {{ size = [900, 900], center = [0, 0, 9], normal = [0, 0, -1] }}
            emission = {{ spectrum = {{ lines = [[436, 1], [577, 2], [589.3, 4]] }}, luminance = 1e8 }}"
        );
        let film = crate::common::film(&scene(&text, &Overrides::default()));
        assert!(film.pixels().iter().all(|pixel| !pixel.overflowed()), "{lines}");
        let luminance = crate::common::mean(&film)[1];
        println!("{luminance:.4e} of 9e10");
        assert!((luminance / 9e10 - 1.0).abs() < 1e-3, "{lines}: {luminance:e}");
    }
}
