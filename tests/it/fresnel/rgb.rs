//! RGB models on the wavelengths of a path: what they are there, and what a picture makes of them.

use crate::common::{film, library, scene};
use spectrel::film::Develop;
use spectrel::fresnel::{
    DielectricFresnel, Fresnel, FresnelModel, RgbCurve, RgbFresnel, RgbModel, Specimen, SpectralModel, Target, exact,
};
use spectrel::math::Lanes;
use spectrel::scene::{Overrides, optics};
use spectrel::spectrum::{
    Adaptation, Colorimeter, Observer, Outside, RgbSpace, Spectrum, Table, Upsampler, srgb_primaries,
};
use std::path::Path;

fn rgb_models() -> impl Iterator<Item = (&'static str, RgbModel)> {
    FresnelModel::ALL.iter().filter_map(|model| match model {
        FresnelModel::Rgb(rgb) => Some((model.name(), *rgb)),
        FresnelModel::Spectral(_) => None,
    })
}

fn meter() -> Colorimeter {
    let light = library().illuminant("D65", Path::new("")).expect("built in");
    let observer = library().observer(Observer::Cie1931).expect("built in");
    Colorimeter::new(&light.spectrum, &observer, RgbSpace::Srgb, Adaptation::Bradford).expect("D65 has light")
}

fn fitted(model: RgbModel, material: &str) -> RgbCurve {
    let optics = optics(material, None, &library()).expect("built in");
    model.fit(&Target::new(Specimen::in_vacuum(&optics.ior), &meter()))
}

fn largest_difference(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The spectrum of a curve at an angle, as a table at every nanometre.
fn spectrum(curve: RgbCurve, primaries: &[Spectrum; 3], cos: f32) -> Spectrum {
    let at = |nm: f64| {
        let primaries = [0, 1, 2].map(|i| Lanes([primaries[i].at(nm) as f32]));
        (nm, f64::from(Fresnel::Rgb(RgbFresnel { curve, primaries }).reflectance(cos)[0]))
    };
    let points: Vec<_> = (360..=830).map(|nm| at(f64::from(nm))).collect();
    Spectrum::Table(Table::from_points(&points, Outside::Hold))
}

#[test]
fn the_spectrum_of_a_model_has_its_colour_at_every_angle() {
    let primaries = srgb_primaries(&library()).expect("built in");
    let upsampler = Upsampler::new(&library()).expect("built in");
    for (name, model) in rgb_models() {
        for material in ["gold", "iron"] {
            let curve = fitted(model, material);
            for cos in [0.0, 0.05, 1.0 / 7.0, 0.4, 0.8, 1.0] {
                let seen = upsampler.rgb(&spectrum(curve, &primaries, cos));
                let off = largest_difference(seen, curve.reflectance(cos).0.map(f64::from));
                assert!(off < 2e-6, "{name} of {material} at {cos}: {off:e}");
            }
        }
    }
}

/// A metal plate that fills the picture, under an even sky of D65, seen at an angle.
fn plate(material: &str, cos: f64) -> String {
    let sin = (1.0 - cos * cos).sqrt();
    format!(
        "[render]
        width = 4
        height = 4
        samples = 1024
        [camera]
        position = [0, {}, {}]
        look_at = [0, 0, 0]
        up = [1, 0, 0]
        orthographic_width = 0.001
        [picture]
        exposure = 0
        [environment.constant]
        spectrum = \"D65\"
        luminance = 1
        [[objects]]
        material = \"{material}\"
        shape.rectangle = {{ size = [9, 9] }}",
        -sin * 3.0,
        cos * 3.0
    )
}

/// Linear sRGB of a plate, a perfect reflector being (1, 1, 1).
fn rendered(plate: &str, model: &str) -> [f64; 3] {
    let overrides = Overrides { fresnel: Some(model.parse().expect("a model")), ..Overrides::default() };
    let scene = scene(plate, &overrides);
    let developed = film(&scene)
        .develop(&Develop {
            exposure: spectrel::film::Exposure::Ev(0.0),
            white: scene.picture.white,
            space: RgbSpace::Srgb,
            gamut: spectrel::film::Gamut::Clip,
        })
        .expect("a picture");
    let pixels = developed.rgb.len() as f64;
    let sum = developed.rgb.iter().fold([0.0; 3], |sum, rgb| std::array::from_fn(|i| sum[i] + f64::from(rgb[i])));
    sum.map(|channel| channel / pixels)
}

#[test]
fn after_one_bounce_under_d65_a_picture_holds_the_very_rgb_of_the_model() {
    for (name, model) in rgb_models() {
        for material in ["gold", "copper"] {
            let curve = fitted(model, material);
            for cos in [1.0, 0.5, 0.15] {
                let (seen, expected) =
                    (rendered(&plate(material, cos), name), curve.reflectance(cos as f32).0.map(f64::from));
                let off = largest_difference(seen, expected);
                println!("{name} of {material} at {cos}: {seen:?}, off by {off:.1e}");
                assert!(off < 2e-6, "{name} of {material} at {cos}: {seen:?} where {expected:?} is expected");
                // What a hundredth of a per cent would do is seen.
                assert!(largest_difference(seen, expected.map(|channel| channel * 1.0001)) > 2e-6);
            }
        }
    }
}

/// Immersed metals are fitted to what they are in their medium.
#[test]
fn a_metal_in_water_is_fitted_to_what_it_is_there() {
    let gold = optics("gold", None, &library()).expect("built in").ior;
    let meter = meter();
    let immersed = Specimen { n1: &Spectrum::Constant(1.4), n2: &gold.n, k2: &gold.k };
    let curve = RgbModel::SchlickRgb.fit(&Target::new(immersed, &meter));
    let expected = meter.rgb(|nm| exact::reflect(1.4, gold.n.at(nm), gold.k.at(nm), 1.0).r);
    assert!(largest_difference(curve.reflectance(1.0).0.map(f64::from), expected) < 1e-6);
    let text = format!("outside = \"oil\"\n{}\n[materials.oil.dielectric]\nior = 1.4", plate("gold", 1.0));
    let seen = rendered(&text, "schlick-rgb");
    assert!(largest_difference(seen, expected) < 2e-6, "{seen:?} {expected:?}");
}

/// What every model must keep at a lossless interface, on lanes.
#[test]
fn at_glass_every_model_gives_a_share_that_is_the_same_from_both_sides() {
    let library = library();
    let diamond = optics("diamond", None, &library).expect("built in").ior;
    let primaries = srgb_primaries(&library).expect("built in");
    let wavelengths = [400.0, 450.0, 500.0, 550.0, 580.0, 600.0, 650.0, 700.0];
    let meter = meter();
    let target = Target::new(Specimen::in_vacuum(&diamond), &meter);
    let (air, n) = (Lanes::<8>::ONE, Lanes::<8>::from_fn(|lane| diamond.n.at(wavelengths[lane]) as f32));
    for model in FresnelModel::ALL {
        let fresnel = match model {
            FresnelModel::Spectral(model) => DielectricFresnel::Spectral(*model),
            FresnelModel::Rgb(model) => DielectricFresnel::Rgb(RgbFresnel {
                curve: model.fit(&target),
                primaries: [0, 1, 2].map(|i| Lanes::from_fn(|lane| primaries[i].at(wavelengths[lane]) as f32)),
            }),
        };
        for step in 0..=100 {
            let cos = Lanes::splat(step as f32 * 0.01);
            let entering = fresnel.at(&air, &n, &cos);
            let leaving = fresnel.at(&n, &air, &entering.cos_theta_t);
            let inside = fresnel.at(&n, &air, &cos);
            for lane in 0..8 {
                assert!((0.0..=1.0).contains(&entering.r[lane]) && (0.0..=1.0).contains(&inside.r[lane]), "{model}");
                let total = 1.0 - n[lane] * n[lane] * (1.0 - cos[lane] * cos[lane]) < 0.0;
                assert!(!total || (inside.r[lane] == 1.0 && inside.cos_theta_t[lane] == 0.0), "{model} at {step}");
                let alone = fresnel.lane(lane).at(&Lanes([n[lane]]), &Lanes([1.0]), &Lanes([cos[lane]]));
                assert_eq!(alone.r[0], inside.r[lane], "{model}");
                // From a denser side, the incident form takes another angle. Rounding of cos θ_t grows towards grazing.
                if *model != FresnelModel::Spectral(SpectralModel::SchlickIncident) && step > 0 {
                    let off = (entering.r[lane] - leaving.r[lane]).abs();
                    assert!(off < 3e-6 / cos[lane], "{model} at {step}, lane {lane}: {off:e}");
                }
            }
        }
        let nothing = fresnel.at(&n, &n, &Lanes::splat(0.3));
        assert_eq!(nothing.r, Lanes::ZERO, "{model}: between equal media");
    }
}

#[test]
fn schlick_from_the_denser_side_is_by_the_side_that_the_name_says() {
    let (n, air) = (Lanes([1.5_f32]), Lanes([1.0_f32]));
    let f0 = 0.04_f64;
    for cos in [0.76_f32, 0.8, 0.9, 1.0] {
        let sin_t = 1.5 * (1.0 - f64::from(cos) * f64::from(cos)).sqrt();
        let cos_t = (1.0 - sin_t * sin_t).sqrt();
        let curve = |cos: f64| f0 + (1.0 - f0) * (1.0 - cos).powi(5);
        let at = |model: SpectralModel| f64::from(model.dielectric(&n, &air, &Lanes([cos])).r[0]);
        assert!((at(SpectralModel::SchlickIncident) - curve(f64::from(cos))).abs() < 1e-6);
        assert!((at(SpectralModel::SchlickTransmitted) - curve(cos_t)).abs() < 1e-5);
        assert_eq!(at(SpectralModel::SchlickTransmitted), at(SpectralModel::Schlick));
    }
    // From air both are the same.
    for cos in [0.1_f32, 0.5, 0.9] {
        let at = |model: SpectralModel| model.dielectric(&air, &n, &Lanes([cos])).r[0];
        assert_eq!(at(SpectralModel::SchlickIncident), at(SpectralModel::SchlickTransmitted));
    }
}

#[test]
fn cook_and_torrance_are_exact_but_for_rounding() {
    let (mut worst, mut matched) = (0.0_f64, 0.0_f64);
    for (n1, n2) in [(1.0_f32, 1.5), (1.0, 2.417), (1.5, 1.0), (2.417, 1.0), (1.33, 1.52), (1.52, 1.53)] {
        for step in 0..=1000 {
            let cos = step as f32 * 1e-3;
            let found = SpectralModel::CookTorrance.dielectric(&Lanes([n1]), &Lanes([n2]), &Lanes([cos])).r[0];
            let expected = exact::reflect(n1.into(), n2.into(), 0.0, cos.into()).r;
            let slack = [1e-6, -1e-6].map(|by| {
                let moved = (f64::from(cos) + by).clamp(0.0, 1.0);
                (exact::reflect(n1.into(), n2.into(), 0.0, moved).r - expected).abs()
            });
            // Beside the critical angle the input itself is ill-conditioned.
            if slack[0].max(slack[1]) < 1e-5 {
                let error = (f64::from(found) - expected).abs();
                worst = worst.max(error);
                matched = if n1 == 1.52 { matched.max(error / expected) } else { matched };
            }
        }
    }
    println!("Cook–Torrance: R to {worst:.1e}; relative to itself {matched:.1e} for 1.52 → 1.53");
    assert!(worst < 1e-6 && (1e-6..5e-5).contains(&matched), "{worst:e} {matched:e}");
}

/// What the head of `schlick_sides` quotes: reflectance from the denser side averaged over the hemisphere, worked out apart from this
/// program (double precision, two million cosines).
#[test]
fn the_incident_form_lets_too_much_light_out() {
    const STEPS: usize = 20_000;
    for (n, expected) in [(1.5_f32, [0.5963, 0.5734, 0.5937]), (2.417, [0.8651, 0.8583, 0.8650])] {
        let averaged =
            [SpectralModel::Exact, SpectralModel::SchlickIncident, SpectralModel::SchlickTransmitted].map(|model| {
                let reflected = |cos: f32| model.dielectric(&Lanes([n]), &Lanes([1.0]), &Lanes([cos])).r[0];
                let cosines = (0..STEPS).map(|step| (step as f32 + 0.5) / STEPS as f32);
                cosines.map(|cos| 2.0 * f64::from(reflected(cos) * cos)).sum::<f64>() / STEPS as f64
            });
        assert!(averaged.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-4), "n {n}: {averaged:?}");
    }
}
