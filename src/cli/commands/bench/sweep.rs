//! All renders of one scene within a time: every way at more and more samples a pixel, then the reference.
//!
//! Ways take turns, each turn with one seed, so that what else the machine does falls on all alike. A count of samples is begun only if
//! it and a reference of [`LEAST`] × as many samples are expected to end in time, by what the renders before it took. Ways that change
//! several things are given up, from the last on, until all that are left get to [`GOAL`] counts.

use super::clock::{Clock, Spent};
use crate::adaptive::{Aim, Halves, LEAST_SHARED, RenderLoop, SharedLoop};
use crate::cli::picture::{development, window};
use crate::film::{Layers, Pixel, Wanted, fnv1a_64};
use crate::render::{Kernel, PASS, Recorder, rays};
use crate::report::bench::Renders;
use crate::report::difference::Image;
use crate::scene::{Needs, Scene, SceneError};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Renders of one way with so many samples: enough to tell noise from difference.
pub const REPEATS: usize = 4;

/// Renders that the reference is the mean of.
pub const REPLICATES: usize = 2 * REPEATS;

/// Samples of the reference over the largest count of the sweep: at least, unless time is short, and at most.
const LEAST: u32 = 16;
const MOST: u32 = 64;

/// Samples a pixel unless the command line says otherwise: as many of them as the time is enough for.
pub const LADDER: [u32; 7] = [4, 16, 64, 256, 1024, 4096, 16384];

/// Counts of samples, the first ones, that are worth more than one more combination: a slope, and an error that is not all noise.
const GOAL: usize = 3;

/// Part of the time that may go into seeing how long ways take.
const PILOT: f64 = 0.25;

/// How long one way takes.
#[derive(Clone, Copy, Debug)]
struct Cost {
    /// Before the first sample.
    setup_seconds: f64,
    /// Wall time of one sample of every pixel.
    sample_seconds: f64,
}

impl Cost {
    fn of(&self, samples: u32) -> f64 {
        self.setup_seconds + f64::from(samples) * self.sample_seconds
    }
}

/// One render.
struct Shot {
    image: Image,
    setup_seconds: f64,
    spent: Spent,
    rays: u64,
}

/// What is to be rendered.
#[derive(Clone, Debug)]
pub struct Assignment<'a> {
    pub seed: u64,
    /// Samples a pixel, ascending.
    pub counts: &'a [u32],
    /// The ways at the beginning that change one thing at most.
    pub singles: usize,
    /// Of the reference; `None`: what there is time for.
    pub reference: Option<u32>,
    /// Whether there is no reference yet.
    pub needs_reference: bool,
    pub time: Duration,
}

/// What was rendered.
pub struct Swept {
    /// By way; fewer ways than asked for if time was short.
    pub renders: Vec<Vec<Renders>>,
    /// Of the reference, and their samples.
    pub replicates: Vec<Image>,
    pub replicate_samples: u32,
    /// The counts that there was no time for.
    pub counts_left_out: Vec<u32>,
}

pub struct Sweep<'a> {
    assignment: &'a Assignment<'a>,
    /// Each with what its samples are shared out for.
    scenes: Vec<(Scene, Option<Aim>)>,
    costs: Vec<Cost>,
    started: Instant,
    tell: &'a dyn Fn(String),
}

impl<'a> Sweep<'a> {
    /// The usual way first. Renders each once to see how long it takes; what there is no time to see is left out.
    pub fn begin(
        scenes: Vec<(Scene, Option<Aim>)>,
        assignment: &'a Assignment,
        tell: &'a dyn Fn(String),
    ) -> Result<Self, SceneError> {
        let mut sweep = Self { assignment, scenes, costs: Vec::new(), started: Instant::now(), tell };
        let samples = sweep.first().min(PASS);
        // What only the first render of all pays is nobody's cost.
        sweep.shoot(0, seed(assignment.seed, "pilot", 0), samples)?;
        for way in 0..sweep.scenes.len() {
            if way > 0 && sweep.left() < (1.0 - PILOT) * assignment.time.as_secs_f64() {
                sweep.scenes.truncate(way);
                break;
            }
            let shot = sweep.shoot(way, seed(assignment.seed, "pilot", 0), samples)?;
            sweep.costs.push(cost(&shot, samples));
        }
        Ok(sweep)
    }

    pub fn run(mut self) -> Result<Swept, SceneError> {
        self.shorten();
        let mut renders = vec![Vec::new(); self.scenes.len()];
        let mut done = 0;
        for (i, &samples) in self.assignment.counts.iter().enumerate() {
            // The first one in any case: without it there is nothing to say.
            if i > 0 && self.level(samples) + self.least_reference(samples) > self.left() {
                break;
            }
            (self.tell)(format!("{samples} samples a pixel, {} ways, {REPEATS} times each", self.scenes.len()));
            self.level_of_all(samples, &mut renders)?;
            done = i + 1;
        }
        let (replicates, replicate_samples) = self.reference(self.assignment.counts[done - 1])?;
        Ok(Swept { renders, replicates, replicate_samples, counts_left_out: self.assignment.counts[done..].to_vec() })
    }

    fn first(&self) -> u32 {
        self.assignment.counts[0]
    }

    /// Seconds until time is over.
    fn left(&self) -> f64 {
        self.assignment.time.as_secs_f64() - self.started.elapsed().as_secs_f64()
    }

    /// Drops ways from the end: combinations until the first counts are expected to fit, others until the fewest samples are; the usual
    /// one stays.
    fn shorten(&mut self) {
        let counts = self.assignment.counts;
        self.shorten_to(self.assignment.singles, &counts[..GOAL.min(counts.len())]);
        self.shorten_to(1, &counts[..1]);
    }

    fn shorten_to(&mut self, least: usize, counts: &[u32]) {
        let most = counts.last().copied().unwrap_or(0);
        let needed = |sweep: &Self| {
            counts.iter().map(|&samples| sweep.level(samples)).sum::<f64>() + sweep.least_reference(most)
        };
        while self.scenes.len() > least && needed(self) > self.left() {
            self.scenes.pop();
            self.costs.pop();
        }
    }

    /// Expected seconds of all ways with so many samples.
    fn level(&self, samples: u32) -> f64 {
        REPEATS as f64 * self.costs.iter().map(|cost| cost.of(samples)).sum::<f64>()
    }

    /// Expected seconds of the least reference for so many samples.
    fn least_reference(&self, samples: u32) -> f64 {
        match (self.assignment.needs_reference, self.assignment.reference) {
            (false, _) => 0.0,
            (true, Some(asked)) => self.replicates(share(asked)),
            (true, None) => self.replicates(share(samples.saturating_mul(LEAST))),
        }
    }

    fn replicates(&self, samples: u32) -> f64 {
        REPLICATES as f64 * self.costs[0].of(samples)
    }

    fn level_of_all(&mut self, samples: u32, renders: &mut [Vec<Renders>]) -> Result<(), SceneError> {
        renders.iter_mut().for_each(|all| all.push(empty(samples)));
        for turn in 0..REPEATS {
            for (way, all) in renders.iter_mut().enumerate() {
                let shot = self.shoot(way, seed(self.assignment.seed, "turn", turn), samples)?;
                self.costs[way] = cost(&shot, samples);
                all.last_mut().into_iter().for_each(|renders| add(renders, &shot));
            }
        }
        Ok(())
    }

    /// Renders of the usual way with seeds of their own, and the samples of each: a power of two, unless asked for.
    fn reference(&mut self, largest: u32) -> Result<(Vec<Image>, u32), SceneError> {
        if !self.assignment.needs_reference {
            return Ok((Vec::new(), 0));
        }
        let samples = match self.assignment.reference {
            Some(asked) => share(asked),
            None => self.affordable(share(largest), share(largest.saturating_mul(MOST))),
        };
        (self.tell)(format!("the reference, {REPLICATES} × {samples} samples a pixel"));
        let shots =
            (0..REPLICATES).map(|i| Ok(self.shoot(0, seed(self.assignment.seed, "reference", i), samples)?.image));
        Ok((shots.collect::<Result<_, SceneError>>()?, samples))
    }

    /// The largest power of two that ends in time, within these limits.
    fn affordable(&self, least: u32, most: u32) -> u32 {
        let (left, least) = (self.left(), least.next_power_of_two());
        let larger = std::iter::successors(Some(least), |samples| samples.checked_mul(2));
        let fitting = larger.take_while(|&samples| samples <= most && self.replicates(samples) <= left);
        fitting.last().unwrap_or(least)
    }

    fn shoot(&mut self, way: usize, seed: u64, samples: u32) -> Result<Shot, SceneError> {
        let (scene, aim) = &mut self.scenes[way];
        scene.settings.seed = seed;
        let size = [scene.settings.width, scene.settings.height];
        let mut layers = Layers::new(size, window(scene.settings.crop), Wanted::default()).map_err(SceneError::new)?;
        let setup = Clock::start();
        let needs = Needs::of(scene);
        let kernel = Kernel::new(scene, &needs);
        let recorder = Recorder::new(&kernel, None, None);
        let cancel = AtomicBool::new(false);
        let (setup_seconds, before, clock) = (setup.spent().wall_seconds, rays_traced(), Clock::start());
        match *aim {
            None => RenderLoop::new(&recorder, &(), &cancel).evenly(&mut layers, u64::from(samples)),
            Some(aim) => {
                let halves = Halves::of(recorder);
                let render = SharedLoop::new(&halves, &(), &cancel);
                match samples < LEAST_SHARED {
                    true => render.plain().evenly(&mut layers, u64::from(samples)),
                    false => render
                        .shared(&mut layers, u64::from(samples), aim, &development(scene))
                        .map_err(SceneError::new)?,
                }
            }
        }
        let (spent, rays) = (clock.spent(), rays_traced() - before);
        let image = layers.film().pixels().iter().map(Pixel::mean).map(|xyz| xyz.map(|c| c as f32)).collect();
        Ok(Shot { image, setup_seconds, spent, rays })
    }
}

/// By all threads that render.
fn rays_traced() -> u64 {
    rayon::broadcast(|_| rays::traced()).into_iter().fold(0, u64::wrapping_add)
}

fn empty(samples: u32) -> Renders {
    let none = Vec::new;
    Renders {
        samples,
        cpu_seconds: none(),
        wall_seconds: none(),
        setup_seconds: none(),
        rays: none(),
        images: Vec::new(),
    }
}

fn add(renders: &mut Renders, shot: &Shot) {
    renders.cpu_seconds.push(shot.spent.cpu_seconds);
    renders.wall_seconds.push(shot.spent.wall_seconds);
    renders.setup_seconds.push(shot.setup_seconds);
    renders.rays.push(shot.rays as f64);
    renders.images.push(shot.image.clone());
}

fn cost(shot: &Shot, samples: u32) -> Cost {
    Cost { setup_seconds: shot.setup_seconds, sample_seconds: shot.spent.wall_seconds / f64::from(samples) }
}

/// Of each replicate, for so many samples of all.
fn share(samples: u32) -> u32 {
    samples.div_ceil(REPLICATES as u32)
}

/// Seeds that have nothing to do with each other.
fn seed(seed: u64, purpose: &str, number: usize) -> u64 {
    fnv1a_64(format!("bench: {purpose} {number} of seed {seed}").as_bytes())
}
