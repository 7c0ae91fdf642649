//! A smooth spectrum of a texel, ready for the lanes of a path: a factor times the sigmoid of [`Sigmoid`](super::Sigmoid).
//!
//! ```text
//! tint(t) = scale · (1/2 + x/(2 √(1 + x²))),  x = (c0 t + c1) t + c2,  t = 0…1 over 360–830 nm
//! ```
//!
//! In single precision the sum loses the digits of dark colours, so what is small is computed without a difference:
//! with r = √(1 + x²) the smaller of the sigmoid and its complement is 1/(2 r (r + |x|)). One square root and one division.

use crate::math::Lanes;

/// Four numbers a texel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tint {
    /// c0, c1, c2.
    pub coefficients: [f32; 3],
    /// 0 is black, whatever the coefficients are.
    pub scale: f32,
}

impl Tint {
    pub const BLACK: Self = Self { coefficients: [0.0; 3], scale: 0.0 };

    /// Its values where the lanes stand in the visible range, 0…1 each.
    #[inline]
    pub fn at<const N: usize>(&self, positions: Lanes<N>) -> Lanes<N> {
        let [c0, c1, c2] = self.coefficients;
        positions.map(|t| {
            let x = (c0 * t + c1) * t + c2;
            let root = (1.0 + x * x).sqrt();
            let small = 0.5 / (root * (root + x.abs()));
            self.scale * if x < 0.0 { small } else { 1.0 - small }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::Sigmoid;
    use super::*;

    #[test]
    fn it_is_the_sigmoid_in_single_precision_even_where_it_is_dark() {
        for c in [[0.0, 0.0, 0.0], [3.0, -2.0, 0.4], [-40.0, 35.0, -9.0], [0.0, 0.0, -90.0], [0.0, 0.0, 90.0]] {
            let tint = Tint { coefficients: c.map(|value| value as f32), scale: 2.0 };
            for t in [0.0f32, 0.25, 0.5, 1.0] {
                let exact = 2.0 * Sigmoid(c).at(360.0 + 470.0 * f64::from(t));
                let single = f64::from(tint.at(Lanes([t]))[0]);
                assert!((single / exact - 1.0).abs() < 2e-6 && single > 0.0, "{c:?} at {t}: {single} against {exact}");
            }
        }
        assert_eq!(Tint { scale: 0.5, ..Tint::BLACK }.at(Lanes([0.1, 0.9])), Lanes([0.25; 2]), "grey is exact");
        assert_eq!(Tint::BLACK.at(Lanes([0.3])), Lanes([0.0]));
    }
}
