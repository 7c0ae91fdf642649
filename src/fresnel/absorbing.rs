//! Exact Fresnel reflectance of the boundary of two media that may both absorb, in f32, unpolarised.
//!
//! ```text
//! N = n + i k    C = N1 c    S = N1²s²    d = N2² − N1²    w = N2 cos θ_t = √(d + C²)
//! r_s = −d/(C + w)²    r_p = −r_s (C w − S)/(C w + S)    R = |r_s|² (1 + |C w − S|²/|C w + S|²)/2
//! ```
//!
//! - Source: Born & Wolf, *Principles of Optics* (7th ed., 1999), 14.2, with a complex index on both sides: a plane wave whose amplitude falls
//!   along its own direction. What is not reflected goes on by the real indices, and is lost where these reflect totally: there the
//!   field beyond is one that decays along the boundary.
//! - Needed where k > [`LEAST_K`]: below, R moves by less than 1e-6 away from critical angles, and `dielectric` is enough.
//! - Of the two roots w the larger part is positive: a wave that goes on goes away from the boundary, one that does not go on decays. At
//!   the critical angle of an absorbing medium neither is right, for plane waves do not describe it; R is kept to at most 1 there.
//! - Limits: inside of a medium with k of about n, waves are not like that; but such a medium lets nothing through that could come back.
//! - Error against f64 by the textbook's form, and against `exact` where the first medium is clear: 2e-6 (tests below).
//! - Approximations act on light from the clear side, as on metals; from the absorbing side, of which they know nothing, this is used.

use super::{Dielectric, RgbFresnel, SpectralModel, dielectric};
use crate::math::Lanes;

/// Interfaces of media that absorb less do as if they were clear.
pub const LEAST_K: f64 = 1e-3;

/// The boundary of media of which at least one absorbs: what `dielectric` does not know of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Absorbing<const N: usize> {
    /// Of the medium that light comes from.
    pub k1: Lanes<N>,
    pub k2: Lanes<N>,
    pub by: By<N>,
}

/// What says how much is reflected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum By<const N: usize> {
    /// Fresnel's equations, with k on both sides.
    Exact,
    /// A model of metals, from the clear side.
    Spectral(SpectralModel),
    Rgb(RgbFresnel<N>),
}

impl<const N: usize> Absorbing<N> {
    /// Return how much is reflected, and the cosine of what goes on (0 where nothing does, though not all is reflected).
    pub fn at(&self, n1: &Lanes<N>, n2: &Lanes<N>, cos_theta_i: &Lanes<N>) -> Dielectric<N> {
        let r = Lanes::from_fn(|lane| match &self.by {
            By::Exact => reflectance([n1, &self.k1, n2, &self.k2].map(|index| index[lane]), cos_theta_i[lane]),
            By::Spectral(model) => {
                let [n1, n2, k2] = [n1, n2, &self.k2].map(|index| Lanes([index[lane]]));
                model.at(&n1, &n2, &k2).reflectance(cos_theta_i[lane])[0].clamp(0.0, 1.0)
            }
            By::Rgb(rgb) => rgb.reflectance(cos_theta_i[lane])[lane].min(1.0),
        });
        Dielectric { r, cos_theta_t: dielectric::cos_theta_t(n1, n2, cos_theta_i) }
    }

    /// The same for one lane alone.
    pub fn lane(&self, lane: usize) -> Absorbing<1> {
        let by = match self.by {
            By::Exact => By::Exact,
            By::Spectral(model) => By::Spectral(model),
            By::Rgb(rgb) => By::Rgb(rgb.lane(lane)),
        };
        Absorbing { k1: Lanes([self.k1[lane]]), k2: Lanes([self.k2[lane]]), by }
    }
}

#[derive(Clone, Copy)]
struct Complex {
    re: f32,
    im: f32,
}

impl Complex {
    fn plus(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }

    fn times(self, other: Self) -> Self {
        let Self { re, im } = other;
        Self { re: self.re * re - self.im * im, im: self.re * im + self.im * re }
    }

    fn scaled(self, by: f32) -> Self {
        Self { re: self.re * by, im: self.im * by }
    }

    fn norm_squared(self) -> f32 {
        self.re * self.re + self.im * self.im
    }

    /// The root whose larger part is positive: that from the modulus, the other from the product of both.
    fn root(self) -> Self {
        let larger = (0.5 * (self.norm_squared().sqrt() + self.re.abs())).sqrt();
        let smaller = 0.5 * self.im / (larger + f32::MIN_POSITIVE);
        let [re, im] = if self.re >= 0.0 { [larger, smaller] } else { [smaller, larger] };
        Self { re, im }
    }
}

/// Unpolarised reflectance of indices n1, k1, n2 and k2.
fn reflectance([n1, k1, n2, k2]: [f32; 4], cos: f32) -> f32 {
    let first = Complex { re: n1, im: k1 };
    // Differences of squares by their factors: media that are nearly alike reflect nearly nothing.
    let d = Complex { re: (n2 - n1) * (n2 + n1) - (k2 - k1) * (k2 + k1), im: 2.0 * ((n2 - n1) * k2 + n1 * (k2 - k1)) };
    let normal = first.scaled(cos);
    let tangential = first.times(first).scaled((1.0 - cos) * (1.0 + cos));
    let beyond = d.plus(normal.times(normal)).root();
    let product = normal.times(beyond);
    let sum = normal.plus(beyond).norm_squared();
    let (less, more) = (product.plus(tangential.scaled(-1.0)), product.plus(tangential));
    let rs = d.norm_squared() / (sum * sum + f32::MIN_POSITIVE);
    let ratio = less.norm_squared() / (more.norm_squared() + f32::MIN_POSITIVE);
    (0.5 * rs * (1.0 + ratio)).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::exact;

    /// Complex numbers as pairs, and the equations as textbooks write them.
    fn textbook([n1, k1, n2, k2]: [f64; 4], cos: f64) -> f64 {
        type C = (f64, f64);
        let mul = |a: C, b: C| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
        let sub = |a: C, b: C| (a.0 - b.0, a.1 - b.1);
        let add = |a: C, b: C| (a.0 + b.0, a.1 + b.1);
        let norm = |a: C| a.0 * a.0 + a.1 * a.1;
        let div = |a: C, b: C| {
            let (re, im) = mul(a, (b.0, -b.1));
            (re / norm(b), im / norm(b))
        };
        let root = |a: C| {
            let (modulus, half) = (norm(a).sqrt().sqrt(), 0.5 * libm::atan2(a.1, a.0));
            (modulus * libm::cos(half), modulus * libm::sin(half))
        };
        let (first, second) = ((n1, k1), (n2, k2));
        let sin = div(mul(first, ((1.0 - cos * cos).sqrt(), 0.0)), second);
        let cos_t = root(sub((1.0, 0.0), mul(sin, sin)));
        let beyond = mul(second, cos_t);
        // Away from the boundary, or decaying.
        let against = if beyond.0.abs() > beyond.1.abs() { beyond.0 < 0.0 } else { beyond.1 < 0.0 };
        let cos_t = if against { (-cos_t.0, -cos_t.1) } else { cos_t };
        let part = |a: C, b: C| norm(div(sub(a, b), add(a, b)));
        let c = (cos, 0.0);
        0.5 * (part(mul(first, c), mul(second, cos_t)) + part(mul(second, c), mul(first, cos_t)))
    }

    const INDICES: [[f64; 2]; 7] =
        [[1.0, 0.0], [1.5, 0.002], [1.5, 0.05], [1.5, 0.5], [1.5, 3.0], [0.2, 3.4], [2.4, 0.01]];

    #[test]
    fn both_media_may_absorb() {
        let mut worst: f64 = 0.0;
        for a in INDICES {
            for b in INDICES.into_iter().filter(|b| *b != a) {
                for step in 1..=100 {
                    let cos = f64::from(step as f32 * 0.01);
                    let indices = [a[0], a[1], b[0], b[1]];
                    let right = textbook(indices.map(|x| f64::from(x as f32)), cos).min(1.0);
                    let found = f64::from(reflectance(indices.map(|x| x as f32), cos as f32));
                    worst = worst.max((found - right).abs());
                }
            }
        }
        assert!(worst < 2e-6, "{worst}");
    }

    /// (1.5, 3), (1.5, 2) and (1.5, 0.5) head on are fractions: 9.25/15.25, 4.25/10.25 and 0.5/6.5.
    #[test]
    fn from_a_clear_medium_it_is_the_exact_one() {
        for (k, right) in [(3.0, 9.25 / 15.25), (2.0, 4.25 / 10.25), (0.5, 0.5 / 6.5)] {
            assert!((reflectance([1.0, 0.0, 1.5, k], 1.0) - right).abs() < 1e-6, "{k}");
            for step in 0..=50 {
                let cos = step as f32 * 0.02;
                let exact = exact::reflect(1.0, 1.5, f64::from(k), f64::from(cos)).r;
                assert!((f64::from(reflectance([1.0, 0.0, 1.5, k], cos)) - exact).abs() < 2e-6, "{k} {cos}");
            }
        }
    }

    #[test]
    fn the_same_medium_reflects_nothing() {
        for cos in [0.0, 0.3, 1.0] {
            assert_eq!(reflectance([1.5, 0.2, 1.5, 0.2], cos), 0.0);
        }
    }

    /// What [`LEAST_K`] says: from outside, and from inside up to five degrees before the critical angle.
    #[test]
    fn less_absorption_does_nothing_to_reflection() {
        let k = LEAST_K as f32;
        for step in 0..=100 {
            let cos = step as f32 * 0.01;
            let moved = |from: [f32; 2], to: [f32; 2]| {
                (reflectance([from[0], from[1], to[0], to[1]], cos) - reflectance([from[0], 0.0, to[0], 0.0], cos))
                    .abs()
            };
            assert!(moved([1.0, 0.0], [1.5, k]) < 1e-6, "{cos}");
            assert!(cos < 0.8 || moved([1.5, k], [1.0, 0.0]) < 1e-6, "{cos}");
        }
    }

    #[test]
    fn lanes_and_angles_agree() {
        let [n1, n2] = [Lanes([1.0, 1.2]), Lanes([1.5, 0.3])];
        let absorbing = Absorbing { k1: Lanes([0.0, 0.02]), k2: Lanes([0.4, 2.0]), by: By::Exact };
        let both = absorbing.at(&n1, &n2, &Lanes([0.6, 0.4]));
        for (lane, cos) in [0.6, 0.4].into_iter().enumerate() {
            let one = absorbing.lane(lane).at(&Lanes([n1[lane]]), &Lanes([n2[lane]]), &Lanes([cos]));
            assert_eq!((one.r[0], one.cos_theta_t[0]), (both.r[lane], both.cos_theta_t[lane]));
        }
        // Beyond the critical angle of the real indices nothing goes on, but not all is reflected.
        assert!(both.cos_theta_t[1] == 0.0 && both.r[1] < 0.99);
    }
}
