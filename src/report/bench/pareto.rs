//! Which of several costs and errors nothing beats: V. Pareto's front.

/// Whether each (cost, error) has no other one that is no worse in both and better in one.
pub fn front(points: &[[f64; 2]]) -> Vec<bool> {
    let beaten =
        |[cost, error]: [f64; 2]| points.iter().any(|p| p[0] <= cost && p[1] <= error && (p[0] < cost || p[1] < error));
    points.iter().map(|&point| !beaten(point)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_worse_in_both_is_off() {
        let points = [[1.0, 8.0], [2.0, 4.0], [2.0, 5.0], [3.0, 4.0], [4.0, 1.0], [4.0, 1.0], [0.5, 9.0]];
        assert_eq!(front(&points), [true, true, false, false, true, true, true]);
        assert_eq!(front(&[]), Vec::<bool>::new());
    }
}
