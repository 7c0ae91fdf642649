//! From renders and a reference to the numbers of a report.

use super::error::{Error, common_square, error, noise};
use super::ratio::median;
use super::{Bias, CLEAR, Ratio, Reference, Run, Variant, Way, findings, pareto};
use crate::film::{Unseen, View};
use crate::report::difference::{self, Compared, Image, compare, merged};

/// All renders of one variant with so many samples; the nth of each variant has the same seed, and was made in the same turn.
#[derive(Clone, Debug)]
pub struct Renders {
    /// A pixel.
    pub samples: u32,
    pub cpu_seconds: Vec<f64>,
    pub wall_seconds: Vec<f64>,
    pub setup_seconds: Vec<f64>,
    /// How many were traced.
    pub rays: Vec<f64>,
    pub images: Vec<Image>,
}

/// A variant's renders, the fewest samples first; the same counts in all variants.
#[derive(Clone, Debug)]
pub struct Measured {
    pub way: Way,
    pub renders: Vec<Renders>,
}

/// What pictures are measured against.
#[derive(Clone, Debug)]
pub enum Standard {
    /// Renders of the usual variant with seeds of their own, `samples` a pixel each: twice as many as those of a variant.
    Rendered {
        replicates: Vec<Image>,
        samples: u64,
    },
    File {
        name: String,
        samples: Option<u64>,
        image: Image,
    },
}

/// How much a picture is: for rates.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    pub pixels: f64,
}

impl Standard {
    pub fn image(&self) -> Image {
        match self {
            Self::Rendered { replicates, .. } => merged(replicates),
            Self::File { image, .. } => image.clone(),
        }
    }

    /// What is known of it, given renders of the usual variant.
    fn reference(&self, view: &View, usual: &Measured) -> Reference {
        match self {
            Self::Rendered { replicates, samples } => {
                let own = difference::noise(view, replicates);
                Reference {
                    file: None,
                    samples: Some(samples * replicates.len() as u64),
                    replicates: Some(replicates.len()),
                    mse: own.rmse * own.rmse,
                    delta_e2000: Some(own.delta_e2000),
                }
            }
            Self::File { name, samples, image } => Reference {
                file: Some(name.clone()),
                samples: *samples,
                replicates: None,
                mse: most(usual).map_or(0.0, |renders| mean_square(view, image, &renders.images).max(0.0)),
                delta_e2000: None,
            },
        }
    }

    /// The usual variant's bias.
    fn bias(&self, view: &View, usual: &Measured) -> Option<Bias> {
        let Self::Rendered { replicates, .. } = self else { return None };
        let paired: Vec<Image> = replicates.chunks(2).map(merged).collect();
        Some(bias(&compare(view, &paired, &most(usual)?.images, &Unseen::NOTHING)))
    }
}

/// What two renders have in common, over all pairs of them.
fn mean_square(view: &View, reference: &Image, images: &[Image]) -> f64 {
    let pairs = images.iter().enumerate().flat_map(|(i, a)| images[..i].iter().map(move |b| [a, b]));
    let squares: Vec<f64> = pairs.map(|pair| common_square(view, reference, pair)).collect();
    mean(&squares)
}

/// Those with the most samples.
fn most(measured: &Measured) -> Option<&Renders> {
    measured.renders.last()
}

fn bias(compared: &Compared) -> Bias {
    let delta_e = &compared.difference.delta_e2000;
    Bias { verdict: compared.difference.verdict, delta_e2000: delta_e.beyond_noise, interval_95: delta_e.interval_95 }
}

/// Every number of a scene; the usual variant is the first one.
pub fn measure(view: &View, standard: &Standard, all: &[Measured], scale: Scale) -> Option<(Reference, Vec<Variant>)> {
    let usual = all.first()?;
    let (reference, image) = (standard.reference(view, usual), standard.image());
    let of = |measured: &Measured| Variant {
        way: measured.way.clone(),
        time: (!measured.way.is_usual()).then(|| time(measured, usual)).flatten(),
        bias: match measured.way.is_usual() {
            true => standard.bias(view, usual),
            false => most(usual)
                .zip(most(measured))
                .map(|(a, b)| bias(&compare(view, &a.images, &b.images, &Unseen::NOTHING))),
        },
        runs: runs(view, &image, &reference, measured, scale),
    };
    let mut variants: Vec<Variant> = all.iter().map(of).collect();
    mark_front(&mut variants);
    Some((reference, variants))
}

/// By the three largest counts of samples: enough pairs for an interval that leaves the slowest out, and no render that is more of
/// starting than of rendering.
fn time(measured: &Measured, usual: &Measured) -> Option<Ratio> {
    let levels = measured.renders.iter().zip(&usual.renders).rev().take(3);
    let pairs = levels.flat_map(|(a, b)| a.cpu_seconds.iter().copied().zip(b.cpu_seconds.iter().copied()));
    Ratio::of(pairs)
}

fn runs(view: &View, image: &Image, reference: &Reference, measured: &Measured, scale: Scale) -> Vec<Run> {
    // The longest renders hold the samples of all others of their seed.
    let own = most(measured).map(|renders| merged(&renders.images)).unwrap_or_default();
    let of = |renders: &Renders| {
        let errors: Vec<Error> = renders.images.iter().map(|picture| error(view, image, picture)).collect();
        let each = |of: fn(&Error) -> f64| mean(&errors.iter().map(of).collect::<Vec<_>>());
        let noises: Vec<f64> = renders.images.chunks_exact(2).map(|p| noise(view, &own, [&p[0], &p[1]])).collect();
        let (cpu_seconds, wall_seconds) = (middle(&renders.cpu_seconds), middle(&renders.wall_seconds));
        let mse = each(|error| error.mse);
        Run {
            samples: renders.samples,
            cpu_seconds,
            wall_seconds,
            setup_seconds: middle(&renders.setup_seconds),
            samples_per_second: scale.pixels * f64::from(renders.samples) / wall_seconds.max(f64::MIN_POSITIVE),
            rays_per_second: mean(&renders.rays) / wall_seconds.max(f64::MIN_POSITIVE),
            mse,
            rel_mse: each(|error| error.rel_mse),
            delta_e2000: each(|error| error.delta_e2000),
            noise_delta_e2000: mean(&noises),
            efficiency: 1.0 / (mse * cpu_seconds).max(f64::MIN_POSITIVE),
            near_reference: mse < CLEAR * reference.mse,
            pareto: false,
        }
    };
    measured.renders.iter().map(of).collect()
}

fn mark_front(variants: &mut [Variant]) {
    let all = || variants.iter().flat_map(|variant| &variant.runs);
    let front = pareto::front(&all().map(|run| [run.cpu_seconds, run.mse]).collect::<Vec<_>>());
    let runs = variants.iter_mut().flat_map(|variant| &mut variant.runs);
    runs.zip(front).for_each(|(run, on_front)| run.pareto = on_front);
}

fn middle(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    median(&sorted)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

impl super::Scene {
    /// Says in sentences what its numbers say.
    pub fn with_findings(self) -> Self {
        let findings = findings::findings(&self);
        Self { findings, ..self }
    }
}
