//! Sums and products of f64 with an f64 of remainder: about 32 digits.
//!
//! The reference needs them in three places, where nearly equal squares are subtracted: Re(N² − n1²) at index matching,
//! its sum with n1²c² near the critical angle, and N²c² − n1²s² near Brewster's angle.
//!
//! Source: T. J. Dekker, "A floating-point technique for extending the available precision" (1971); products by `libm::fma`,
//! which is exact on every machine.

use std::ops::{Add, Mul, Sub};

/// The unevaluated sum `high + low` with |low| ≤ ½ ulp(high).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Double {
    high: f64,
    low: f64,
}

impl Double {
    /// a·b without rounding.
    pub fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: libm::fma(a, b, -high) }
    }

    pub fn square(a: f64) -> Self {
        Self::product(a, a)
    }

    /// The nearest f64.
    pub fn rounded(self) -> f64 {
        self.high + self.low
    }

    /// a + b without rounding.
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let rest = high - a;
        Self { high, low: (a - (high - rest)) + (b - rest) }
    }

    /// a + b for |a| ≥ |b|.
    fn ordered_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        Self { high, low: b - (high - a) }
    }
}

impl Add for Double {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let high = Self::sum(self.high, other.high);
        let low = Self::sum(self.low, other.low);
        let sum = Self::ordered_sum(high.high, high.low + low.high);
        Self::ordered_sum(sum.high, sum.low + low.low)
    }
}

impl Sub for Double {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + Self { high: -other.high, low: -other.low }
    }
}

impl Mul for Double {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        Self::ordered_sum(product.high, product.low + cross)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_that_nearly_cancel_keep_their_difference() {
        let epsilon = f64::EPSILON;
        let difference = Double::square(1.0 + epsilon) - Double::square(1.0 - epsilon);
        assert_eq!(difference.rounded(), 4.0 * epsilon);
    }

    #[test]
    fn products_keep_their_remainder() {
        let third = 1.0 / 3.0;
        let product = Double::product(third, 3.0) * Double::product(third, 3.0);
        let defect = 1.0 - 3.0 * third; // rounds to zero in f64
        assert_eq!(defect, 0.0);
        // 3·fl(1/3) = 1 − 2⁻⁵⁴ exactly, so the square misses 1 by 2⁻⁵³.
        let one = Double::product(1.0, 1.0);
        assert_eq!((one - product).rounded(), libm::ldexp(1.0, -53) - libm::ldexp(1.0, -108));
    }
}
