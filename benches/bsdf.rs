//! Surfaces with eight lanes: `cargo bench --bench bsdf`. Each figure is 1,000 calls, so µs read as ns for one.

use divan::{Bencher, black_box};
use glam::Vec3;
use spectrel::bsdf::{Bsdf, Conductor, Diffuse, Draw, RoughDielectric, Scatters, albedo, choose, dielectric};
use spectrel::fresnel::{SpectralModel, dielectric::fresnel};
use spectrel::math::Lanes;
use spectrel::math::{Frame, Vectors};

fn main() {
    divan::main();
}

fn points() -> Vec<[f32; 2]> {
    (0..1000).map(|i| [(i as f32 * 0.754_877_7).fract(), (i as f32 * 0.569_840_3).fract()]).collect()
}

fn metal(model: SpectralModel, alpha: f32) -> Bsdf<8> {
    let n2 = Lanes([1.46, 1.43, 1.16, 0.54, 0.28, 0.21, 0.16, 0.15]);
    let k2 = Lanes([1.95, 1.85, 1.82, 2.17, 2.72, 3.12, 3.61, 4.21]);
    Bsdf::Conductor(Conductor { fresnel: black_box(model).at(&Lanes::ONE, &n2, &k2).into(), alpha })
}

fn sampling(bencher: Bencher, bsdf: Bsdf<8>) {
    let (bsdf, points, wo) = (black_box(bsdf), points(), black_box(Vec3::new(0.6, 0.0, 0.8)));
    bencher.bench_local(|| {
        points
            .iter()
            .filter_map(|&u| bsdf.sample(wo, Draw { uv: u, lobe: 0.0 }))
            .fold(Lanes::ZERO, |sum, s| sum + s.weight * (s.wi.x + s.pdf))
    });
}

#[divan::bench(args = SpectralModel::ALL)]
fn sample_rough_metal(bencher: Bencher, model: &SpectralModel) {
    sampling(bencher, metal(*model, 0.3));
}

#[divan::bench(args = SpectralModel::ALL)]
fn sample_mirror(bencher: Bencher, model: &SpectralModel) {
    sampling(bencher, metal(*model, 0.0));
}

#[divan::bench]
fn sample_diffuse(bencher: Bencher) {
    sampling(bencher, Bsdf::Diffuse(Diffuse { reflectance: Lanes::splat(0.5) }));
}

#[divan::bench(args = SpectralModel::ALL)]
fn eval_rough_metal(bencher: Bencher, model: &SpectralModel) {
    let (bsdf, wo) = (black_box(metal(*model, 0.3)), black_box(Vec3::new(0.6, 0.0, 0.8)));
    let directions: Vec<_> = points().iter().map(|u| Vec3::new(u[0] - 0.5, u[1] - 0.5, 0.7).normalize()).collect();
    bencher.bench_local(|| {
        directions.iter().fold(Lanes::ZERO, |sum, &wi| {
            let eval = bsdf.eval(wo, wi);
            sum + eval.f_cos * eval.pdf
        })
    });
}

fn rough_glass(model: SpectralModel) -> RoughDielectric<8> {
    let n2 = Lanes([1.86, 1.83, 1.81, 1.80, 1.79, 1.78, 1.775, 1.77]);
    RoughDielectric::new(black_box(model).into(), &Lanes::ONE, black_box(&n2), 0.3)
}

#[divan::bench(args = SpectralModel::ALL)]
fn sample_rough_glass(bencher: Bencher, model: &SpectralModel) {
    let (bsdf, points, wo) = (black_box(rough_glass(*model)), points(), black_box(Vec3::new(0.6, 0.0, 0.8)));
    bencher.bench_local(|| {
        let samples = points.iter().filter_map(|&u| bsdf.sample(wo, Draw { uv: u, lobe: (7.0 * u[0]).fract() }));
        samples.fold(Lanes::ZERO, |sum, s| sum + s.weight * (s.wi.x + s.pdf))
    });
}

/// Half of the directions above the surface, half below.
#[divan::bench(args = SpectralModel::ALL)]
fn eval_rough_glass(bencher: Bencher, model: &SpectralModel) {
    let (bsdf, wo) = (black_box(rough_glass(*model)), black_box(Vec3::new(0.6, 0.0, 0.8)));
    let side = |i: usize| if i.is_multiple_of(2) { 0.7 } else { -0.7 };
    let points = points();
    let directions: Vec<_> =
        points.iter().enumerate().map(|(i, u)| Vec3::new(u[0] - 0.8, u[1] - 0.5, side(i)).normalize()).collect();
    bencher.bench_local(|| {
        directions.iter().fold(Lanes::ZERO, |sum, &wi| {
            let eval = bsdf.eval(wo, wi);
            sum + eval.f_cos * eval.pdf
        })
    });
}

/// Fresnel, shared choice and eight refracted directions at a dispersive facet.
#[divan::bench]
fn dispersive_interface(bencher: Bencher) {
    let points = points();
    let n2 = Lanes([2.46, 2.45, 2.44, 2.43, 2.42, 2.415, 2.41, 2.405]);
    let (direction, normal) = (Vectors::splat(Vec3::new(0.6, 0.0, -0.8)), Vectors::splat(Vec3::Z));
    let cos = direction.dot(&Vectors::splat(-Vec3::Z));
    bencher.bench_local(|| {
        points.iter().fold(Lanes::ZERO, |sum, u| {
            let (n2, direction) = (black_box(&n2), black_box(&direction));
            let interface = fresnel(&Lanes::ONE, n2, &cos);
            let choice = choose(&Lanes::ONE, &interface.r, u[0]);
            let eta = Lanes::ONE / *n2;
            let refracted = dielectric::refract_lanes(direction, &normal, &eta, &cos, &interface.cos_theta_t);
            sum + choice.weight * Lanes(refracted.x)
        })
    });
}

#[divan::bench]
fn frame(bencher: Bencher) {
    let normals: Vec<_> = points().iter().map(|u| Vec3::new(u[0] - 0.5, u[1] - 0.5, 0.7).normalize()).collect();
    bencher.bench_local(|| {
        normals.iter().fold(Vec3::ZERO, |sum, &normal| sum + Frame::new(normal).to_world(Vec3::new(0.6, 0.0, 0.8)))
    });
}

/// One call.
#[divan::bench(args = [1e-3, 0.1, 1.0])]
fn reference_albedo(bencher: Bencher, alpha: f64) {
    bencher.bench_local(|| albedo::albedo(alpha, black_box(0.3), |c| c));
}

/// One call.
#[divan::bench(args = [0.05, 1.0], sample_count = 10)]
fn reference_albedo_of_glass(bencher: Bencher, alpha: f64) {
    bencher.bench_local(|| albedo::dielectric(alpha, black_box(0.3), [1.0, 1.5], |c| 1.0 - c));
}
