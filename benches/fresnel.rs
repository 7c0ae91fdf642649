//! Fresnel kernels: `cargo bench --bench fresnel`. Each figure is 1,000 evaluations, so µs read as ns for one, all lanes together.

use divan::{Bencher, black_box};
use spectrel::fresnel::{FresnelModel, conductor, dielectric, exact};
use spectrel::spectrum::Lanes;

fn main() {
    divan::main();
}

/// Varied input, so that the cost is throughput, not the latency of one.
fn cosines<const N: usize>() -> Vec<Lanes<N>> {
    (0..1000).map(|hit| Lanes::splat((hit as f32 * 0.618_034).fract())).collect()
}

fn gold<const N: usize>() -> [Lanes<N>; 3] {
    let n2 = Lanes::from_fn(|lane| [1.46, 1.43, 1.16, 0.54, 0.28, 0.21, 0.16, 0.15][lane % 8]);
    let k2 = Lanes::from_fn(|lane| [1.95, 1.85, 1.82, 2.17, 2.72, 3.12, 3.61, 4.21][lane % 8]);
    [black_box(Lanes::ONE), black_box(n2), black_box(k2)]
}

#[divan::bench(consts = [1, 8])]
fn conductor_exact<const N: usize>(bencher: Bencher) {
    let ([n1, n2, k2], cosines) = (gold::<N>(), cosines::<N>());
    bencher
        .bench_local(|| cosines.iter().fold(Lanes::ZERO, |sum, cos| sum + conductor::reflectance(&n1, &n2, &k2, cos)));
}

#[divan::bench(consts = [1, 8])]
fn conductor_exact_and_loss<const N: usize>(bencher: Bencher) {
    let ([n1, n2, k2], cosines) = (gold::<N>(), cosines::<N>());
    bencher.bench_local(|| {
        cosines.iter().fold(Lanes::ZERO, |sum, cos| {
            let (reflected, lost) = conductor::reflectance_and_loss(&n1, &n2, &k2, cos);
            sum + reflected * lost
        })
    });
}

/// As a hit uses it: indices to curve to reflectance, through the enum.
#[divan::bench(args = FresnelModel::ALL)]
fn model_at_a_hit_8(bencher: Bencher, model: &FresnelModel) {
    let ([n1, n2, k2], cosines) = (gold::<8>(), cosines::<8>());
    bencher.bench_local(|| {
        let hit = |cos: &Lanes<8>| black_box(*model).at(&n1, &n2, &k2).reflectance(cos[0]);
        cosines.iter().fold(Lanes::ZERO, |sum, cos| sum + hit(cos))
    });
}

#[divan::bench(consts = [1, 8])]
fn dielectric_exact<const N: usize>(bencher: Bencher) {
    let ([_, n2, _], n1, cosines) = (gold::<N>(), black_box(Lanes::splat(1.5)), cosines::<N>());
    bencher.bench_local(|| {
        cosines.iter().fold(Lanes::ZERO, |sum, cos| {
            let interface = dielectric::fresnel(&n1, &n2, cos);
            sum + interface.r + interface.cos_theta_t
        })
    });
}

#[divan::bench]
fn reference_f64(bencher: Bencher) {
    let cosines = cosines::<1>();
    bencher.bench_local(|| {
        cosines.iter().map(|cos| exact::reflect(1.0, black_box(0.235), 2.97, cos[0] as f64).r).sum::<f64>()
    });
}
