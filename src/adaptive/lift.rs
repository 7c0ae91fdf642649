//! The highest percentile of errors that a given amount of light can make, wherever it lies.
//!
//! An adversary who has the light spends it on the errors that reach a value t with the least of it, and stops when as many are
//! at t as the percentile needs. The highest t that he can pay for is the bound. How much light a pixel needs for an error is read
//! from chords of its ΔE2000 at some amounts; ΔE grows less than light does, and from the first amount on the chords are within 2 % of it.

use rayon::prelude::*;

/// Amounts of light for which the ΔE of a pixel is worked out, in those that each pixel has if it lies evenly.
pub const AMOUNTS: [f64; 9] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0];

/// ΔE2000 that [`AMOUNTS`] of light make in a pixel.
pub type Rise = [f64; AMOUNTS.len()];

/// To this share of it the percentile is sought, in so many halvings at most.
const NEAR: f64 = 1e-3;
const STEPS: usize = 40;

/// An error without the light that may be missing, and which pixel has it.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    pub error: f64,
    pub pixel: usize,
}

/// Return the highest error that is reached by `needed` of those that are seen, in ascending order, if light adds as much as `rises` says
/// of each pixel and there is one unit of it for each error.
pub fn highest(seen: &[Seen], rises: &[Rise], needed: usize) -> f64 {
    let mut low = seen[seen.len() - needed].error;
    let most = seen.len() as f64 / needed as f64;
    let rise = rises.iter().map(|rise| along(&AMOUNTS, rise, most)).fold(0.0, f64::max);
    let mut high = seen[seen.len() - 1].error + rise;
    for _ in 0..STEPS {
        if high - low <= NEAR * high {
            break;
        }
        let middle = 0.5 * (low + high);
        let costs = seen.par_iter().map(|seen| cost(&rises[seen.pixel], middle - seen.error)).collect();
        if cheapest(costs, needed) <= seen.len() as f64 { low = middle } else { high = middle }
    }
    high
}

/// The sum of the `needed` smallest.
fn cheapest(mut costs: Vec<f64>, needed: usize) -> f64 {
    costs.select_nth_unstable_by(needed - 1, f64::total_cmp);
    costs[..needed].iter().sum()
}

/// The light that adds so much to a pixel's error.
fn cost(rise: &Rise, more: f64) -> f64 {
    if more > 0.0 { along(rise, &AMOUNTS, more) } else { 0.0 }
}

/// Return the value at `place` of the chords through the origin and points (x, y); the last goes on.
fn along(x: &Rise, y: &Rise, place: f64) -> f64 {
    let to = (0..AMOUNTS.len() - 1).find(|at| place <= x[*at]).unwrap_or(AMOUNTS.len() - 1);
    let (x_from, y_from) = to.checked_sub(1).map_or((0.0, 0.0), |from| (x[from], y[from]));
    y_from + (place - x_from) * (y[to] - y_from) / (x[to] - x_from)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Light does the same in all pixels: one ΔE for each amount.
    const EVEN: Rise = AMOUNTS;

    fn seen(errors: impl Iterator<Item = f64>) -> Vec<Seen> {
        let mut seen: Vec<Seen> = errors.enumerate().map(|(pixel, error)| Seen { error, pixel }).collect();
        seen.sort_by(|a, b| a.error.total_cmp(&b.error));
        seen
    }

    /// Of 100 pixels without any error, all light on the needed five lifts each by 20.
    #[test]
    fn pixels_that_are_alike_share_the_light() {
        let found = highest(&seen((0..100).map(|_| 0.0)), &[EVEN; 100], 5);
        assert!((found / 20.0 - 1.0).abs() < 1e-3, "{found}");
    }

    /// Errors 0, 1 … 99, of which five are needed and 100 units of light are there: 95 … 99 reach t if Σ (t − e) = 100 over those
    /// below t, which is 5 t − 485 = 100 for t = 117.
    #[test]
    fn the_nearest_errors_are_lifted() {
        let found = highest(&seen((0..100).map(f64::from)), &[EVEN; 100], 5);
        assert!((found / 117.0 - 1.0).abs() < 1e-3, "{found}");
    }

    /// Light goes where it does most: in five pixels it does four times as much.
    #[test]
    fn light_goes_where_it_does_most() {
        let rises: Vec<Rise> = (0..100).map(|at| if at < 5 { EVEN.map(|rise| 4.0 * rise) } else { EVEN }).collect();
        let found = highest(&seen((0..100).map(|_| 0.0)), &rises, 5);
        assert!((found / 80.0 - 1.0).abs() < 1e-3, "{found}");
    }

    /// Return what the best of all ways to spend the light on five errors gives, by trying each set of them.
    #[test]
    fn no_set_of_errors_is_lifted_further() {
        let errors: Vec<f64> = (0..12).map(|i| f64::from(i * i % 11)).collect();
        let rises: Vec<Rise> = (0..12).map(|i| AMOUNTS.map(|a| (1.0 + f64::from(i % 3)) * a.sqrt())).collect();
        let reaches = |set: u32, t: f64| {
            let of = |at: usize| cost(&rises[at], t - errors[at]);
            (0..12).filter(|at| set >> at & 1 == 1).map(of).sum::<f64>() <= 12.0
        };
        let sets = || (0..1_u32 << 12).filter(|set| set.count_ones() == 5);
        let best = (0..4000).map(|i| 0.01 * f64::from(i)).filter(|t| sets().any(|set| reaches(set, *t)));
        let (found, best) = (highest(&seen(errors.iter().copied()), &rises, 5), best.fold(0.0, f64::max));
        assert!((found - best).abs() < 0.02, "{found} {best}");
    }
}
