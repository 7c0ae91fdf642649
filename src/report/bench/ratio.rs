//! How much longer one thing takes than another, from pairs of times: the median of their ratios, and how sure it is.
//!
//! What else a machine does falls on some of the times and only adds to them, so a mean would be anybody's. The interval needs no
//! distribution: the number of ratios below their median is that of heads in as many tosses of a coin (W. R. Thompson, "On confidence
//! ranges for the median", Annals of Mathematical Statistics 7 (1936)). Pairs of more than one kind are taken to have one ratio.

use serde::Serialize;

/// A ratio with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Ratio {
    pub value: f64,
    /// Lower and upper end of the interval of at least 95 % confidence; of fewer than six pairs all that there is.
    pub interval_95: [f64; 2],
}

impl Ratio {
    /// Of pairs (time, time of the one it is compared with) above 0; `None` without any.
    pub fn of(pairs: impl Iterator<Item = (f64, f64)>) -> Option<Self> {
        let mut ratios: Vec<f64> = pairs.filter(|pair| pair.1 > 0.0).map(|(time, base)| time / base).collect();
        ratios.sort_unstable_by(f64::total_cmp);
        let (last, cut) = (ratios.len().checked_sub(1)?, outside(ratios.len()));
        Some(Self { value: median(&ratios), interval_95: [ratios[cut], ratios[last - cut]] })
    }

    /// Whether it could be 1.
    pub fn is_even(&self) -> bool {
        (self.interval_95[0]..=self.interval_95[1]).contains(&1.0)
    }
}

/// The middle of sorted values, or the mean of the two there; 0 of none.
pub fn median(sorted: &[f64]) -> f64 {
    match sorted {
        [] => 0.0,
        _ => 0.5 * (sorted[(sorted.len() - 1) / 2] + sorted[sorted.len() / 2]),
    }
}

/// How many of `count` sorted values may be cut off at each end, so that the rest holds the median with 95 % confidence.
fn outside(count: usize) -> usize {
    let mut below = 0.0;
    let mut chance = libm::exp2(-(count as f64));
    for cut in 0..count / 2 {
        below += chance;
        if below > 0.025 {
            return cut.saturating_sub(1);
        }
        chance *= (count - cut) as f64 / (cut + 1) as f64;
    }
    0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tables of the sign test (W. J. MacKinnon, Journal of the American Statistical Association 59 (1964)): from the 1st value of 6, the
    /// 2nd of 9, the 3rd of 12, the 6th of 20.
    #[test]
    fn intervals_are_those_of_the_tables() {
        assert_eq!([6, 9, 12, 20].map(outside), [0, 1, 2, 5]);
        assert_eq!([0, 1, 2, 5].map(outside), [0; 4]);
    }

    #[test]
    fn one_slow_render_changes_nothing() {
        let pairs = |slow: f64| (0..9).map(move |i| (2.0 + 0.01 * f64::from(i) + if i == 8 { slow } else { 0.0 }, 2.0));
        let [calm, disturbed] = [0.0, 50.0].map(|slow| Ratio::of(pairs(slow)).expect("pairs"));
        assert_eq!(calm, disturbed);
        assert!((calm.value - 1.02).abs() < 1e-12 && !calm.is_even());
        assert_eq!(Ratio::of(std::iter::empty()), None);
        assert_eq!(median(&[1.0, 2.0, 4.0, 9.0]), 3.0);
    }
}
