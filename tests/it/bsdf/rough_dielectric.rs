//! Rough dielectrics from outside: samples against densities, energy against an integral over half-vectors, reciprocity, limits.

use crate::statistics::directions::{above, unit, upper};
use crate::statistics::{Random, chi_squared};
use glam::{DVec3, Vec3};
use proptest::prelude::*;
use spectrel::bsdf::{Draw, RoughDielectric, Scatters, albedo, conductor::MIRROR_ALPHA};
use spectrel::fresnel::{SpectralModel, exact};
use spectrel::math::Lanes;
use std::f64::consts::TAU;

const ALPHAS: [f32; 3] = [0.05, 0.3, 1.0];
const ANGLES: [f64; 3] = [0.0, 60.0, 85.0];
/// n1, n2.
const SIDES: [[f64; 2]; 2] = [[1.0, 1.5], [1.5, 1.0]];

/// In n, between lanes.
const STEP: f64 = 0.05;

const SAMPLES: usize = 200_000;
const RINGS: usize = 12;
const SECTORS: usize = 8;
/// Midpoints along each edge of a cell: many along its spokes, where a critical angle puts a kink.
const FINE: [usize; 2] = [160, 60];
/// Chance of a false alarm over 36 tests of 1 %.
const SIGNIFICANCE: f64 = 2.5e-4;

fn direction(degrees: f64, azimuth: f64) -> Vec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos).as_vec3().normalize()
}

fn glass<const N: usize>(alpha: f32, n1: [f32; N], n2: [f32; N]) -> RoughDielectric<N> {
    RoughDielectric::new(SpectralModel::Exact.into(), &Lanes(n1), &Lanes(n2), alpha)
}

fn single([n1, n2]: [f64; 2], alpha: f32) -> RoughDielectric<1> {
    glass(alpha, [n1 as f32], [n2 as f32])
}

/// Four wavelengths, the first of them that of `single`.
fn four([n1, n2]: [f64; 2], alpha: f32) -> RoughDielectric<4> {
    let spread = |n: f64| std::array::from_fn(|lane| if n == 1.0 { 1.0 } else { (n + STEP * lane as f64) as f32 });
    glass(alpha, spread(n1), spread(n2))
}

/// Cells of the half-vector, for light that is reflected and for light that n1 → n2 refracts: w = r²/(1 + r²) with
/// r = tan θ_h/α, and its azimuth. A last bin counts what is lost, and what n1 → n2 refracts to no such direction.
struct Cells {
    wo: DVec3,
    alpha: f64,
    n: [f64; 2],
}

const BINS: usize = 2 * RINGS * SECTORS;

impl Cells {
    fn bin(&self, wi: Vec3) -> usize {
        let wi = wi.as_dvec3().normalize();
        let [n1, n2] = self.n;
        let (half, lobe) = match wi.z > 0.0 {
            true => (self.wo + wi, 0),
            false => ((n1 * self.wo + n2 * wi) * (n1 - n2).signum(), 1),
        };
        if half.z <= 0.0 || half.dot(self.wo) <= 0.0 || half.dot(wi) * wi.z <= 0.0 {
            return BINS;
        }
        let r = half.truncate().length() / (half.z * self.alpha);
        let turn = half.y.atan2(half.x).rem_euclid(TAU) / TAU;
        (lobe * RINGS + cell(r * r / (1.0 + r * r), RINGS)) * SECTORS + cell(turn, SECTORS)
    }

    /// Probability of each bin.
    fn integrate(&self, pdf: impl Fn(Vec3, Vec3) -> f32) -> Vec<f64> {
        let mut expected: Vec<f64> = (0..BINS)
            .map(|bin| {
                let (lobe, ring, sector) = (bin / SECTORS / RINGS, bin / SECTORS % RINGS, bin % SECTORS);
                // u = √(1 − w) smooths the tail, where tan θ_h runs to infinity.
                let [u1, u0] = [ring, ring + 1].map(|ring| (1.0 - ring as f64 / RINGS as f64).sqrt());
                let fine = |i: usize, edge: usize| (i as f64 + 0.5) / FINE[edge] as f64;
                let points = (0..FINE[0] * FINE[1]).map(|i| {
                    let u = u0 + (u1 - u0) * fine(i % FINE[0], 0);
                    let phi = TAU * (sector as f64 + fine(i / FINE[0], 1)) / SECTORS as f64;
                    2.0 * u * (u1 - u0) * self.density(&pdf, lobe, 1.0 - u * u, phi)
                });
                points.sum::<f64>() * TAU / (FINE[0] * FINE[1] * SECTORS) as f64
            })
            .collect();
        expected.push((1.0 - expected.iter().sum::<f64>()).max(0.0));
        expected
    }

    /// Density of ωi carried over to (w, φ), with dh = cos³θ_h α² dw dφ/(2 (1 − w)²).
    fn density(&self, pdf: &impl Fn(Vec3, Vec3) -> f32, lobe: usize, w: f64, phi: f64) -> f64 {
        let tan = self.alpha * (w / (1.0 - w)).sqrt();
        let half = DVec3::new(tan * phi.cos(), tan * phi.sin(), 1.0).normalize();
        let projected = self.wo.dot(half);
        let eta = self.n[0] / self.n[1];
        let cos2_t = 1.0 - eta * eta * (1.0 - projected * projected);
        let (wi, jacobian) = match (projected > 0.0, lobe, cos2_t > 0.0) {
            (true, 0, _) => (2.0 * projected * half - self.wo, 4.0 * projected),
            (true, _, true) => {
                let cos_t = cos2_t.sqrt();
                let difference = eta * projected - cos_t;
                (difference * half - eta * self.wo, difference * difference / cos_t)
            }
            _ => return 0.0,
        };
        if (wi.z > 0.0) != (lobe == 0) {
            return 0.0;
        }
        let solid_angle = half.z.powi(3) * self.alpha * self.alpha / (2.0 * (1.0 - w) * (1.0 - w));
        f64::from(pdf(self.wo.as_vec3(), wi.as_vec3())) * jacobian * solid_angle
    }
}

fn cell(position: f64, cells: usize) -> usize {
    ((position * cells as f64) as usize).min(cells - 1)
}

/// p-value of samples of one surface against the density of another.
fn compare<const N: usize>(sampled: &RoughDielectric<N>, other: &RoughDielectric<N>, cells: &Cells) -> f64 {
    let (mut random, mut counts) = (Random::new(7), vec![0.0; BINS + 1]);
    let wo = cells.wo.as_vec3();
    for _ in 0..SAMPLES {
        let sample = sampled.sample(wo, Draw { uv: random.point(), lobe: random.unit() });
        counts[sample.map_or(BINS, |sample| cells.bin(sample.wi))] += 1.0;
    }
    chi_squared(&counts, &cells.integrate(|wo, wi| other.eval(wo, wi).pdf), SAMPLES as f64)
}

fn chi_squared_of<const N: usize>(surface: impl Fn([f64; 2], f32) -> RoughDielectric<N>, angles: &[f64]) {
    for n in SIDES {
        for alpha in ALPHAS {
            for &angle in angles {
                let wo = direction(angle, 0.7);
                // Of the lane that refracts most: wherever another one can send light, it can too.
                let last = n.map(|n| if n == 1.0 { n } else { f64::from((n + STEP * (N - 1) as f64) as f32) });
                let cells = Cells { wo: wo.as_dvec3().normalize(), alpha: alpha.into(), n: last };
                let wrong = if alpha < 1.0 { alpha * 1.05 } else { alpha / 1.05 };
                let right = compare(&surface(n, alpha), &surface(n, alpha), &cells);
                let other = compare(&surface(n, alpha), &surface(n, wrong), &cells);
                println!("{N} lanes, {n:?}, α {alpha:4} at {angle:2}°: p = {right:.3}, with a wrong α {other:.1e}");
                assert!(right > SIGNIFICANCE, "{n:?}, α {alpha} at {angle}°: p = {right:e}");
                assert!(other < SIGNIFICANCE, "{n:?}, α {alpha} at {angle}°: a wrong density passes, p = {other}");
            }
        }
    }
}

#[test]
fn lanes_follow_their_density_at_60_degrees() {
    chi_squared_of(single, &[60.0]);
    chi_squared_of(four, &[60.0]);
}

#[test]
#[ignore = "long: every angle"]
fn one_lane_follows_its_density_and_no_other() {
    chi_squared_of(single, &ANGLES);
}

#[test]
#[ignore = "long: every angle"]
fn four_lanes_follow_their_mean_density_and_no_other() {
    chi_squared_of(four, &ANGLES);
}

/// Mean weight of each lane, reflected and refracted, over points of a Kronecker sequence (M. Roberts, 2018).
fn sampled<const N: usize>(surface: &RoughDielectric<N>, wo: Vec3) -> [Lanes<N>; 2] {
    const COUNT: usize = 1 << 20;
    let mut sums = [[0.0f64; N]; 2];
    for i in 0..COUNT {
        let at = |step: f64| ((i as f64 * step + 0.5).fract() as f32).min(0.999_999_94);
        let u = [at(0.819_172_513_396_164_4), at(0.671_043_606_703_789_2)];
        if let Some(sample) = surface.sample(wo, Draw { uv: u, lobe: at(0.549_700_477_901_970_4) }) {
            let sum = &mut sums[usize::from(sample.wi.z < 0.0)];
            (0..N).for_each(|lane| sum[lane] += f64::from(sample.weight[lane]));
        }
    }
    sums.map(|sum| Lanes(sum.map(|sum| (sum / COUNT as f64) as f32)))
}

#[test]
fn energy_is_the_integral_at_60_degrees() {
    energy_is_the_integral(&[0.05, 0.3], &[60.0]);
}

#[test]
#[ignore = "long: every roughness and angle"]
fn energy_is_the_integral_over_half_vectors() {
    energy_is_the_integral(&[1e-3, 0.05, 0.3, 1.0], &ANGLES);
}

fn energy_is_the_integral(alphas: &[f32], angles: &[f64]) {
    for sides in SIDES {
        for &alpha in alphas {
            for &angle in angles {
                let wo = direction(angle, 0.7);
                let surface = four(sides, alpha);
                let [up, down] = sampled(&surface, wo);
                for lane in [0, 3] {
                    let n = sides.map(|n| if n == 1.0 { n } else { n + STEP * f64::from(lane) });
                    let fresnel = |cos: f64| exact::reflect(n[0], n[1], 0.0, cos).r;
                    let (alpha, cos) = (f64::from(alpha), f64::from(wo.z));
                    let [reflected, refracted] = albedo::dielectric(alpha, cos, n, fresnel);
                    let total = reflected + refracted;
                    let (up, down) =
                        (f64::from(up[lane as usize]) - reflected, f64::from(down[lane as usize]) - refracted);
                    println!(
                        "{n:?}, α {alpha:5.3} at {angle:2}°: {reflected:.5} + {refracted:.5} = {total:.5}, sampled {up:+.1e} {down:+.1e}"
                    );
                    assert!(total <= 1.0 + 2e-5, "{n:?}, α {alpha} at {angle}°: {total}");
                    assert!(up.abs().max(down.abs()) < 2e-3 * total, "{n:?}, α {alpha} at {angle}°: {up} {down}");
                }
            }
        }
    }
}

#[test]
fn the_smooth_interface_is_reached_without_a_jump() {
    for [n1, n2] in SIDES {
        for angle in [0.0, 30.0, 60.0, 80.0] {
            let wo = direction(angle, 0.4);
            let r = exact::reflect(n1, n2, 0.0, wo.z.into()).r;
            let [up, down] = sampled(&single([n1, n2], MIRROR_ALPHA), wo).map(|lanes| f64::from(lanes[0]));
            println!("{n1} → {n2} at {angle}°: {:+.1e} {:+.1e}", up - r, down - (1.0 - r));
            assert!((up - r).abs() < 5e-5 && (down - (1.0 - r)).abs() < 5e-5, "{n1} → {n2} at {angle}°: {up} {down}");
        }
    }
}

#[test]
fn equal_indices_let_everything_pass_straight_on() {
    for alpha in [1e-3, 0.1, 1.0] {
        for angle in [0.0, 60.0] {
            let wo = direction(angle, 0.4);
            let surface = glass(alpha, [1.5; 2], [1.5, 1.5 + 2e-6]);
            let (mut random, mut sum) = (Random::new(5), Lanes::ZERO);
            for _ in 0..20_000 {
                let Some(sample) = surface.sample(wo, Draw { uv: random.point(), lobe: random.unit() }) else {
                    continue;
                };
                assert!((sample.wi + wo).length() < 1e-2, "{:?}", sample.wi);
                sum += sample.weight;
            }
            let kept = sum * (1.0 / 20_000.0);
            let expected = albedo::dielectric(alpha.into(), wo.z.into(), [1.5, 1.5 + 1e-9], |_| 0.0)[1] as f32;
            println!("α {alpha} at {angle}°: {:?}, expected {expected}", kept.0);
            assert!((0..2).all(|lane| (kept[lane] / expected - 1.0).abs() < 0.02), "α {alpha} at {angle}°: {kept:?}");
        }
    }
}

fn roughness() -> impl Strategy<Value = f32> {
    prop_oneof![
        MIRROR_ALPHA..=1.0f32,
        Just(MIRROR_ALPHA),
        Just(1.0),
        (-4.0f32..0.0).prop_map(|x| 10f32.powf(x).max(1e-4))
    ]
}

fn index() -> impl Strategy<Value = f32> {
    prop_oneof![0.5f32..4.0, Just(1.0f32), Just(1.5f32), 1.4999f32..1.5001, (-6.0f32..6.0).prop_map(|x| 10f32.powf(x))]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 50_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nothing_breaks_anywhere(
        wo in upper(), wi in upper(), below in any::<bool>(), alpha in roughness(), u in [unit(), unit(), unit()],
        n1 in [index(), index()], n2 in [index(), index()],
    ) {
        let surface = glass(alpha, n1, n2);
        let eval = surface.eval(wo, if below { -wi } else { wi });
        prop_assert!(eval.pdf.is_finite() && eval.pdf >= 0.0, "{eval:?}");
        prop_assert!(eval.f_cos.0.iter().all(|f| f.is_finite() && *f >= 0.0), "{eval:?}");
        if let Some(sample) = surface.sample(wo, Draw { uv: [u[0], u[1]], lobe: u[2] }) {
            prop_assert!((sample.wi.length() - 1.0).abs() < 1e-6 && sample.wi.z != 0.0, "{sample:?}");
            prop_assert!(sample.pdf.is_finite() && sample.pdf > 0.0, "{sample:?}");
            prop_assert!(sample.weight.0.iter().all(|w| (0.0..2.000_01).contains(w)), "{sample:?}");
        }
    }

    /// Reflection keeps f, refraction f over the square of the index beyond.
    #[test]
    fn light_paths_can_be_reversed(wo in above(1e-2), wi in above(1e-2), alpha in 0.05f32..1.0, n in 0.6f32..2.0, ratio in 1.1f32..2.0, turned in any::<bool>()) {
        let n = if turned { [n * ratio, n] } else { [n, n * ratio] };
        let (here, beyond) = (glass(alpha, [n[0]], [n[1]]), glass(alpha, [n[1]], [n[0]]));
        let f = |surface: &RoughDielectric<1>, wo: Vec3, wi: Vec3| surface.eval(wo, wi).f_cos[0] / wi.z.abs();
        let (there, back) = (f(&here, wo, wi), f(&here, wi, wo));
        prop_assert!((there - back).abs() <= 1e-4 * there, "{there} {back}");
        let (there, back) = (f(&here, wo, -wi) / (n[1] * n[1]), f(&beyond, wi, -wo) / (n[0] * n[0]));
        // Near the critical angle the cosine on the thinner side is what rounding leaves of 1 − ratio² sin²: with c the smaller
        // cosine against the facet, a rounding of the other one moves it by ratio²/c² of itself.
        let facet = (wo * n[0] - wi * n[1]).normalize();
        let c = facet.dot(wo).abs().min(facet.dot(wi).abs());
        let allowed = (4e-5 + 2.0 * f32::EPSILON * ratio * ratio / (c * c)).min(1.0);
        prop_assert!((there - back).abs() <= allowed * there.max(back) + 1e-6, "{there} {back}, allowed {allowed}");
    }

    #[test]
    fn weight_is_value_over_density(wo in above(0.01), alpha in 0.05f32..1.0, u in [unit(), unit(), unit()], turned in any::<bool>()) {
        let surface = four(SIDES[usize::from(turned)], alpha);
        if let Some(sample) = surface.sample(wo, Draw { uv: [u[0], u[1]], lobe: u[2] }) {
            let eval = surface.eval(wo, sample.wi);
            prop_assert!((eval.pdf - sample.pdf).abs() <= 1e-5 * sample.pdf, "{} {}", eval.pdf, sample.pdf);
            for lane in 0..4 {
                let ratio = eval.f_cos[lane] / eval.pdf;
                prop_assert!((ratio - sample.weight[lane]).abs() <= 1e-5, "{ratio} {}", sample.weight[lane]);
            }
        }
    }
}
