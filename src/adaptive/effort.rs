//! How long a render goes on, and where: for so many samples, for so long, or until its error is small enough.

use super::allocation::Aim;
use super::promise::{Goal, Look};
use super::render_loop::RenderLoop;
use super::sharing::{Halves, SharedLoop};
use super::target::{Reached, Target};
use crate::film::{Develop, FilmError, Layers};
use crate::render::{Progress, Recorder};
use crate::scene::Chance;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Samples a pixel that nothing is gained beyond: where single precision and the sampler's table end to gain.
pub const LIMIT: u64 = 1 << 16;

/// Fewer samples a pixel are not shared out: a quarter of them would tell too little of the noise.
pub const LEAST_SHARED: u32 = 16;

/// How long a render is to go on.
#[derive(Clone, Debug, PartialEq)]
pub enum Effort {
    /// For so many samples a pixel, in the mean if they are shared out.
    Samples { samples: u64, aim: Option<Aim> },
    /// Until the time is over, so many samples at most.
    Time { time: Duration, most: u64, aim: Option<Aim> },
    /// Until the targets are met, so many samples a pixel and so long at most.
    Error { targets: Vec<Target>, time: Option<Duration>, most: u64 },
}

/// What a render asks and tells while it goes on.
#[derive(Clone, Copy)]
pub struct Session<'a> {
    /// How the picture is looked at.
    pub develop: &'a Develop,
    /// Light that the render may not find.
    pub chance: &'a Chance,
    /// Told how many samples are done.
    pub progress: &'a dyn Progress,
    /// Told how large the error still is, each time it is looked at.
    pub look: &'a dyn Fn(&Look),
    /// Ends the render once it is set.
    pub cancel: &'a AtomicBool,
}

impl Effort {
    /// Samples a pixel that progress is shown against, if they are known.
    pub fn samples(&self) -> Option<u64> {
        match self {
            Self::Samples { samples, .. } => Some(*samples),
            _ => None,
        }
    }

    /// Renders into empty layers, and says what was reached if the error decides.
    pub fn render(
        &self,
        recorder: Recorder,
        layers: &mut Layers,
        session: &Session,
    ) -> Result<Option<Reached>, FilmError> {
        let Session { develop, chance, progress, look, cancel } = *session;
        match *self {
            Self::Samples { samples, aim: None } => {
                RenderLoop::new(&recorder, progress, cancel).evenly(layers, samples)
            }
            Self::Samples { samples, aim: Some(aim) } => {
                SharedLoop::new(&Halves::of(recorder), progress, cancel).shared(layers, samples, aim, develop)?;
            }
            Self::Time { time, most, aim: None } => {
                RenderLoop::new(&recorder, progress, cancel).evenly_for(layers, 0, time, most);
            }
            Self::Time { time, most, aim: Some(aim) } => {
                let halves = Halves::of(recorder);
                SharedLoop::new(&halves, progress, cancel).shared_for(layers, (time, most), aim, develop)?;
            }
            Self::Error { ref targets, time, most } => {
                let goal = Goal { targets, time, most, chance };
                let render = RenderLoop::new(&recorder, progress, cancel);
                return render.for_error(layers, &goal, develop, look).map(Some);
            }
        }
        Ok(None)
    }
}
