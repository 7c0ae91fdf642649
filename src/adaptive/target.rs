//! Bounds on the error of a picture: what is asked for, and what was reached.

use super::bound::Bound;
use super::noise::Noise;
use crate::film::{Unseen, View};
use std::fmt;

/// A bound on an error of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    pub measure: Measure,
    pub bound: f64,
}

/// Which error of the picture is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    MeanDe,
    De95,
    Rmse,
}

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
    /// What it is at most in a picture of this noise, in which light may be missing.
    pub fn of(self, noise: &Noise, view: &View, unseen: &Unseen) -> Bound {
        match self {
            Self::MeanDe => Bound::of_mean_de(noise, view, unseen),
            Self::De95 => Bound::of_de95(noise, view, unseen),
            Self::Rmse => Bound::of_rmse(noise, view, unseen),
        }
    }

    /// Of two halves of a picture together.
    pub fn of_both(self, [a, b]: [f64; 2]) -> f64 {
        match self {
            Self::MeanDe => 0.5 * (a + b),
            Self::De95 => a.max(b),
            Self::Rmse => (0.5 * (a * a + b * b)).sqrt(),
        }
    }
}

/// What was asked for and what was reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Reached {
    pub targets: Vec<Target>,
    pub bounds: Vec<Bound>,
    pub mean_samples: f64,
    pub met: bool,
    /// By which way light may be there that was not found, for people; empty if by none.
    pub way: String,
    /// How many pixels hold half of the error, where these are few.
    pub held: Option<usize>,
}
