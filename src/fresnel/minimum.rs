//! The least value of a function of one number: looked for on a grid, then narrowed by the golden section.

/// Points of the grid, and halvings (by 0.618) of the two intervals around its best one: 1e-10 of the range.
const GRID: usize = 128;
const NARROWINGS: usize = 40;

/// Where in [a, b] a function is least, if it has one dip between two points of the grid.
pub(super) fn minimum(mut f: impl FnMut(f64) -> f64, a: f64, b: f64) -> f64 {
    let at = |i: usize| a + (b - a) * i as f64 / GRID as f64;
    let values: Vec<f64> = (0..=GRID).map(|i| f(at(i))).collect();
    let best = (0..=GRID).fold(0, |best, i| if values[i] < values[best] { i } else { best });
    let (mut low, mut high) = (at(best.saturating_sub(1)), at((best + 1).min(GRID)));
    let ratio = 0.618_033_988_749_894_9;
    let (mut left, mut right) = (high - ratio * (high - low), low + ratio * (high - low));
    let (mut f_left, mut f_right) = (f(left), f(right));
    for _ in 0..NARROWINGS {
        if f_left < f_right {
            (high, right, f_right) = (right, left, f_left);
            left = high - ratio * (high - low);
            f_left = f(left);
        } else {
            (low, left, f_left) = (left, right, f_right);
            right = low + ratio * (high - low);
            f_right = f(right);
        }
    }
    let middle = 0.5 * (low + high);
    // The ends of the range are looked at, but never narrowed to.
    [middle, at(best)].into_iter().fold(middle, |best, x| if f(x) < f(best) { x } else { best })
}

#[cfg(test)]
mod tests {
    use super::minimum;

    #[test]
    fn dips_and_ends_are_found() {
        assert!((minimum(|x| (x - 0.3) * (x - 0.3), -2.0, 5.0) - 0.3).abs() < 1e-7);
        assert_eq!(minimum(|x| x, 0.0, 1.0), 0.0);
        assert_eq!(minimum(|x| -x, 0.0, 1.0), 1.0);
        // Two dips: the deeper one.
        let two = |x: f64| (x * x - 1.0) * (x * x - 1.0) + 0.1 * x;
        assert!((minimum(two, -2.0, 2.0) + 1.0).abs() < 0.02);
    }
}
