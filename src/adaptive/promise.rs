//! A render that goes on until its error is small enough.
//!
//! Each half of the picture, the fields of a chessboard, is judged by the other one: where a half has how many samples, and when it has
//! enough of them. So the number of a pixel's samples depends on nothing that its half has drawn, and its mean is what it is without any
//! decision. A picture that stops when it happens to look quiet, by its own samples, is darker in the mean: light that few paths find is
//! found late, and then thinned by the samples that it asks for (10 % on caustics; `tests/promises`).
//!
//! For the same reason a half that has enough is kept as it is, and goes on only to judge the other one: what it would say of it must
//! not depend on when it itself was told to stop. When a half is judged next depends on its last judgement alone.
//!
//! What is promised of a half is what the noise of the other half would be with the samples of the first: how many the other half has was
//! decided by what the first one drew. Both promises together are the picture's.

use super::allocation::{Aim, Shares};
use super::bound::Bound;
use super::noise::{Noise, half};
use super::render_loop::{RenderLoop, counts, viewed, width};
use super::target::{Measure, Reached, Target};
use crate::film::Unseen;
use crate::film::View;
use crate::film::{Develop, FilmError, Layers, REPLICATES};
use crate::render::Samples;
use crate::scene::Chance;
use std::time::{Duration, Instant};

/// Samples of every pixel before any is judged: two of each replicate.
const FIRST: u64 = 2 * REPLICATES as u64;

/// The next look is this many times further.
const STEP: f64 = 1.15;

/// Where the end is not near, it is this part of the way to where it should be, and at most so many times further: early errors are guesses.
const LEAP: (f64, f64) = (0.8, 4.0);

/// No pixel gets less than this share of the mean number: what may be missing is judged by the pixels that have fewest.
const FEWEST: f64 = 0.5;

/// What a render goes on for.
#[derive(Clone, Copy, Debug)]
pub struct Goal<'a> {
    pub targets: &'a [Target],
    pub time: Option<Duration>,
    /// Samples a pixel at most.
    pub most: u64,
    /// Light that the render may not find.
    pub chance: &'a Chance,
}

/// What is promised of a picture on its way.
#[derive(Clone, Debug)]
pub struct Look<'a> {
    /// Samples a pixel.
    pub mean_samples: f64,
    pub targets: &'a [Target],
    /// One a target.
    pub bounds: Vec<Bound>,
}

/// What is promised of a half, and whether that is enough.
struct Promise {
    bounds: Vec<Bound>,
    /// The largest share of a target.
    excess: f64,
    /// Samples a pixel at which to look again.
    next: f64,
}

impl Promise {
    fn keeps(&self) -> bool {
        self.excess <= 1.0
    }
}

impl RenderLoop<'_> {
    /// Samples where they help most until the targets are met, the time is over, or the limit of samples is reached.
    /// `look` is told what is promised each time it is looked at.
    pub fn for_error(
        &self,
        layers: &mut Layers,
        goal: &Goal,
        develop: &Develop,
        look: &dyn Fn(&Look),
    ) -> Result<Reached, FilmError> {
        let (started, each) = (Instant::now(), REPLICATES as u64);
        let first = (FIRST.min(goal.most) / each).max(1) * each;
        self.evenly(layers, first);
        let (width, view) = viewed(layers, develop)?;
        let noise = Noise::of_each(layers.replicates(), width, &view);
        let shares = Shares::new(&noise, width, aim(goal.targets), FEWEST);
        let (mut mean, mut kept) = (first as f64, None);
        let mut promises = [0, 1].map(|which| goal.promise(layers, &view, mean, which));
        loop {
            look(&Look { mean_samples: mean, targets: goal.targets, bounds: together(goal.targets, &promises) });
            let affordable = goal.affordable(started.elapsed(), mean);
            let over = affordable < mean * 1.05 || mean >= goal.most as f64 || self.cancelled();
            if over || promises.iter().all(Promise::keeps) {
                // What one half was given only to judge the other one is taken back.
                kept.iter().for_each(|kept| layers.put_back(kept));
                return reached(layers, goal, &promises, develop);
            }
            if kept.is_none() {
                let settled = promises.iter().position(Promise::keeps);
                kept = settled.map(|which| layers.keep(of_half(layers, which)));
            }
            mean = nearest(&promises).min(affordable).min(goal.most as f64);
            self.add(layers, Samples::Own(&shares.ranges(counts(layers), mean, each)));
            let (_, view) = viewed(layers, develop)?;
            let last = mean >= affordable || mean >= goal.most as f64;
            for (which, promise) in promises.iter_mut().enumerate() {
                if !promise.keeps() && (last || mean >= promise.next) {
                    *promise = goal.promise(layers, &view, mean, which);
                }
            }
        }
    }
}

impl Goal<'_> {
    /// What a half is told by the other one after so many samples a pixel.
    fn promise(&self, layers: &Layers, view: &View, mean: f64, which: usize) -> Promise {
        let (counts, width): (Vec<u64>, _) = (counts(layers).collect(), width(layers));
        let own = counts.iter().enumerate().filter(|(at, _)| half(*at, width) == which);
        let unseen = Unseen {
            brightest: view.display_f64(self.chance.brightest),
            samples: own.map(|(_, count)| *count).min().unwrap_or(1) as f64,
            pixels: counts.len() as f64,
        };
        let noise = Noise::of_half(layers.replicates(), &counts, width, view, 1 - which);
        let bounds: Vec<Bound> = self.targets.iter().map(|target| target.measure.of(&noise, view, &unseen)).collect();
        let shares = self.targets.iter().zip(&bounds).map(|(target, bound)| bound.promised / target.bound);
        let excess = shares.fold(0.0, f64::max);
        // Errors fall at least as the root of the samples.
        let next = mean * (LEAP.0 * excess * excess).clamp(STEP, LEAP.1);
        Promise { bounds, excess, next }
    }

    /// Samples a pixel that there is time for, if that goes on as it went.
    fn affordable(&self, gone: Duration, mean: f64) -> f64 {
        self.time.map_or(f64::INFINITY, |time| time.as_secs_f64() * mean / gone.as_secs_f64())
    }
}

/// The samples a pixel at which one of the halves is judged next.
fn nearest(promises: &[Promise; 2]) -> f64 {
    let open = promises.iter().filter(|promise| !promise.keeps());
    open.map(|promise| promise.next).fold(f64::INFINITY, f64::min)
}

/// What a finished render tells of itself.
fn reached(layers: &Layers, goal: &Goal, promises: &[Promise; 2], develop: &Develop) -> Result<Reached, FilmError> {
    let (width, view) = viewed(layers, develop)?;
    Ok(Reached {
        bounds: together(goal.targets, promises),
        targets: goal.targets.to_vec(),
        mean_samples: layers.film().samples() as f64 / layers.film().pixels().len() as f64,
        met: promises.iter().all(|promise| promise.keeps()),
        way: goal.chance.way.clone(),
        held: Noise::of_each(layers.replicates(), width, &view).held(),
    })
}

/// The picture's bounds from those of its halves.
fn together(targets: &[Target], [a, b]: &[Promise; 2]) -> Vec<Bound> {
    let pairs = targets.iter().zip(a.bounds.iter().zip(&b.bounds));
    let of = |(target, (a, b)): (&Target, (&Bound, &Bound))| {
        let both = |of: fn(&Bound) -> f64| target.measure.of_both([of(a), of(b)]);
        Bound {
            estimate: both(|bound| bound.estimate),
            missed: both(|bound| bound.missed),
            promised: both(|bound| bound.promised),
        }
    };
    pairs.map(of).collect()
}

/// The pixels of a half.
fn of_half(layers: &Layers, which: usize) -> Vec<usize> {
    (0..layers.film().pixels().len()).filter(|at| half(*at, width(layers)) == which).collect()
}

/// What samples are shared out for, so that targets are met soon.
fn aim(targets: &[Target]) -> Aim {
    if targets.iter().all(|target| target.measure == Measure::Rmse) { Aim::Rmse } else { Aim::MeanDe }
}
