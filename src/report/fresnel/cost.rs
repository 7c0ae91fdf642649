//! What a model costs at a hit: the time of one evaluation for all lanes, measured here and now.
//!
//! The median of [`RUNS`] runs over a thousand angles, as rendering evaluates it: for a conductor the reflectance from the indices, for a clear
//! medium the angle of refraction with it. A figure to compare models by on one machine; `benches/fresnel.rs` measures with more care.

use super::Subject;
use crate::fresnel::{DielectricFresnel, Fresnel, FresnelModel, RgbFresnel, Target};
use crate::spectrum::{Colorimeter, LANES, Lanes};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Many and short, so that the median is one that no other process interrupted.
const RUNS: usize = 101;

/// Of one run; with [`RUNS`] some 25 ms a model.
const LEAST: Duration = Duration::from_micros(250);

/// Wavelengths of a path, nm.
const WAVELENGTHS: [f64; LANES] = [415.0, 455.0, 495.0, 535.0, 575.0, 615.0, 655.0, 695.0];

/// Nanoseconds of one evaluation, all lanes together.
pub fn nanoseconds(model: FresnelModel, subject: &Subject, meter: &Colorimeter) -> f64 {
    let indices = WAVELENGTHS.map(|nm| subject.specimen.indices(nm));
    let [n1, n2, k2] = [0, 1, 2].map(|part| Lanes::from_fn(|lane| indices[lane][part] as f32));
    // Varied, so that what is timed is how many fit in a second, not how long one waits for another.
    let cosines: Vec<f32> = (0..1000).map(|hit| (hit as f32 * 0.618_034).fract()).collect();
    let rgb = match model {
        FresnelModel::Rgb(model) => {
            let primaries = [0.2, 0.5, 0.3].map(Lanes::splat);
            Some(RgbFresnel { curve: model.fit(&Target::new(subject.specimen, meter)), primaries })
        }
        FresnelModel::Spectral(_) => None,
    };
    let metal = |cos: f32| -> Lanes<LANES> {
        match (black_box(model), &rgb) {
            (FresnelModel::Spectral(model), _) => {
                Fresnel::from(model.at(black_box(&n1), black_box(&n2), black_box(&k2))).reflectance(cos)
            }
            (_, Some(rgb)) => Fresnel::Rgb(*black_box(rgb)).reflectance(cos),
            _ => Lanes::ZERO,
        }
    };
    let boundary = |cos: f32| -> Lanes<LANES> {
        let fresnel = match (black_box(model), &rgb) {
            (FresnelModel::Spectral(model), _) => DielectricFresnel::from(model),
            (_, Some(rgb)) => DielectricFresnel::Rgb(*black_box(rgb)),
            _ => return Lanes::ZERO,
        };
        let interface = fresnel.at(black_box(&n1), black_box(&n2), &Lanes::splat(cos));
        interface.r + interface.cos_theta_t
    };
    if subject.clear { median(|| sum(&cosines, boundary)) } else { median(|| sum(&cosines, metal)) }
}

fn sum(cosines: &[f32], evaluate: impl Fn(f32) -> Lanes<LANES>) -> usize {
    black_box(cosines.iter().fold(Lanes::ZERO, |sum, &cos| sum + evaluate(cos)));
    cosines.len()
}

/// Of the time that one of the evaluations takes which `pass` makes and counts.
fn median(pass: impl Fn() -> usize) -> f64 {
    let run = || {
        let (start, mut evaluations) = (Instant::now(), 0);
        while start.elapsed() < LEAST {
            evaluations += pass();
        }
        start.elapsed().as_secs_f64() * 1e9 / evaluations as f64
    };
    let mut times: Vec<f64> = (0..RUNS).map(|_| run()).collect();
    times.sort_by(f64::total_cmp);
    times[RUNS / 2]
}
