//! The loop in which every render goes on: more samples of all pixels, or of each as many as it was given.
//!
//! What is recorded beside the picture, and whether samples are shared out, changes nothing of the loop: a plain film is one with no layers.

use crate::film::{Develop, FilmError, Layers, View};
use crate::render::{PASS, Progress, Recorder, Samples, render};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// A render on its way.
#[derive(Clone, Copy)]
pub struct RenderLoop<'a> {
    recorder: &'a Recorder<'a>,
    progress: &'a dyn Progress,
    cancel: &'a AtomicBool,
}

impl<'a> RenderLoop<'a> {
    /// `progress` is told how many samples are done; `cancel` ends the render once it is set.
    pub fn new(recorder: &'a Recorder<'a>, progress: &'a dyn Progress, cancel: &'a AtomicBool) -> Self {
        Self { recorder, progress, cancel }
    }

    pub(super) fn cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// Adds samples to what there is.
    pub fn add(&self, layers: &mut Layers, samples: Samples) {
        render(self.recorder, layers, samples, self.progress, self.cancel);
    }

    /// As many samples of every pixel.
    pub fn evenly(&self, layers: &mut Layers, samples: u64) {
        self.add(layers, Samples::Same(0..samples));
    }

    /// The same with a look at what there is after each pass; `look` is also told whether that is the end.
    pub fn evenly_seen<E>(
        &self,
        layers: &mut Layers,
        samples: u64,
        mut look: impl FnMut(&Layers, bool) -> Result<(), E>,
    ) -> Result<(), E> {
        for from in (0..samples).step_by(PASS as usize) {
            let to = (from + u64::from(PASS)).min(samples);
            self.add(layers, Samples::Same(from..to));
            let ends = to == samples || self.cancelled();
            look(layers, ends)?;
            if ends {
                break;
            }
        }
        Ok(())
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
            self.add(layers, Samples::Same(done..done + pass));
            done += pass;
        }
        done
    }
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
