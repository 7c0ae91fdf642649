//! What independent replicates say of a number's error: the jackknife.
//!
//! With θ of all R replicates and θ₍ᵣ₎ of all but one, the bias of θ is about (R − 1)(mean θ₍ᵣ₎ − θ), if it goes as 1/R, and its
//! variance about (R − 1)/R Σ (θ₍ᵣ₎ − mean)² (M. H. Quenouille, "Notes on bias in estimation", Biometrika 43 (1956); J. W. Tukey,
//! "Bias and confidence in not-quite large samples", Annals of Mathematical Statistics 29 (1958)). The variance is never too small
//! in the mean (B. Efron & C. Stein, "The jackknife estimate of variance", Annals of Statistics 9 (1981)).
//! Intervals are those of Student's t with R − 1 degrees of freedom.

use serde::Serialize;

/// A number with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    pub value: f64,
    /// Lower and upper end of the 95 % confidence interval.
    pub interval_95: [f64; 2],
}

/// The most replicates that there are quantiles for.
pub const MOST: usize = 16;

/// Student's t at 0.975 for 1, 2, … degrees of freedom (Abramowitz & Stegun 1964, table 26.10).
const T_975: [f64; MOST - 1] =
    [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131];

impl Estimate {
    /// The jackknife's estimate from a number of all replicates and those of all but one, its bias removed.
    pub fn jackknife(all: f64, without: &[f64]) -> Self {
        let count = without.len() as f64;
        let mean = without.iter().sum::<f64>() / count;
        let (value, reach) = (all - (count - 1.0) * (mean - all), reach(without));
        Self { value, interval_95: [value - reach, value + reach] }
    }
}

/// How far a 95 % interval reaches to both sides, from a number of all replicates but one.
pub fn reach(without: &[f64]) -> f64 {
    let count = without.len() as f64;
    let mean = without.iter().sum::<f64>() / count;
    let spread: f64 = without.iter().map(|theta| (theta - mean) * (theta - mean)).sum();
    T_975[without.len().clamp(2, MOST) - 2] * ((count - 1.0) / count * spread).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a mean the jackknife gives the mean and its usual error.
    #[test]
    fn of_a_mean_it_is_the_textbooks_interval() {
        let values = [3.0, 5.0, 4.0, 8.0];
        let without = [17.0 / 3.0, 5.0, 16.0 / 3.0, 4.0];
        let estimate = Estimate::jackknife(5.0, &without);
        let variance = values.iter().map(|v| (v - 5.0) * (v - 5.0)).sum::<f64>() / 3.0;
        let half = 3.182 * (variance / 4.0).sqrt();
        assert!((estimate.value - 5.0).abs() < 1e-12);
        assert!((estimate.interval_95[0] - (5.0 - half)).abs() < 1e-12);
    }

    /// The square of a mean is too large by the mean's variance, which is removed.
    #[test]
    fn of_a_squared_mean_the_bias_is_gone() {
        let values = [1.0, 2.0, 6.0];
        let without = [16.0, 12.25, 2.25];
        let variance = values.iter().map(|v| (v - 3.0) * (v - 3.0)).sum::<f64>() / 2.0;
        let estimate = Estimate::jackknife(9.0, &without);
        assert!((estimate.value - (9.0 - variance / 3.0)).abs() < 1e-12);
    }
}
