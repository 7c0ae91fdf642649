//! Approximations against the exact model, over the primary data of six materials, and against errors worked out apart from this
//! program (double precision, 1 nm, cosines in steps of 0.01).

use spectrel::fresnel::SpectralModel;
use spectrel::fresnel::exact::reflect;
use spectrel::math::Lanes;
use spectrel::scene::{Metal, Overrides, Scene, Surface};

/// Largest error of F82 per wavelength over 380–780 nm.
const F82_SPECTRAL: [(&str, f64); 6] = [
    ("silver", 0.00222),
    ("gold", 0.02896),
    ("copper", 0.01219),
    ("aluminium", 0.03282),
    ("iron", 0.01866),
    ("diamond", 0.02992),
];

fn scene(material: &str) -> Scene {
    let text = format!(
        "camera = {{ position = [0, -9, 0], look_at = [0, 0, 0], fov = 30 }}
        environment.constant = {{ spectrum = \"E\", luminance = 1 }}
        [[objects]]\nmaterial = \"{material}\"\nshape.sphere = {{ radius = 1 }}\n"
    );
    crate::common::scene(&text, &Overrides::default())
}

/// n and k of a material at a wavelength.
fn index(scene: &Scene, nm: f64) -> [f64; 2] {
    let at = |id| scene.spectra.get(id).at(nm);
    match scene.surfaces[scene.objects[0].surface as usize] {
        Surface::Conductor(Metal { n, k, .. }) => [at(n), at(k)],
        Surface::Dielectric(interface) => [at(scene.medium(interface.medium).n), 0.0],
        _ => panic!("a material of n and k"),
    }
}

/// The largest error of a model over wavelengths and angles, and the cosine where it is.
fn largest_error(model: SpectralModel, material: &str) -> (f64, f64) {
    let scene = scene(material);
    let mut worst = (0.0, 0.0);
    for nm in 380..=780 {
        let [n, k] = index(&scene, f64::from(nm));
        let curve = model.at(&Lanes([1.0]), &Lanes([n as f32]), &Lanes([k as f32]));
        for step in 0..=100 {
            let cos = f64::from(step) / 100.0;
            let error = (f64::from(curve.reflectance(cos as f32)[0]) - reflect(1.0, n, k, cos).r).abs();
            worst = if error > worst.0 { (error, cos) } else { worst };
        }
    }
    worst
}

#[test]
fn f82_per_wavelength_is_as_far_off_as_it_should_be() {
    for (material, expected) in F82_SPECTRAL {
        let (error, cos) = largest_error(SpectralModel::F82Spectral, material);
        println!("{material}: {error:.5} at cos {cos}, expected {expected}");
        assert!((error - expected).abs() < 2e-4 || (error / expected - 1.0).abs() < 0.02, "{material}: {error}");
        let (schlick, _) = largest_error(SpectralModel::Schlick, material);
        assert!(error < schlick, "{material}: no better than Schlick's {schlick}");
    }
}

#[test]
fn a_constant_is_off_by_what_grazing_light_gains() {
    for (material, _) in F82_SPECTRAL {
        let (error, cos) = largest_error(SpectralModel::Constant, material);
        let scene = scene(material);
        let darkest = (380..=780).map(|nm| index(&scene, f64::from(nm))).map(|[n, k]| reflect(1.0, n, k, 1.0).r);
        let darkest = darkest.fold(1.0, f64::min);
        assert!(cos == 0.0 && (error - (1.0 - darkest)).abs() < 1e-6, "{material}: {error} at {cos}");
    }
}
