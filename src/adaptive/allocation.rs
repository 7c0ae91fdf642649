//! Which pixel gets how many samples, so that a picture's error falls fastest.
//!
//! A pixel's error is taken as σₚ/nₚ^q. Then the mean of errors is least for nₚ ∝ σₚ^(1/(1+q)), their mean square for nₚ ∝ σₚ^(2/(1+2q))
//! (Lagrange). Points of a net err less than independent ones (q = ½), the more so where most of a mean square comes from, at the edges and
//! in the highlights of what is bright: q = ¾ for the mean, 1 for the mean square. (MSE with ¾ against 1, 64 samples: metals 1.01, a ring
//! 0.87, a diamond 1.12; relative to a pixel's brightness 1.08, 1.10 and 1.23.)
//!
//! A pixel whose own first samples decided how many it gets would be biased: where they happen to be alike, it gets few, and what is rare in
//! it is missed for good. Here σₚ is that of the pixels around it that lie in the other half of the picture, the other fields of a
//! chessboard ([`half`]), and of the first samples alone ([`super::pilot`]). Halves draw independent numbers
//! (`render::Recorder::in_halves`; replicates do anyway), and each is shared out by itself, so that the number of a pixel's samples depends
//! on nothing that its half has drawn: its mean is what it is without any plan (`tests/it/cli/target_error.rs`). Only the exposure by which ΔE is
//! seen may be that of the whole picture, and where time is the limit, how many samples there are in all.
//! When to go on is decided for either half by the other one, for the same reason ([`super::promise`]).

use super::noise::{Noise, half};
use std::ops::Range;

/// Pixels around one that speak for it: those of the other half among 5 × 5. They are the four beside it, and eight a knight's move away.
const REACH: usize = 2;

/// What a knight's move counts: an edge is one pixel wide. (MSE if it counts in full: metals, a ring and a diamond 1.00 to 1.15 ×.)
const FAR: f64 = 0.1;

/// No pixel gets less than this share of the mean number, so that what its surroundings do not show is found too.
pub const LEAST: f64 = 0.25;

/// Nor more than this many times of it.
const MOST: f64 = 16.0;

/// What is to fall fastest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// The mean ΔE2000 over the picture.
    MeanDe,
    /// The root mean square error of linear sRGB.
    Rmse,
}

impl Aim {
    pub const ALL: [Self; 2] = [Self::MeanDe, Self::Rmse];

    /// As a command line has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::MeanDe => "dE",
            Self::Rmse => "rmse",
        }
    }

    fn errors(self, noise: &Noise) -> Vec<f64> {
        match self {
            Self::MeanDe => noise.de.iter().copied().map(f64::from).collect(),
            Self::Rmse => noise.squares.iter().map(|square| f64::from(*square).sqrt()).collect(),
        }
    }

    fn power(self) -> f64 {
        match self {
            Self::MeanDe => 4.0 / 7.0,
            Self::Rmse => 2.0 / 3.0,
        }
    }
}

/// How samples are shared: 1 is the mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Shares(Vec<f64>);

impl Shares {
    /// By the noise of each pixel by itself after equally many samples, in rows of `width`; none gets less than `least`, up to 1.
    pub fn new(noise: &Noise, width: usize, aim: Aim, least: f64) -> Self {
        let errors = aim.errors(noise);
        let mut shares = vec![1.0; errors.len()];
        for which in 0..2 {
            let places: Vec<usize> = (0..errors.len()).filter(|at| half(*at, width) == which).collect();
            let wishes = places.iter().map(|at| libm::pow(around(&errors, width, *at), aim.power())).collect();
            places.iter().zip(bounded(wishes, least)).for_each(|(at, share)| shares[*at] = share);
        }
        Self(shares)
    }

    /// The largest of them.
    pub fn largest(&self) -> f64 {
        self.0.iter().copied().fold(1.0, f64::max)
    }

    /// Samples of each pixel from those that it has to its share of that mean, in whole steps; never fewer than it has.
    pub fn ranges(&self, has: impl Iterator<Item = u64>, mean: f64, step: u64) -> Vec<Range<u64>> {
        let wanted = |share: &f64| libm::round(share * mean / step as f64) as u64 * step;
        self.0.iter().zip(has).map(|(share, has)| has..wanted(share).max(has)).collect()
    }
}

/// Shares of the mean 1 in the proportions of wishes, but for those that get as little or as much as may be.
fn bounded(wishes: Vec<f64>, least: f64) -> Vec<f64> {
    let mean = mean(wishes.iter().copied());
    if !(mean > 0.0 && mean.is_finite()) {
        return vec![1.0; wishes.len()];
    }
    // Where only few wish for anything, the others get what is left.
    let share = |factor: f64| move |wish: &f64| (factor * wish.max(1e-6 * mean)).clamp(least, MOST);
    let (mut low, mut high) = (0.0, 1.0 / mean);
    while self::mean(wishes.iter().map(share(high))) < 1.0 {
        high *= 2.0;
    }
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        let few = self::mean(wishes.iter().map(share(middle))) < 1.0;
        if few { low = middle } else { high = middle }
    }
    wishes.iter().map(share(high)).collect()
}

/// Weighted root mean square of the pixels around one that are of the other half; those that know nothing of their error do not count.
fn around(errors: &[f64], width: usize, at: usize) -> f64 {
    let (x, y, height) = (at % width, at / width, errors.len() / width);
    let (mut sum, mut count) = (0.0, 0.0);
    for j in y.saturating_sub(REACH)..=(y + REACH).min(height - 1) {
        let row = j * width + x.saturating_sub(REACH)..=j * width + (x + REACH).min(width - 1);
        for other in row.filter(|other| half(*other, width) != half(at, width) && errors[*other].is_finite()) {
            let weight = if (other % width).abs_diff(x) + j.abs_diff(y) == 1 { 1.0 } else { FAR };
            sum += weight * errors[other] * errors[other];
            count += weight;
        }
    }
    if count > 0.0 { (sum / count).sqrt() } else { 0.0 }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len().max(1) as f64;
    values.sum::<f64>() / count
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Errors of either kind as given.
    fn noise(errors: &[f32]) -> Noise {
        Noise {
            de: errors.to_vec(),
            squares: errors.iter().map(|error| error * error).collect(),
            colors: vec![[0.0; 3]; errors.len()],
            sharing: 1.0,
        }
    }

    #[test]
    fn noisy_places_get_more_and_a_pixel_does_not_speak_for_its_half() {
        let mut errors = vec![1.0; 11 * 11];
        errors[5 * 11 + 5] = 1000.0;
        let shares = Shares::new(&noise(&errors), 11, Aim::MeanDe, LEAST).0;
        let own = |at: &usize| half(*at, 11) == half(5 * 11 + 5, 11);
        assert!((0..121).filter(own).all(|at| (shares[at] - 1.0).abs() < 1e-12), "{shares:?}");
        assert!(shares[5 * 11 + 6] > 4.0 * shares[1], "{shares:?}");
        assert!((mean(shares.iter().copied()) - 1.0).abs() < 1e-12);
        // Whatever was found in its half, the shares of a half are the same.
        let of_half = |own: f32| {
            let mut errors: Vec<f32> = (0..121).map(|i| 1.0 + 0.01 * i as f32).collect();
            errors[5 * 11 + 5] = own;
            let shares = Shares::new(&noise(&errors), 11, Aim::Rmse, LEAST).0;
            (0..121).filter(|at| half(*at, 11) == 0).map(|at| shares[at]).collect::<Vec<_>>()
        };
        assert_eq!(of_half(0.001), of_half(1000.0));
        // One that nobody knows anything of is as if it were not there.
        assert!(of_half(1.0).iter().any(|share| *share != 1.0));
        assert_eq!(of_half(f32::INFINITY), of_half(1.0));
    }

    #[test]
    fn shares_keep_their_mean_and_their_bounds_whatever_is_wished() {
        let (wide, one_of_many) = (vec![1e-30, 1.0, 1e30, 2.0], (0..100).map(|i| f64::from(i / 99)).collect());
        for wishes in [wide, vec![0.0, 0.0, 0.0, 1.0], one_of_many, (1..100).map(f64::from).collect()] {
            let shares = bounded(wishes.clone(), LEAST);
            assert!((mean(shares.iter().copied()) - 1.0).abs() < 1e-12, "{shares:?}");
            assert!(shares.iter().all(|share| (LEAST..=MOST).contains(share)), "{shares:?}");
            let ascends = |i: &usize| wishes[*i] > wishes[*i - 1] || shares[*i] <= shares[*i - 1];
            assert!((1..wishes.len()).all(|i| ascends(&i)), "{shares:?}");
        }
    }

    #[test]
    fn ranges_go_on_where_they_ended() {
        let shares = Shares(vec![0.5, 1.5]);
        assert_eq!(shares.ranges([16, 16].into_iter(), 32.0, 8), vec![16..16, 16..48]);
        assert_eq!(shares.ranges([16, 48].into_iter(), 64.0, 8), vec![16..32, 48..96]);
    }

    #[test]
    fn a_picture_without_noise_is_shared_evenly() {
        assert_eq!(Shares::new(&noise(&[0.0; 9]), 3, Aim::Rmse, LEAST), Shares(vec![1.0; 9]));
    }
}
