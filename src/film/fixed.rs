//! f32 to fixed point by shifting the mantissa: what makes film sums exact.
//!
//! Integers add in any order to the same bits; floating-point numbers don't. A sample x (cd/m²) becomes
//!
//! - for the sum, an i128 in units of 2⁻⁶⁴ cd/m²: exact for |x| ≥ 2⁻⁴¹ (5e-13), below that cut to a multiple of 2⁻⁶⁴
//!   (5e-20) towards zero;
//! - for the sum of squares, a u128 in units of 2⁻⁴⁰ (cd/m²)²: exact for |x| ≥ 2³ and below that cut to a multiple of
//!   2⁻⁴⁰ (9e-13): relative 9e-7 of the square at 10⁻³ cd/m². It only serves variances.
//!
//! The cut belongs to one sample, so it does not depend on order either.
//!
//! Range: |x| < 2⁴³ = 8.8e12 cd/m² (the sun's disc has 1.6e9); Σx² < 2⁸⁸. The sum needs no check of its own:
//! with n < 2³² samples |Σx| ≤ √(n Σx²) < 2⁶⁰, far below the 2⁶³ an i128 holds. So the sum of squares alone tells of
//! overflow: it saturates at u128::MAX and stays there. Saturating sums of non-negative numbers do not depend on order,
//! a flag set by a signed sum on its way would.
//!
//! What it costs is written at [`Pixel`](super::Pixel).

/// Sums count units of 2⁻⁶⁴ cd/m².
pub const SUM_FRACTION_BITS: u32 = 64;
/// Sums of squares count units of 2⁻⁴⁰ (cd/m²)².
pub const SQUARE_FRACTION_BITS: u32 = 40;
/// Magnitudes from here on (2⁴³ cd/m²) are out of range.
pub const LIMIT: f32 = 8_796_093_022_208.0;

// Exponent field of the largest magnitudes in range, [2⁴², 2⁴³).
const TOP: u32 = 127 + 42;

/// `x` in units of 2⁻⁶⁴, cut towards zero; ±2⁴³ for magnitudes out of range. Non-finite numbers must not come here.
#[inline]
pub fn sum_units(x: f32) -> i128 {
    let (mantissa, exponent) = parts(x);
    // x = mantissa · 2^(exponent − 150); at the top exponent that is mantissa · 2^(169 − 150 + 64) units. One shift to
    // there and one back serve all exponents without a branch; 127 clears every bit of what is too small.
    let units = match TOP.checked_sub(exponent) {
        Some(down) => (u128::from(mantissa) << (TOP - 150 + SUM_FRACTION_BITS)) >> down.min(127),
        None => 1 << (43 + SUM_FRACTION_BITS),
    } as i128;
    if x.is_sign_negative() { -units } else { units }
}

/// `x`² in units of 2⁻⁴⁰, cut towards zero; u128::MAX for magnitudes out of range. Non-finite numbers must not come here.
#[inline]
pub fn square_units(x: f32) -> u128 {
    let (mantissa, exponent) = parts(x);
    let square = u128::from(u64::from(mantissa) * u64::from(mantissa));
    match TOP.checked_sub(exponent) {
        Some(down) => (square << (2 * TOP - 300 + SQUARE_FRACTION_BITS)) >> (2 * down).min(127),
        None => u128::MAX,
    }
}

/// Units of 2⁻⁶⁴ as a number, rounded once.
pub fn sum_to_f64(units: i128) -> f64 {
    units as f64 * (1.0 / 18_446_744_073_709_551_616.0)
}

/// Units of 2⁻⁴⁰ as a number, rounded once.
pub fn square_to_f64(units: u128) -> f64 {
    units as f64 * (1.0 / 1_099_511_627_776.0)
}

/// |x| = mantissa · 2^(exponent − 150); subnormal numbers have the exponent of the smallest normal ones and no hidden bit.
#[inline]
fn parts(x: f32) -> (u32, u32) {
    let bits = x.to_bits();
    let field = (bits >> 23) & 0xff;
    let hidden = u32::from(field != 0) << 23;
    ((bits & 0x7f_ffff) | hidden, field.max(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The same by f64 arithmetic, which is exact here: f32 · 2^k and f32² fit f64, and the cast cuts towards zero.
    fn reference(x: f32) -> (i128, u128) {
        let x = f64::from(x);
        ((x * 18_446_744_073_709_551_616.0) as i128, (x * x * 1_099_511_627_776.0) as u128)
    }

    #[test]
    fn shifts_agree_with_arithmetic() {
        let below_limit = f32::from_bits(LIMIT.to_bits() - 1);
        for x in [0.0, -0.0, 1.0, -1.0, 0.1, 1e-30, f32::MIN_POSITIVE, 1e-45, 1e-12, 3.5e-8, 1.6e9, below_limit] {
            assert_eq!((sum_units(x), square_units(x)), reference(x), "{x}");
            assert_eq!(sum_units(-x), -sum_units(x));
        }
        assert_eq!(sum_units(1.0), 1 << 64);
        assert_eq!(square_units(1.0), 1 << 40);
    }

    #[test]
    fn huge_values_saturate() {
        for x in [LIMIT, 1e20, f32::MAX] {
            assert_eq!(sum_units(x), 1 << 107);
            assert_eq!(sum_units(-x), -(1 << 107));
            assert_eq!(square_units(x), u128::MAX);
        }
    }

    proptest! {
        #[test]
        fn all_exponents_agree_with_arithmetic(bits: u32) {
            let x = f32::from_bits(bits);
            prop_assume!(x.abs() < LIMIT);
            prop_assert_eq!((sum_units(x), square_units(x)), reference(x));
        }
    }
}
