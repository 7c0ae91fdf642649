//! One random choice for all wavelengths at a smooth dielectric: reflect or refract.
//!
//! ```text
//! p = Σ wᵢ Rᵢ / Σ wᵢ        reflected lanes: Rᵢ / p        refracted lanes: (1 − Rᵢ) / (1 − p)
//! ```
//!
//! - w is the throughput of each lane. Both outcomes conserve Σ wᵢ exactly, so no lane of a path that starts with weights 1
//!   ever weighs more than N, and none needs to be dropped because directions differ.
//! - Choosing per lane instead would need N paths; choosing by one lane (the hero) lets the others grow without bound.
//! - Σ wᵢ(1 − Rᵢ) is summed as such, not taken as 1 − p, which loses its digits near total reflection.

use crate::math::Lanes;

/// Which way all lanes go, how probable that was, and what each lane's throughput is multiplied by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice<const N: usize> {
    pub reflect: bool,
    pub probability: f32,
    pub weight: Lanes<N>,
}

/// Chooses with `u` in [0, 1) for lanes of throughput `weights` ≥ 0 and reflectance `r`.
#[inline]
pub fn choose<const N: usize>(weights: &Lanes<N>, r: &Lanes<N>, u: f32) -> Choice<N> {
    let transmitted = Lanes::ONE - *r;
    let (up, down) = ((*weights * *r).sum(), (*weights * transmitted).sum());
    let total = up + down;
    if total <= 0.0 {
        return Choice { reflect: true, probability: 1.0, weight: Lanes::ZERO };
    }
    let reflect = u * total < up || down <= 0.0;
    let (part, lanes) = if reflect { (up, *r) } else { (down, transmitted) };
    let probability = part / total;
    Choice { reflect, probability, weight: lanes * (total / part) }
}

/// Take the throughput from lanes of which nothing goes on: an absorbing medium keeps a part of what total reflection would
/// return. Returns whether anything is left.
pub fn keep_refracted<const N: usize>(throughput: &mut Lanes<N>, cos_theta_t: &Lanes<N>) -> bool {
    *throughput = throughput.zip(*cos_theta_t, |weight, cos| if cos > 0.0 { weight } else { 0.0 });
    throughput.sum() > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn lanes(range: std::ops::Range<f32>) -> impl Strategy<Value = Lanes<8>> {
        proptest::array::uniform8(range).prop_map(Lanes)
    }

    proptest! {
        #[test]
        fn the_sum_of_weights_is_conserved(w in lanes(0.0..8.0), r in lanes(0.0..1.0), u in 0.0f32..1.0) {
            let choice = choose(&w, &r, u);
            let after = (w * choice.weight).sum();
            prop_assert!((after - w.sum()).abs() <= 2e-6 * w.sum());
        }

        #[test]
        fn each_lane_is_right_in_expectation(w in lanes(0.1..8.0), r in lanes(0.01..0.99)) {
            let (up, down) = (choose(&w, &r, 0.0), choose(&w, &r, 0.99999994));
            prop_assert!(up.reflect && !down.reflect);
            prop_assert!((up.probability + down.probability - 1.0).abs() < 1e-6);
            for lane in 0..8 {
                prop_assert!((up.probability * up.weight[lane] - r[lane]).abs() < 1e-6);
                prop_assert!((down.probability * down.weight[lane] - (1.0 - r[lane])).abs() < 1e-6);
            }
        }

        #[test]
        fn no_lane_outgrows_their_number(r in proptest::collection::vec((lanes(0.0..1.0), 0.0f32..1.0), 1..50)) {
            let mut w = Lanes::<8>::ONE;
            for (r, u) in r {
                w *= choose(&w, &r, u).weight;
                prop_assert!(w.max() <= 8.0001);
            }
        }
    }

    #[test]
    fn certainties_are_certain() {
        let w = Lanes::<4>::ONE;
        assert_eq!(choose(&w, &Lanes::ONE, 0.9999), Choice { reflect: true, probability: 1.0, weight: w });
        assert_eq!(choose(&w, &Lanes::ZERO, 0.0), Choice { reflect: false, probability: 1.0, weight: w });
        assert_eq!(choose(&Lanes::<4>::ZERO, &w, 0.5).weight, Lanes::ZERO);
    }
}
