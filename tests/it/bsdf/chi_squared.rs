//! Samplers against their densities by χ² tests, from α = 1e-3 to 1 and from normal to 89° incidence. Each test is also run
//! against a density that is 5 % wrong, and must notice.
//!
//! Bins are cells of the half-vector around the normal: w = r²/(1 + r²) with r = tan θ_h/α, and its azimuth, so that they fit a
//! highlight of any width. A last bin counts samples lost below the horizon, whose share is 1 − ∫ pdf.

use crate::statistics::{Random, chi_squared};
use glam::{DVec3, Vec3};
use spectrel::bsdf::{Bsdf, Conductor, Diffuse, Draw, Scatters};
use spectrel::fresnel::SpectralModel;
use spectrel::math::Lanes;
use spectrel::math::quadrature::gauss;
use std::f64::consts::TAU;

const ALPHAS: [f32; 7] = [1e-3, 0.01, 0.05, 0.1, 0.3, 0.5, 1.0];
const ANGLES: [f64; 5] = [0.0, 30.0, 60.0, 80.0, 89.0];
const SAMPLES: usize = 200_000;
const RINGS: usize = 16;
const SECTORS: usize = 12;

/// Chance of a false alarm over the whole file, shared among the tests by Šidák's rule: 1 − (1 − 0.01)^(1/40).
const SIGNIFICANCE: f64 = 2.5e-4;

fn direction(degrees: f64, azimuth: f64) -> Vec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos).as_vec3().normalize()
}

fn metal(alpha: f32) -> Bsdf<1> {
    Bsdf::Conductor(Conductor {
        fresnel: SpectralModel::Exact.at(&Lanes([1.0]), &Lanes([0.2]), &Lanes([3.0])).into(),
        alpha,
    })
}

/// Half-vector cells of a highlight of width `alpha`.
struct Cells {
    wo: DVec3,
    alpha: f64,
}

impl Cells {
    fn new(wo: Vec3, alpha: f32) -> Self {
        Self { wo: wo.as_dvec3().normalize(), alpha: alpha as f64 }
    }

    fn bin(&self, wi: Vec3) -> usize {
        let half = self.wo + wi.as_dvec3().normalize();
        let r = half.truncate().length() / (half.z * self.alpha);
        let w = r * r / (1.0 + r * r);
        let turn = half.y.atan2(half.x).rem_euclid(TAU) / TAU;
        cell(w, RINGS) * SECTORS + cell(turn, SECTORS)
    }

    /// Probability of each cell under the density of `bsdf`.
    fn integrate(&self, bsdf: &Bsdf<1>) -> Vec<f64> {
        let cells = (0..RINGS * SECTORS).map(|bin| (bin / SECTORS, bin % SECTORS));
        cells.map(|(ring, sector)| self.probability(bsdf, ring, sector)).collect()
    }

    fn probability(&self, bsdf: &Bsdf<1>, ring: usize, sector: usize) -> f64 {
        let step = |i: usize, n: usize| i as f64 / n as f64;
        let (w0, w1) = (step(ring, RINGS), step(ring + 1, RINGS));
        let (phi0, phi1) = (TAU * step(sector, SECTORS), TAU * step(sector + 1, SECTORS));
        gauss(&mut |phi| self.spoke(bsdf, phi, w0, w1), phi0, phi1)
    }

    /// ∫ dw at one azimuth, up to the horizon ρ_max = (s cos φ + √(s² cos² φ + z²))/z of `bsdf::albedo`.
    fn spoke(&self, bsdf: &Bsdf<1>, phi: f64, w0: f64, w1: f64) -> f64 {
        let side = self.wo.x * phi.cos() + self.wo.y * phi.sin();
        let end = (side + side.hypot(self.wo.z)) / self.wo.z / self.alpha;
        let end = end * end / (1.0 + end * end);
        if end <= w0 {
            return 0.0;
        }
        // u = √(1 − w) smooths the tail, where tan θ_h runs to infinity.
        let (u0, u1) = ((1.0 - w1.min(end)).sqrt(), (1.0 - w0).sqrt());
        gauss(&mut |u| 2.0 * u * self.density(bsdf, 1.0 - u * u, phi), u0, u1)
    }

    /// Density of ωi carried over to (w, φ): 4 (ωo·h) dh, with dh = cos³θ_h α² dw dφ/(2 (1 − w)²).
    fn density(&self, bsdf: &Bsdf<1>, w: f64, phi: f64) -> f64 {
        let tan = self.alpha * (w / (1.0 - w)).sqrt();
        let half = DVec3::new(tan * phi.cos(), tan * phi.sin(), 1.0).normalize();
        let projected = self.wo.dot(half);
        let wi = 2.0 * projected * half - self.wo;
        let pdf = bsdf.eval(self.wo.as_vec3(), wi.as_vec3()).pdf as f64;
        let one_minus_w = 1.0 - w;
        pdf * 4.0 * projected * half.z.powi(3) * self.alpha * self.alpha / (2.0 * one_minus_w * one_minus_w)
    }
}

fn cell(position: f64, cells: usize) -> usize {
    ((position * cells as f64) as usize).min(cells - 1)
}

/// Counts of `sampled`, lost samples last.
fn histogram(sampled: &Bsdf<1>, wo: Vec3, cells: &Cells, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    let mut counts = vec![0.0; RINGS * SECTORS + 1];
    for _ in 0..SAMPLES {
        match sampled.sample(wo, Draw { uv: random.point(), lobe: 0.0 }) {
            Some(sample) => counts[cells.bin(sample.wi)] += 1.0,
            None => counts[RINGS * SECTORS] += 1.0,
        }
    }
    counts
}

/// p-value of samples of one surface against the density of another.
fn compare(sampled: &Bsdf<1>, density: &Bsdf<1>, wo: Vec3, alpha: f32) -> f64 {
    let cells = Cells::new(wo, alpha);
    let mut expected = cells.integrate(density);
    let total: f64 = expected.iter().sum();
    assert!(total < 1.0 + 1e-3, "a density integrates to {total}");
    expected.push((1.0 - total).max(0.0));
    chi_squared(&histogram(sampled, wo, &cells, 7), &expected, SAMPLES as f64)
}

#[test]
fn metals_follow_their_density_and_no_other() {
    for alpha in ALPHAS {
        for angle in ANGLES {
            let wo = direction(angle, 0.7);
            let wrong = if alpha < 1.0 { alpha * 1.05 } else { alpha / 1.05 };
            let right = compare(&metal(alpha), &metal(alpha), wo, alpha);
            let other = compare(&metal(alpha), &metal(wrong), wo, alpha);
            println!("α {alpha:5} at {angle:2}°: p = {right:.3}, with a wrong α {other:.1e}");
            assert!(right > SIGNIFICANCE, "α {alpha} at {angle}°: p = {right:e}");
            assert!(other < SIGNIFICANCE, "α {alpha} at {angle}°: a wrong density passes, p = {other}");
        }
    }
}

#[test]
fn diffuse_follows_its_density_and_no_other() {
    let diffuse = Bsdf::Diffuse(Diffuse { reflectance: Lanes([0.5]) });
    for angle in ANGLES {
        let wo = direction(angle, 0.7);
        let right = compare(&diffuse, &diffuse, wo, 1.0);
        let other = compare(&diffuse, &metal(1.0), wo, 1.0);
        assert!(right > SIGNIFICANCE && other < SIGNIFICANCE, "{angle}°: p = {right}, wrong {other}");
    }
}

#[test]
fn densities_integrate_to_what_is_not_lost() {
    for alpha in ALPHAS {
        for angle in ANGLES {
            let wo = direction(angle, 0.7);
            let total: f64 = Cells::new(wo, alpha).integrate(&metal(alpha)).iter().sum();
            let kept = 1.0 - histogram(&metal(alpha), wo, &Cells::new(wo, alpha), 9).pop().unwrap() / SAMPLES as f64;
            println!("α {alpha:5} at {angle:2}°: ∫ pdf = {total:.6}, samples kept {kept:.6}");
            let noise = 4.0 * (kept * (1.0 - kept) / SAMPLES as f64).sqrt();
            assert!((total - kept).abs() < noise + 5e-5, "{alpha} {angle}: {total} {kept}");
        }
    }
}
