//! How far a render is: a bar with the time left on a terminal, a line now and then otherwise.

use super::show;
use crate::render::Progress;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

/// Where the progress of a render is shown.
pub enum Shown {
    Nothing,
    Bar(ProgressBar),
    Lines { total: u64, done: AtomicU64, started: Instant },
}

/// A plain line each time so much of the work is done.
const LINES: u128 = 10;

impl Shown {
    pub fn new(total: u64, quiet: bool) -> Self {
        if quiet {
            return Self::Nothing;
        }
        if !std::io::stderr().is_terminal() {
            return Self::Lines { total, done: AtomicU64::new(0), started: Instant::now() };
        }
        let bar = ProgressBar::new(total);
        let template = "{bar:40} {percent:>3} %  {elapsed} gone, {eta} left  {per_sec}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            let rate = |state: &indicatif::ProgressState, out: &mut dyn std::fmt::Write| {
                let _ = write!(out, "{:.2} M samples/s", state.per_sec() / 1e6);
            };
            bar.set_style(style.with_key("per_sec", rate).progress_chars("━╸─"));
        }
        Self::Bar(bar)
    }

    /// Of a render that nobody knows the length of.
    pub fn open(quiet: bool) -> Self {
        if quiet || !std::io::stderr().is_terminal() {
            return Self::Nothing;
        }
        let spinner = ProgressBar::new_spinner();
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} gone  {human_pos} samples") {
            spinner.set_style(style);
        }
        Self::Bar(spinner)
    }

    pub fn finish(&self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

impl Progress for Shown {
    fn advance(&self, samples: u64) {
        match self {
            Self::Nothing => {}
            Self::Bar(bar) => bar.inc(samples),
            Self::Lines { total, done, started } => {
                let before = done.fetch_add(samples, Ordering::Relaxed);
                let now = before + samples;
                let tenth = |samples: u64| u128::from(samples) * LINES / u128::from((*total).max(1));
                if tenth(before) != tenth(now) {
                    let seconds = started.elapsed().as_secs_f64();
                    // Rounds of a shared-out render may come to somewhat more than was asked for.
                    let left = seconds * total.saturating_sub(now) as f64 / now as f64;
                    let rate = now as f64 / seconds / 1e6;
                    show::note(format_args!(
                        "{:>3} %  {left:.0} s left  {rate:.2} M samples/s",
                        tenth(now) * 100 / LINES
                    ));
                }
            }
        }
    }
}
