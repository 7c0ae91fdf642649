//! What a model costs at a hit: the time of one evaluation for all lanes, measured here and now.
//!
//! The median of runs over a thousand angles, as rendering evaluates it: the reflectance from the indices. A figure to compare models
//! by on one machine, and for a report, not for a test; `benches/fresnel.rs` measures with more care.

use crate::fresnel::Ready;
use crate::math::{LANES, Lanes};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// How long is measured: so many runs, each at least so long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    pub runs: usize,
    pub least: Duration,
}

/// Many runs and short, so that the median is one that no other process interrupted: some 25 ms.
pub const CAREFUL: Effort = Effort { runs: 101, least: Duration::from_micros(250) };

/// For what must not take long beside a render: some 0.5 ms.
pub const BRIEF: Effort = Effort { runs: 11, least: Duration::from_micros(40) };

/// Nanoseconds of one evaluation, all lanes together.
pub fn nanoseconds(interface: &Ready<LANES>, effort: Effort) -> f64 {
    // Varied, so that what is timed is how many fit in a second, not how long one waits for another.
    let cosines: Vec<f32> = (0..1000).map(|hit| (hit as f32 * 0.618_034).fract()).collect();
    let pass = || black_box(cosines.iter().fold(Lanes::ZERO, |sum, &cos| sum + black_box(interface).reflectance(cos)));
    let run = || {
        let (start, mut evaluations) = (Instant::now(), 0);
        while start.elapsed() < effort.least {
            pass();
            evaluations += cosines.len();
        }
        start.elapsed().as_secs_f64() * 1e9 / evaluations as f64
    };
    let mut times: Vec<f64> = (0..effort.runs.max(1)).map(|_| run()).collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
