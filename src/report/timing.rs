//! What one evaluation of a function costs.
//!
//! The fastest of several runs, since whatever else the machine does only ever adds to the time. A figure for a report, not
//! for a test: it belongs to the machine, and includes reading one number and adding up another.

use std::hint::black_box;
use std::time::Instant;

/// Calls of a run, and runs.
const CALLS: u32 = 4096;
const RUNS: usize = 12;

/// Nanoseconds of one call of a function of cos θ, 0…1.
pub fn ns_per_call(mut call: impl FnMut(f32) -> f32) -> f64 {
    let mut run = || {
        let started = Instant::now();
        let sum = (0..CALLS).fold(0.0, |sum, i| sum + call(black_box((i as f32 + 0.5) / CALLS as f32)));
        black_box(sum);
        started.elapsed().as_secs_f64()
    };
    let fastest = (0..RUNS).map(|_| run()).fold(f64::INFINITY, f64::min);
    fastest * 1e9 / f64::from(CALLS)
}
