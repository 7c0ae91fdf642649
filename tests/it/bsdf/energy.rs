//! Energy, reciprocity and limits of surfaces, from outside.

use crate::statistics::Random;
use crate::statistics::directions::{above, unit, upper};
use glam::{DVec3, Vec3};
use proptest::prelude::*;
use spectrel::bsdf::{Bsdf, Conductor, Diffuse, Draw, Lobe, Scatters, albedo::albedo, conductor::MIRROR_ALPHA};
use spectrel::fresnel::{Fresnel, SpectralModel, exact};
use spectrel::math::Lanes;

const ALPHAS: [f32; 7] = [1e-3, 0.01, 0.05, 0.1, 0.3, 0.5, 1.0];
const ANGLES: [f64; 5] = [0.0, 30.0, 60.0, 80.0, 89.0];

/// Gold at 450 and 600 nm.
const GOLD: [(f64, f64); 2] = [(1.38, 1.91), (0.24, 2.92)];

fn gold() -> Fresnel<2> {
    let [blue, red] = GOLD;
    SpectralModel::Exact
        .at(&Lanes::ONE, &Lanes([blue.0 as f32, red.0 as f32]), &Lanes([blue.1 as f32, red.1 as f32]))
        .into()
}

/// F = 1 at every angle.
fn white() -> Fresnel<2> {
    SpectralModel::Schlick.at(&Lanes::ONE, &Lanes::ZERO, &Lanes::ONE).into()
}

fn direction(degrees: f64, azimuth: f64) -> Vec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos).as_vec3().normalize()
}

/// Mean weight over a square of 512² stratified points: the albedo as a renderer finds it.
fn sampled(bsdf: &Bsdf<2>, wo: Vec3) -> [f64; 2] {
    const SIDE: usize = 512;
    let (mut random, mut sum) = (Random::new(3), [0.0; 2]);
    for point in 0..SIDE * SIDE {
        let jitter = random.point();
        let u = [((point % SIDE) as f32 + jitter[0]) / SIDE as f32, ((point / SIDE) as f32 + jitter[1]) / SIDE as f32];
        if let Some(sample) = bsdf.sample(wo, Draw { uv: u.map(|u| u.min(0.999_999_94)), lobe: 0.0 }) {
            (0..2).for_each(|lane| sum[lane] += sample.weight[lane] as f64);
        }
    }
    sum.map(|sum| sum / (SIDE * SIDE) as f64)
}

#[test]
fn white_facets_never_gain_energy() {
    let fresnel = white();
    assert_eq!(fresnel.reflectance(0.3), Lanes::ONE);
    for alpha in ALPHAS {
        for angle in ANGLES {
            let albedo = sampled(&Bsdf::Conductor(Conductor { fresnel, alpha }), direction(angle, 0.4));
            assert!(albedo[0] <= 1.0 && albedo[0] > 0.3, "α {alpha} at {angle}°: {albedo:?}");
        }
    }
}

#[test]
fn sampled_albedo_is_the_integral_over_half_vectors() {
    for alpha in ALPHAS {
        for angle in ANGLES {
            let wo = direction(angle, 0.4);
            let found = sampled(&Bsdf::Conductor(Conductor { fresnel: gold(), alpha }), wo);
            for (found, (n, k)) in found.into_iter().zip(GOLD) {
                let expected = albedo(alpha as f64, wo.z as f64, |cos| exact::reflect(1.0, n, k, cos).r);
                let error = found / expected - 1.0;
                println!("α {alpha:5} at {angle:2}°: {expected:.6}, sampled {error:+.1e}");
                assert!(error.abs() < 2e-3, "α {alpha} at {angle}°: {found} for {expected}");
            }
        }
    }
}

#[test]
fn albedo_and_highlight_reach_the_mirror_without_a_jump() {
    for angle in ANGLES {
        let wo = direction(angle, 0.4);
        let mirror = Bsdf::Conductor(Conductor { fresnel: gold(), alpha: 0.0 })
            .sample(wo, Draw { uv: [0.5, 0.5], lobe: 0.0 })
            .unwrap();
        assert_eq!(mirror.lobe, Lobe::Mirror);
        let mut last = f64::INFINITY;
        for alpha in [1e-2, 1e-3, MIRROR_ALPHA] {
            let bsdf = Bsdf::Conductor(Conductor { fresnel: gold(), alpha });
            let albedo = sampled(&bsdf, wo);
            let jump = (0..2).map(|lane| (albedo[lane] - mirror.weight[lane] as f64).abs()).fold(0.0, f64::max);
            let median = bsdf.sample(wo, Draw { uv: [0.0, 0.5], lobe: 0.0 }).unwrap();
            let spread = (median.wi - mirror.wi).length() / alpha;
            println!("{angle}°, α {alpha}: albedo differs by {jump:.1e}, median direction by {spread:.2} α");
            assert!(median.lobe == Lobe::Reflection && spread < 5.0);
            assert!(jump < last.max(1e-5) * 1.01);
            last = jump;
        }
        assert!(last < 5e-5, "{angle}°: {last}");
    }
}

#[test]
fn delta_lobes_evaluate_to_nothing() {
    let mirror = Bsdf::Conductor(Conductor { fresnel: gold(), alpha: 0.99 * MIRROR_ALPHA });
    let (wo, wi) = (direction(30.0, 0.0), direction(30.0, std::f64::consts::PI));
    assert!(mirror.is_delta() && mirror.eval(wo, wi).f_cos == Lanes::ZERO && mirror.eval(wo, wi).pdf == 0.0);
}

fn roughness() -> impl Strategy<Value = f32> {
    prop_oneof![0.0f32..=1.0, Just(0.0), Just(1.0), (-8.0f32..0.0).prop_map(|x| 10f32.powf(x))]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nothing_breaks_anywhere(wo in upper(), wi in upper(), flip in any::<bool>(), alpha in roughness(), u in [unit(), unit()]) {
        let surfaces = [Bsdf::Conductor(Conductor { fresnel: gold(), alpha }), Bsdf::Diffuse(Diffuse { reflectance: Lanes::splat(0.7) })];
        for bsdf in surfaces {
            let eval = bsdf.eval(wo, if flip { -wi } else { wi });
            prop_assert!(eval.pdf.is_finite() && eval.pdf >= 0.0);
            prop_assert!(eval.f_cos.0.iter().all(|f| f.is_finite() && *f >= 0.0));
            prop_assert!(!flip || (eval.pdf == 0.0 && eval.f_cos == Lanes::ZERO));
            if let Some(sample) = bsdf.sample(wo, Draw { uv: u, lobe: 0.0 }) {
                prop_assert!((sample.wi.length() - 1.0).abs() < 1e-6 && sample.wi.z > 0.0, "{:?}", sample);
                prop_assert!(sample.pdf.is_finite() && sample.pdf > 0.0);
                prop_assert!(sample.weight.0.iter().all(|w| (0.0..1.000_001).contains(w)), "{:?}", sample);
            }
        }
    }

    #[test]
    fn light_paths_can_be_reversed(wo in above(1e-3), wi in above(1e-3), alpha in 0.01f32..1.0) {
        for bsdf in [Bsdf::Conductor(Conductor { fresnel: gold(), alpha }), Bsdf::Diffuse(Diffuse { reflectance: Lanes::splat(0.7) })] {
            let (there, back) = (bsdf.eval(wo, wi).f_cos / wi.z, bsdf.eval(wi, wo).f_cos / wo.z);
            for lane in 0..2 {
                prop_assert!((there[lane] - back[lane]).abs() <= 1e-5 * there[lane], "{} {}", there[lane], back[lane]);
            }
        }
    }

    #[test]
    fn weight_is_value_over_density(wo in above(0.01), alpha in 0.05f32..1.0, u in [unit(), unit()]) {
        for bsdf in [Bsdf::Conductor(Conductor { fresnel: gold(), alpha }), Bsdf::Diffuse(Diffuse { reflectance: Lanes::splat(0.7) })] {
            let Some(sample) = bsdf.sample(wo, Draw { uv: u, lobe: 0.0 }) else { continue };
            let eval = bsdf.eval(wo, sample.wi);
            prop_assert!((eval.pdf - sample.pdf).abs() <= 1e-3 * sample.pdf, "{} {}", eval.pdf, sample.pdf);
            for lane in 0..2 {
                let ratio = eval.f_cos[lane] / eval.pdf;
                prop_assert!((ratio - sample.weight[lane]).abs() <= 1e-5, "{ratio} {}", sample.weight[lane]);
            }
        }
    }
}
