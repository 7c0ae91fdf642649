//! Which luminance becomes display white.

use super::FilmError;
use rayon::prelude::*;

/// Exposure of the development.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Exposure {
    /// Display luminance 1 is 2^EV cd/m²; |EV| ≤ 64.
    Ev(f64),
    /// The EV found by [`auto_ev`].
    #[default]
    Auto,
}

/// Far beyond any light (2⁻⁶⁴…2⁶⁴ cd/m²) and still safe for f32 pictures.
const EV_LIMIT: f64 = 64.0;

/// Where the automatic exposure puts its percentile.
const TARGET: f64 = 0.7;

impl Exposure {
    /// The EV to develop with, for pixels of these luminances (cd/m²).
    pub fn ev(self, luminances: impl IntoParallelIterator<Item = f64>) -> Result<f64, FilmError> {
        match self {
            Exposure::Ev(ev) if ev.abs() <= EV_LIMIT => Ok(ev),
            Exposure::Ev(ev) => Err(FilmError::Exposure { ev, limit: EV_LIMIT }),
            Exposure::Auto => Ok(auto_ev(luminances)),
        }
    }
}

/// The EV that puts the 95th percentile of the lit pixels at 0.7 of display white, rounded to 0.01 so that the number
/// a report prints gives the same picture again. 0 for an image without light.
///
/// Lit are the pixels with at least 1/1000 of the 99th percentile of all positive luminances: a black or nearly black
/// studio background would otherwise make the exposure depend on how much of it the frame shows. Percentiles, not
/// maxima or means, because a few fireflies or a lamp in the frame must not darken the picture.
pub fn auto_ev(luminances: impl IntoParallelIterator<Item = f64>) -> f64 {
    let mut lit: Vec<f64> = luminances.into_par_iter().filter(|y| *y > 0.0 && y.is_finite()).collect();
    let Some(bright) = percentile(&mut lit, 0.99) else { return 0.0 };
    lit.retain(|y| *y >= bright / 1000.0);
    let Some(reference) = percentile(&mut lit, 0.95) else { return 0.0 };
    let ev = libm::log2(reference / TARGET).clamp(-EV_LIMIT, EV_LIMIT);
    libm::round(ev * 100.0) / 100.0
}

/// Nearest-rank percentile: the smallest value that a fraction `p` of the values do not exceed. Reorders them.
fn percentile(values: &mut [f64], p: f64) -> Option<f64> {
    let rank = libm::ceil(values.len() as f64 * p) as usize;
    let index = rank.clamp(1, values.len().max(1)) - 1;
    (index < values.len()).then(|| *values.select_nth_unstable_by(index, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_light_gives_zero() {
        assert_eq!(auto_ev([]), 0.0);
        assert_eq!(auto_ev([0.0, 0.0, -1.0]), 0.0);
    }

    #[test]
    fn a_grey_field_lands_at_the_target() {
        let ev = auto_ev([500.0; 64]);
        assert!((500.0 / libm::exp2(ev) - 0.7).abs() < 0.005);
    }

    #[test]
    fn dark_background_and_fireflies_change_nothing() {
        let product: Vec<f64> = (0..1000).map(|i| 50.0 + f64::from(i)).collect();
        let and = |luminance: f64, count| auto_ev([product.clone(), vec![luminance; count]].concat());
        let alone = auto_ev(product.clone());
        assert_eq!(and(0.0, 20_000), alone);
        assert!((and(1e9, 3) - alone).abs() < 0.02);
        assert!(and(0.01, 20_000) <= alone);
    }

    #[test]
    fn absurd_exposures_are_errors() {
        for ev in [65.0, -1e9, f64::NAN, f64::INFINITY] {
            assert!(Exposure::Ev(ev).ev([]).is_err());
        }
        assert_eq!(Exposure::Ev(-3.5).ev([]), Ok(-3.5));
    }
}
