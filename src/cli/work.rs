//! A render on its way: how many samples it goes on for, and which pixels get them.

use crate::adaptive::allocation::{Aim, LEAST, Shares};
use crate::adaptive::noise::Noise;
use crate::adaptive::pilot::Pilot;
use crate::film::View;
use crate::film::{Develop, FilmError, Layers, REPLICATES};
use crate::render::{PASS, Progress, Recorder, render_layers, render_planned};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Mean samples that are shared out at once, beyond what the noisiest pixels have: what an interrupted picture is uneven by.
const AT_ONCE: f64 = 64.0;

/// A render on its way.
pub struct Work<'a> {
    pub recorder: &'a Recorder<'a>,
    pub progress: &'a dyn Progress,
    pub cancel: &'a AtomicBool,
    pub quiet: bool,
}

impl Work<'_> {
    pub(super) fn cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// As many samples of every pixel.
    pub fn evenly(&self, layers: &mut Layers, samples: u64) {
        render_layers(self.recorder, layers, 0..samples, self.progress, self.cancel);
    }

    /// Samples from the `done`th on until the time is over; a pass that would take longer than what is left is made shorter. Says how many
    /// there are.
    pub fn evenly_for(&self, layers: &mut Layers, mut done: u64, time: Duration, most: u64) -> u64 {
        let (started, before) = (Instant::now(), done);
        while done < most && !self.cancelled() {
            let gone = started.elapsed().as_secs_f64();
            let left = time.as_secs_f64() - gone;
            let fit = if done == before { 1.0 } else { left * (done - before) as f64 / gone };
            if done > before && fit < 1.0 {
                break;
            }
            let pass = (fit as u64).clamp(1, u64::from(PASS)).min(most - done);
            render_layers(self.recorder, layers, done..done + pass, self.progress, self.cancel);
            done += pass;
        }
        done
    }

    /// So many samples a pixel in the mean, where they help most.
    pub fn shared(&self, layers: &mut Layers, samples: u64, aim: Aim, develop: &Develop) -> Result<(), FilmError> {
        let step = step(layers);
        let first = ((LEAST * samples as f64 / step as f64).ceil() as u64 * step).min(samples);
        let parts = self.in_parts(layers, (first / Pilot::ENOUGH).max(1), |next| next.end <= first);
        if self.cancelled() {
            return Ok(());
        }
        let shares =
            Shares::new(&self.noise(layers, parts, develop)?, width(layers), aim, first as f64 / samples as f64);
        let mut mean = first as f64 / shares.largest();
        while mean < samples as f64 && !self.cancelled() {
            mean = (mean + AT_ONCE).min(samples as f64);
            self.go_on(layers, &shares.ranges(counts(layers), |_| mean, step));
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
        let parts = self.in_parts(layers, 1, in_time);
        let first = parts.samples();
        if self.cancelled() {
            return Ok(());
        }
        if first < 2 * step {
            // Too few to tell anything of the noise; and one more may take longer than what is left.
            if left().as_secs_f64() * first as f64 >= started.elapsed().as_secs_f64() {
                self.evenly_for(layers, first, left(), most);
            }
            return Ok(());
        }
        let shares = Shares::new(&self.noise(layers, parts, develop)?, width(layers), aim, LEAST);
        let mut rate = layers.film().samples() as f64 / started.elapsed().as_secs_f64();
        let mut mean = first as f64 / shares.largest();
        while mean < most as f64 && !self.cancelled() {
            let further = rate * left().as_secs_f64() / layers.film().pixels().len() as f64;
            if further < 1.0 {
                break;
            }
            mean = (mean + further.min(AT_ONCE)).min(most as f64);
            let (before, clock) = (layers.film().samples(), Instant::now());
            self.go_on(layers, &shares.ranges(counts(layers), |_| mean, step));
            let samples = layers.film().samples() - before;
            if samples > 0 {
                rate = samples as f64 / clock.elapsed().as_secs_f64();
            }
        }
        Ok(())
    }

    /// The first samples of every pixel, part by part as long as a next one is wanted.
    fn in_parts(&self, layers: &mut Layers, size: u64, is_wanted: impl Fn(&Range<u64>) -> bool) -> Pilot {
        let mut parts = Pilot::of(size);
        loop {
            let next = parts.next_samples();
            if self.cancelled() || !is_wanted(&next) {
                return parts;
            }
            render_layers(self.recorder, layers, next, self.progress, self.cancel);
            // Replicates tell more by themselves.
            parts.look(if layers.replicates().is_empty() { layers.film().pixels() } else { &[] });
        }
    }

    /// How noisy each pixel is by itself.
    fn noise(&self, layers: &Layers, parts: Pilot, develop: &Develop) -> Result<Noise, FilmError> {
        let (width, view) = viewed(layers, develop)?;
        Ok(match layers.replicates() {
            [] => {
                debug_assert!(self.recorder.draws_in_halves(), "pixels would decide for themselves");
                Noise::of_pilot(&parts, width, &view)
            }
            replicates => Noise::of_each(replicates, width, &view),
        })
    }

    /// More samples of each pixel, row by row from the top.
    pub fn go_on(&self, layers: &mut Layers, plan: &[Range<u64>]) {
        render_planned(self.recorder, layers, plan, self.progress, self.cancel);
    }
}

/// Samples that pixels get at once: whole rounds of the replicates, or small nets.
fn step(layers: &Layers) -> u64 {
    if layers.replicates().is_empty() { 4 } else { REPLICATES as u64 }
}

/// Samples that each pixel has drawn.
pub(super) fn counts(layers: &Layers) -> impl Iterator<Item = u64> {
    layers.film().pixels().iter().map(|pixel| u64::from(pixel.count()) + u64::from(pixel.rejected()))
}

pub(super) fn width(layers: &Layers) -> usize {
    layers.film().window().width as usize
}

/// The width of what there is, and how it is looked at, at the exposure of what there is.
pub(super) fn viewed(layers: &Layers, develop: &Develop) -> Result<(usize, View), FilmError> {
    let ev = develop.exposure.ev(layers.film().luminances())?;
    Ok((width(layers), View::new(ev, develop.white)))
}
