//! Renders that share samples out: how many a pixel gets is decided by what the first ones tell of its surroundings.

use super::allocation::{Aim, LEAST, Shares};
use super::noise::Noise;
use super::pilot::Pilot;
use super::render_loop::{RenderLoop, counts, viewed, width};
use crate::film::{Develop, FilmError, Layers, REPLICATES};
use crate::render::{Progress, Recorder, Samples};
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Mean samples that are shared out at once, beyond what the noisiest pixels have: what an interrupted picture is uneven by.
const AT_ONCE: f64 = 64.0;

/// A recorder that draws numbers of its own for either half of the picture: only so may one half decide about the other.
pub struct Halves<'a>(Recorder<'a>);

impl<'a> Halves<'a> {
    /// Of any recorder.
    pub fn of(recorder: Recorder<'a>) -> Self {
        Self(recorder.in_halves())
    }
}

/// A render that shares samples out.
pub struct SharedLoop<'a>(RenderLoop<'a>);

impl<'a> SharedLoop<'a> {
    /// `progress` and `cancel` as those of a [`RenderLoop`].
    pub fn new(Halves(recorder): &'a Halves<'a>, progress: &'a dyn Progress, cancel: &'a AtomicBool) -> Self {
        Self(RenderLoop::new(recorder, progress, cancel))
    }

    /// The same without sharing anything out.
    pub fn plain(&self) -> RenderLoop<'a> {
        self.0
    }

    /// So many samples a pixel in the mean, where they help most.
    pub fn shared(&self, layers: &mut Layers, samples: u64, aim: Aim, develop: &Develop) -> Result<(), FilmError> {
        let step = step(layers);
        let first = ((LEAST * samples as f64 / step as f64).ceil() as u64 * step).min(samples);
        let pilot = self.pilot(layers, (first / Pilot::ENOUGH).max(1), |next| next.end <= first);
        if self.0.cancelled() {
            return Ok(());
        }
        let noise = noise(layers, &pilot, develop)?;
        let shares = Shares::new(&noise, width(layers), aim, first as f64 / samples as f64);
        let mut mean = first as f64 / shares.largest();
        while mean < samples as f64 && !self.0.cancelled() {
            mean = (mean + AT_ONCE).min(samples as f64);
            self.0.add(layers, Samples::Own(&shares.ranges(counts(layers), mean, step)));
        }
        Ok(())
    }

    /// Samples where they help most until the time is over.
    pub fn shared_for(
        &self,
        layers: &mut Layers,
        (time, most): (Duration, u64),
        aim: Aim,
        develop: &Develop,
    ) -> Result<(), FilmError> {
        let (started, step) = (Instant::now(), step(layers));
        let left = || time.saturating_sub(started.elapsed());
        let in_time = |next: &Range<u64>| {
            let wanted = started.elapsed().as_secs_f64() * next.end as f64;
            let fits =
                next.end as f64 <= most as f64 * LEAST && wanted <= time.as_secs_f64() * LEAST * next.start as f64;
            next.start == 0 || fits
        };
        let pilot = self.pilot(layers, 1, in_time);
        let first = pilot.samples();
        if self.0.cancelled() {
            return Ok(());
        }
        if first < 2 * step {
            // Too few to tell anything of the noise; and one more may take longer than what is left.
            if left().as_secs_f64() * first as f64 >= started.elapsed().as_secs_f64() {
                self.0.evenly_for(layers, first, left(), most);
            }
            return Ok(());
        }
        let shares = Shares::new(&noise(layers, &pilot, develop)?, width(layers), aim, LEAST);
        let mut rate = layers.film().samples() as f64 / started.elapsed().as_secs_f64();
        let mut mean = first as f64 / shares.largest();
        while mean < most as f64 && !self.0.cancelled() {
            let further = rate * left().as_secs_f64() / layers.film().pixels().len() as f64;
            if further < 1.0 {
                break;
            }
            mean = (mean + further.min(AT_ONCE)).min(most as f64);
            let (before, clock) = (layers.film().samples(), Instant::now());
            self.0.add(layers, Samples::Own(&shares.ranges(counts(layers), mean, step)));
            let samples = layers.film().samples() - before;
            if samples > 0 {
                rate = samples as f64 / clock.elapsed().as_secs_f64();
            }
        }
        Ok(())
    }

    /// The first samples of every pixel, part by part as long as a next one is wanted.
    fn pilot(&self, layers: &mut Layers, size: u64, is_wanted: impl Fn(&Range<u64>) -> bool) -> Pilot {
        let mut pilot = Pilot::of(size);
        loop {
            let next = pilot.next_samples();
            if self.0.cancelled() || !is_wanted(&next) {
                return pilot;
            }
            self.0.add(layers, Samples::Same(next));
            // Replicates tell more by themselves.
            pilot.look(if layers.replicates().is_empty() { layers.film().pixels() } else { &[] });
        }
    }
}

/// How noisy each pixel is by itself.
fn noise(layers: &Layers, pilot: &Pilot, develop: &Develop) -> Result<Noise, FilmError> {
    let (width, view) = viewed(layers, develop)?;
    Ok(match layers.replicates() {
        [] => Noise::of_pilot(pilot, width, &view),
        replicates => Noise::of_each(replicates, width, &view),
    })
}

/// Samples that pixels get at once: whole rounds of the replicates, or small nets.
fn step(layers: &Layers) -> u64 {
    if layers.replicates().is_empty() { 4 } else { REPLICATES as u64 }
}
