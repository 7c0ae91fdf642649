//! How long a render goes on: for so many samples, for so long, or until its error is small enough.

use super::show;
use crate::film::{Develop, FilmError, Layers, REPLICATES};
use crate::render::{PASS, Progress, Recorder, render_layers, render_planned};
use crate::report::View;
use crate::report::noise::{Bound, Noise, half};
use crate::report::plan::Shares;
use crate::scene::SceneError;
use clap::Args;
use std::fmt;
use std::str::FromStr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

#[derive(Clone, Debug, Args)]
pub struct EffortArgs {
    /// Render until the error of the picture is at most this, with 95 % confidence, and --spp or the limit at most: dE=0.5 for the
    /// mean ΔE2000, dE95=1 for its 95th percentile, rmse=0.01 for linear RGB; several are all kept
    #[arg(long, value_name = "MEASURE=BOUND,…", value_delimiter = ',')]
    target_error: Vec<Target>,
    /// Render for this long, such as 60s, 5m or 1h, and then write what there is
    #[arg(long, value_name = "TIME", value_parser = duration)]
    time: Option<Duration>,
}

/// A bound on an error of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    measure: Measure,
    bound: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Measure {
    MeanDe,
    De95,
    Rmse,
}

const MEASURES: [(&str, Measure); 3] = [("dE", Measure::MeanDe), ("dE95", Measure::De95), ("rmse", Measure::Rmse)];

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::MeanDe => "mean ΔE2000",
            Self::De95 => "95th percentile of ΔE2000",
            Self::Rmse => "RMSE of linear RGB",
        })
    }
}

impl Measure {
    fn of(self, noise: &Noise) -> Bound {
        match self {
            Self::MeanDe => noise.mean_de(),
            Self::De95 => noise.de95(),
            Self::Rmse => noise.rmse(),
        }
    }
}

impl FromStr for Target {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || "expected dE=BOUND, dE95=BOUND or rmse=BOUND".to_owned();
        let (name, bound) = text.split_once('=').ok_or_else(expected)?;
        let known = MEASURES.iter().find(|(known, _)| known.eq_ignore_ascii_case(name.trim()));
        let (_, measure) = known.ok_or_else(expected)?;
        match bound.trim().parse::<f64>() {
            Ok(bound) if bound > 0.0 && bound.is_finite() => Ok(Self { measure: *measure, bound }),
            _ => Err(format!("a bound on {name} is a number above 0")),
        }
    }
}

pub fn duration(text: &str) -> Result<Duration, String> {
    let text = text.trim();
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let scale = match &text[digits.len()..] {
        "" | "s" => 1.0,
        "ms" => 1e-3,
        "m" | "min" => 60.0,
        "h" => 3600.0,
        _ => return Err("expected a time such as 60s, 5m or 1h".into()),
    };
    match digits.trim().parse::<f64>() {
        Ok(number) if number > 0.0 && number * scale < 1e9 => Ok(Duration::from_secs_f64(number * scale)),
        _ => Err("expected a time above 0, such as 60s, 5m or 1h".into()),
    }
}

/// Samples a pixel at most, unless --spp says otherwise: where single precision and the sampler's table end to gain.
const LIMIT: u64 = 1 << 16;

/// Samples of every pixel before any is judged: two of each replicate.
const FIRST: u64 = 2 * REPLICATES as u64;

/// The next look is at least this many times further, and at most so many: looking costs, and early errors are guesses.
const STEP: (f64, f64) = (1.2, 4.0);

/// Aimed at so many times the samples that should do, so that one look more is seldom needed.
const AHEAD: f64 = 1.06;

/// How long a render is to go on.
#[derive(Clone, Debug, PartialEq)]
pub enum Effort {
    /// For so many samples a pixel.
    Samples(u64),
    /// Until the time is over, so many samples at most.
    Time { time: Duration, most: u64 },
    /// Until the targets are met, so many samples a pixel and so long at most.
    Error { targets: Vec<Target>, time: Option<Duration>, most: u64 },
}

impl EffortArgs {
    /// Whether nobody knows how many samples it takes.
    pub fn is_open(&self) -> bool {
        self.time.is_some() || self.judges()
    }

    /// Whether the picture's error decides.
    pub fn judges(&self) -> bool {
        !self.target_error.is_empty()
    }

    /// `asked` are the samples of the command line, `own` those of the scene.
    pub fn effort(&self, asked: Option<u32>, own: u32) -> Result<Effort, SceneError> {
        for (i, target) in self.target_error.iter().enumerate() {
            if let Some(other) = self.target_error[..i].iter().find(|other| other.measure == target.measure) {
                let message =
                    format!("--target-error bounds the {} twice: {} and {}", target.measure, other.bound, target.bound);
                return Err(SceneError::new(message));
            }
        }
        let (most, least) = (asked.map_or(LIMIT, u64::from), REPLICATES as u64);
        if self.judges() && most < least {
            let message =
                format!("--target-error compares {least} replicates of each pixel: it needs --spp {least} or more");
            return Err(SceneError::new(message));
        }
        Ok(match (self.target_error.is_empty(), self.time) {
            (true, None) => Effort::Samples(u64::from(own)),
            (true, Some(time)) => Effort::Time { time, most },
            (false, time) => Effort::Error { targets: self.target_error.clone(), time, most },
        })
    }
}

impl Effort {
    /// Samples a pixel that progress is shown against, if they are known.
    pub fn samples(&self) -> Option<u64> {
        match self {
            Self::Samples(samples) => Some(*samples),
            _ => None,
        }
    }
}

/// A render on its way.
pub struct Work<'a> {
    pub recorder: &'a Recorder<'a>,
    pub progress: &'a dyn Progress,
    pub cancel: &'a AtomicBool,
    pub quiet: bool,
}

impl Work<'_> {
    fn cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// Samples until the time is over; a pass that would take longer than what is left is made shorter.
    pub fn for_time(&self, layers: &mut Layers, time: Duration, most: u64) {
        let started = Instant::now();
        let mut done = 0;
        while done < most && !self.cancelled() {
            let gone = started.elapsed().as_secs_f64();
            let left = time.as_secs_f64() - gone;
            let fit = if done == 0 { 1.0 } else { left * done as f64 / gone };
            if done > 0 && fit < 1.0 {
                break;
            }
            let pass = (fit as u64).clamp(1, u64::from(PASS)).min(most - done);
            render_layers(self.recorder, layers, done..done + pass, self.progress, self.cancel);
            done += pass;
        }
    }

    /// Samples where they help most until the targets are met, the time is over, or `most` samples a pixel are reached.
    pub fn for_error(
        &self,
        layers: &mut Layers,
        (targets, time, most): (&[Target], Option<Duration>, u64),
        develop: &Develop,
    ) -> Result<Reached, FilmError> {
        let started = Instant::now();
        let each = REPLICATES as u64;
        let first = (FIRST.min(most) / each).max(1) * each;
        render_layers(self.recorder, layers, 0..first, self.progress, self.cancel);
        let (width, view) = viewed(layers, develop)?;
        let shares = self.shares(&Noise::of_each(layers.replicates(), width, &view), targets, layers);
        let mut means = [first as f64; 2];
        loop {
            let bounds = of_all(targets, &look(layers, develop)?);
            let mean = 0.5 * (means[0] + means[1]);
            self.tell(mean, targets, &bounds);
            let affordable =
                time.map_or(f64::INFINITY, |time| time.as_secs_f64() * mean / started.elapsed().as_secs_f64());
            let met = excess(targets, &bounds) <= 1.0;
            let reached = Reached { bounds, targets: targets.to_vec(), mean_samples: mean, met };
            if mean >= most as f64 || affordable < mean * 1.05 || self.cancelled() {
                return Ok(reached);
            }
            let next = self.next(layers, develop, targets, means)?;
            if met && next == means {
                return Ok(reached);
            }
            // Where either half finds the other one quiet enough, but both together are not, both go on.
            let next = if next == means { means.map(|mean| mean * STEP.0) } else { next };
            means = [0, 1].map(|half| next[half].min(affordable).min(most as f64).max(means[half]));
            let has = layers.film().pixels().iter().map(|pixel| u64::from(pixel.count()) + u64::from(pixel.rejected()));
            let plan = shares.ranges(has, |at| means[half(at, width)], each);
            render_planned(self.recorder, layers, &plan, self.progress, self.cancel);
        }
    }

    /// How many samples either half of the picture is to have, as the other half tells.
    fn next(
        &self,
        layers: &Layers,
        develop: &Develop,
        targets: &[Target],
        means: [f64; 2],
    ) -> Result<[f64; 2], FilmError> {
        let (width, view) = viewed(layers, develop)?;
        Ok([0, 1].map(|which| {
            let other = Noise::of_half(layers.replicates(), width, &view, 1 - which);
            // As if it had as many samples.
            let excess = excess(targets, &of_all(targets, &other)) * (means[1 - which] / means[which]).sqrt();
            match excess <= 1.0 {
                true => means[which],
                // Errors fall at least as the root of the samples.
                false => (means[which] * excess * excess * AHEAD).clamp(means[which] * STEP.0, means[which] * STEP.1),
            }
        }))
    }

    fn shares(&self, noise: &Noise, targets: &[Target], layers: &Layers) -> Shares {
        let width = layers.film().window().width as usize;
        match targets.iter().all(|target| target.measure == Measure::Rmse) {
            true => Shares::new(&noise.squares.iter().map(|square| square.sqrt()).collect::<Vec<_>>(), width, 1.0),
            false => Shares::new(&noise.de, width, 2.0 / 3.0),
        }
    }

    fn tell(&self, mean: f64, targets: &[Target], bounds: &[Bound]) {
        if self.quiet {
            return;
        }
        let each = |(target, bound): (&Target, &Bound)| {
            format!("{} ≤ {:.3} of {}", target.measure, bound.promised, target.bound)
        };
        let all: Vec<String> = targets.iter().zip(bounds).map(each).collect();
        show::note(format_args!("{mean:>6.0} samples a pixel: {}", all.join(", ")));
    }
}

fn of_all(targets: &[Target], noise: &Noise) -> Vec<Bound> {
    targets.iter().map(|target| target.measure.of(noise)).collect()
}

/// The largest share of a target that is promised.
fn excess(targets: &[Target], bounds: &[Bound]) -> f64 {
    targets.iter().zip(bounds).map(|(target, bound)| bound.promised / target.bound).fold(0.0, f64::max)
}

/// The width of what there is, and how it is looked at, at the exposure of what there is.
fn viewed(layers: &Layers, develop: &Develop) -> Result<(usize, View), FilmError> {
    let ev = develop.exposure.ev(layers.film().pixels().iter().map(|pixel| pixel.mean()[1]))?;
    Ok((layers.film().window().width as usize, View::new(ev, develop.white)))
}

fn look(layers: &Layers, develop: &Develop) -> Result<Noise, FilmError> {
    let (width, view) = viewed(layers, develop)?;
    Ok(Noise::of(layers.replicates(), width, &view))
}

/// What was asked for and what was reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Reached {
    pub targets: Vec<Target>,
    pub bounds: Vec<Bound>,
    pub mean_samples: f64,
    pub met: bool,
}

impl fmt::Display for Reached {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (i, (target, bound)) in self.targets.iter().zip(&self.bounds).enumerate() {
            let sign = if i == 0 { "" } else { "; " };
            let Bound { promised, estimate } = bound;
            write!(
                f,
                "{sign}{} at most {promised:.3} with 95 % confidence (about {estimate:.3}), asked for {}",
                target.measure, target.bound
            )?;
        }
        Ok(())
    }
}
