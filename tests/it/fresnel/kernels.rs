//! The f32 kernels against the f64 reference over dense grids and random indices: within 2e-6, plus what one rounding of an
//! input changes in the answer itself (that is what is left beside the critical angle, and nothing elsewhere).

use proptest::prelude::*;
use spectrel::fresnel::exact::{Reflection, reflect};
use spectrel::fresnel::{SpectralModel, average, conductor, dielectric};
use spectrel::math::Lanes;

type Input = [f32; 4];

fn exact([n1, n2, k2, cos]: Input) -> Reflection {
    reflect(n1.into(), n2.into(), k2.into(), cos.into())
}

fn kernel(input: Input) -> (f32, f32) {
    let [n1, n2, k2, cos] = input.map(|value| Lanes([value]));
    let (r, lost) = conductor::reflectance_and_loss(&n1, &n2, &k2, &cos);
    assert_eq!(r, conductor::reflectance(&n1, &n2, &k2, &cos));
    (r[0], lost[0])
}

/// How far R moves when each input moves by one rounding.
fn conditioning(input: Input) -> f64 {
    let [n1, n2, k2, cos] = input.map(f64::from);
    let r = |by: [f64; 4]| {
        let ulp = f64::from(f32::EPSILON) * 0.5;
        reflect(n1 * (1.0 + by[0] * ulp), n2 * (1.0 + by[1] * ulp), k2, (cos * (1.0 + by[3] * ulp)).min(1.0)).r
    };
    let middle = r([0.0; 4]);
    let moves = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let one = |by: [f64; 4]| (r(by) - middle).abs().max((r(by.map(|b| -b)) - middle).abs());
    moves.into_iter().map(one).sum()
}

fn cosines() -> impl Iterator<Item = f32> {
    (0..=200).map(|i| i as f32 / 200.0).chain((1..30).map(|i| libm::powf(10.0, -0.25 * i as f32)))
}

fn logarithmic(from: f32, to: f32, steps: usize) -> impl Iterator<Item = f32> {
    (0..=steps).map(move |i| from * libm::powf(to / from, i as f32 / steps as f32))
}

#[test]
fn conductors_over_a_grid() {
    let (mut worst_r, mut worst_lost) = (0.0_f64, 0.0_f64);
    for n1 in [1.0, 1.0003, 1.33, 1.5, 2.417] {
        for n2 in logarithmic(0.02, 30.0, 30) {
            for k2 in logarithmic(0.05, 60.0, 30) {
                for cos in cosines() {
                    let input = [n1, n2, k2, cos];
                    let (expected, (r, lost)) = (exact(input), kernel(input));
                    worst_r = worst_r.max((r as f64 - expected.r).abs());
                    if expected.one_minus_r > 0.0 {
                        worst_lost = worst_lost.max((lost as f64 / expected.one_minus_r - 1.0).abs());
                    }
                }
            }
        }
    }
    println!("R to {worst_r:.1e}, 1 − R to {worst_lost:.1e} relative");
    assert!(worst_r < 2e-6 && worst_lost < 1e-5);
}

#[test]
fn dielectrics_over_a_grid() {
    let (mut worst, mut easy) = (0.0_f64, 0.0_f64);
    for n1 in logarithmic(1.0, 3.0, 25) {
        for n2 in logarithmic(1.0, 3.0, 25).chain([n1]) {
            for cos in cosines() {
                let input = [n1, n2, 0.0, cos];
                let interface = dielectric::fresnel(&Lanes([n1]), &Lanes([n2]), &Lanes([cos]));
                let (expected, slack) = (exact(input), conditioning(input));
                let errors = [interface.r[0], kernel(input).0].map(|r| (r as f64 - expected.r).abs());
                for error in errors {
                    worst = worst.max(error / (2e-6 + 4.0 * slack));
                    easy = if slack < 1e-7 { easy.max(error) } else { easy };
                }
                assert_eq!(n1 == n2, interface.r[0] == 0.0);
            }
        }
    }
    println!("R to {easy:.1e} where well conditioned; {worst:.2} of the tolerance everywhere");
    assert!(worst < 1.0 && easy < 1e-6);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 50_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_indices_at_any_angle(n1 in 0.5f32..4.0, n2 in 0.0f32..20.0, k2 in 0.0f32..20.0, cos in 0.0f32..=1.0) {
        let (r, lost) = kernel([n1, n2, k2, cos]);
        let input = [n1, n2, k2, cos];
        let error = (r as f64 - exact(input).r).abs();
        prop_assert!((0.0..=1.0).contains(&r) && (0.0..=1.000_001).contains(&lost));
        prop_assert!(error < 2e-6 + 4.0 * conditioning(input), "{error:e}");
    }

    #[test]
    fn nearly_matched_media(n1 in 1.0f32..2.5, ulps in -40i32..40, cos in 0.0f32..=1.0) {
        let n2 = f32::from_bits((n1.to_bits() as i32 + ulps) as u32);
        let input = [n1, n2, 0.0, cos];
        let r = dielectric::fresnel(&Lanes([n1]), &Lanes([n2]), &Lanes([cos])).r[0];
        prop_assert!((0.0..=1.0).contains(&r));
        prop_assert!((r as f64 - exact(input).r).abs() < 2e-6 + 4.0 * conditioning(input));
    }
}

/// Gold at 450, 600 nm, aluminium at 550 nm, iron at 590 nm, chromium at 550 nm.
const METALS: [(f32, f32); 5] = [(1.38, 1.91), (0.24, 2.92), (0.96, 6.69), (2.87, 3.12), (3.18, 3.31)];

/// What the head of `schlick` quotes.
#[test]
fn schlick_on_metals() {
    let (mut worst, mut averaged) = (0.0_f64, 0.0_f64);
    for (n, k) in METALS {
        let curve = SpectralModel::Schlick.at(&Lanes::ONE, &Lanes([n]), &Lanes([k]));
        let difference = |cos: f64| curve.reflectance(cos as f32)[0] as f64 - exact([1.0, n, k, cos as f32]).r;
        worst = (0..=1000).map(|i| difference(i as f64 * 1e-3).abs()).fold(worst, f64::max);
        let mean =
            average(|cos| exact([1.0, n, k, 1.0]).r + (1.0 - exact([1.0, n, k, 1.0]).r) * libm::pow(1.0 - cos, 5.0));
        averaged = averaged.max((mean - average(|cos| reflect(1.0, n.into(), k.into(), cos).r)).abs());
    }
    println!("Schlick: R to {worst:.3}, averaged over the hemisphere to {averaged:.4}");
    assert!(worst < 0.2 && averaged < 0.03);
}
