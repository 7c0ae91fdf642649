//! Fresnel kernels: `cargo bench --bench fresnel`. Each figure is 1,000 evaluations, so µs read as ns for one, all lanes together.

use divan::{Bencher, black_box};
use spectrel::fresnel::{
    Fresnel, FresnelModel, RgbFresnel, RgbModel, Specimen, SpectralModel, Target, conductor, dielectric, exact,
};
use spectrel::math::Lanes;
use spectrel::spectrum::{Adaptation, Colorimeter, Library, Observer, RgbSpace};
use std::path::Path;

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
#[divan::bench(args = SpectralModel::ALL)]
fn spectral_at_a_hit_8(bencher: Bencher, model: &SpectralModel) {
    let ([n1, n2, k2], cosines) = (gold::<8>(), cosines::<8>());
    bencher.bench_local(|| {
        let hit = |cos: &Lanes<8>| Fresnel::Spectral(black_box(*model).at(&n1, &n2, &k2)).reflectance(cos[0]);
        cosines.iter().fold(Lanes::ZERO, |sum, cos| sum + hit(cos))
    });
}

/// The same of a curve that is fitted once.
#[divan::bench(args = FresnelModel::ALL.iter().filter_map(rgb))]
fn rgb_at_a_hit_8(bencher: Bencher, model: &RgbModel) {
    let library = Library::default();
    let ior = library.ior("Au/olmon-2012-evaporated", Path::new("")).expect("built in");
    let light = library.illuminant("D65", Path::new("")).expect("built in");
    let observer = library.observer(Observer::Cie1931).expect("built in");
    let meter = Colorimeter::new(&light.spectrum, &observer, RgbSpace::Srgb, Adaptation::Bradford).expect("light");
    let curve = model.fit(&Target::new(Specimen::in_vacuum(&ior), &meter));
    let primaries = [0.2, 0.5, 0.3].map(|share| black_box(Lanes::<8>::splat(share)));
    let cosines = cosines::<8>();
    bencher.bench_local(|| {
        let hit = |cos: &Lanes<8>| Fresnel::Rgb(RgbFresnel { curve: black_box(curve), primaries }).reflectance(cos[0]);
        cosines.iter().fold(Lanes::ZERO, |sum, cos| sum + hit(cos))
    });
}

fn rgb(model: &FresnelModel) -> Option<RgbModel> {
    match model {
        FresnelModel::Rgb(model) => Some(*model),
        FresnelModel::Spectral(_) => None,
    }
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
