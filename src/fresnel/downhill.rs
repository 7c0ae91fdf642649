//! The bottom of the valley of a function of one number: walked to in steps, then narrowed by the golden section.

/// Halvings (by 0.618) of two steps: 1e-9 of them.
const NARROWINGS: usize = 44;

const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Where a function is least downhill from `start`, within [low, high].
pub(super) fn downhill(mut f: impl FnMut(f64) -> f64, start: f64, step: f64, [low, high]: [f64; 2]) -> f64 {
    let (mut here, mut value) = (start, f(start));
    let forward = f((start + step).min(high));
    let step = if forward < value { step } else { -step };
    loop {
        let next = (here + step).clamp(low, high);
        let ahead = f(next);
        if next == here || ahead >= value {
            break;
        }
        (here, value) = (next, ahead);
    }
    golden(f, (here - step.abs()).max(low), (here + step.abs()).min(high))
}

fn golden(mut f: impl FnMut(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut left, mut right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut f_left, mut f_right) = (f(left), f(right));
    for _ in 0..NARROWINGS {
        if f_left < f_right {
            (high, right, f_right) = (right, left, f_left);
            left = high - GOLDEN * (high - low);
            f_left = f(left);
        } else {
            (low, left, f_left) = (left, right, f_right);
            right = low + GOLDEN * (high - low);
            f_right = f(right);
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::downhill;

    #[test]
    fn valleys_and_ends_are_found() {
        let within = [-3.0, 5.0];
        for start in [-2.9, 0.2, 0.31, 4.0] {
            assert!((downhill(|x| (x - 0.3) * (x - 0.3), start, 0.25, within) - 0.3).abs() < 1e-7);
        }
        assert!((downhill(|x| x, 1.0, 0.25, within) + 3.0).abs() < 1e-7);
        assert!((downhill(|x| -x, 1.0, 0.25, within) - 5.0).abs() < 1e-7);
    }

    #[test]
    fn of_two_valleys_it_is_the_one_that_it_stands_above() {
        let two = |x: f64| (x * x - 1.0) * (x * x - 1.0) + 0.1 * x;
        assert!((downhill(two, 2.0, 0.1, [-3.0, 3.0]) - 0.987).abs() < 2e-3);
        assert!((downhill(two, -0.5, 0.1, [-3.0, 3.0]) + 1.012).abs() < 2e-3);
    }
}
