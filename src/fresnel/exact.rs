//! The exact Fresnel equations of one interface in f64: the reference for everything else in this room.
//!
//! A plane wave in a medium of real index n1 meets a half-space N = n2 + i k2 at c = cos θ_i, s² = (1 − c)(1 + c).
//! With d = N² − n1² and w = N cos θ_t = √(d + n1²c²) = a + i b (a, b ≥ 0, ab = n2 k2), q = |w|²:
//!
//! ```text
//! r_s = −d / (n1 c + w)²                          1 − R_s = 4 n1 c a / (n1²c² + q + 2 n1 c a)
//! r_p =  d (N²c² − n1²s²) / (N²c + n1 w)²         1 − R_p = 4 n1 c a (q + n1²s²) / (|N|⁴c² + n1²q + 2 n1 c a (q + n1²s²))
//! ```
//!
//! - Source: the equations of Born & Wolf, *Principles of Optics* (7th ed., 1999), 1.5.2 and 14.2, in a form that never subtracts
//!   nearly equal numbers: Re(N² w̄) = a (q + n1²s²) makes every term of both denominators positive.
//!   The three real differences that remain are taken with 32 digits (`double`).
//! - Convention: exp(−iωt), k ≥ 0, r_p = −r_s at normal incidence; phases are arg r in (−π, π].
//! - Valid for n1 > 0, n2 ≥ 0, k2 ≥ 0 (not both 0), 0 ≤ c ≤ 1. Total reflection gives R = 1 and 1 − R = 0 exactly, identical media R = 0.
//! - Error, against 60 digits (`tests/it/fresnel/hard.rs`): R and 1 − R to 7e-16, relative as well as absolute, phases to 5e-16 rad;
//!   beside the critical angle too, because w is formed from the unrounded difference.
//! - Cost: 0.12 µs (`benches/fresnel.rs`). Not for the inner loop: see `conductor` and `dielectric`.

use super::double::Double;

/// Powers and phases reflected by an interface. `r` is the mean of the two polarisations; `one_minus_*` are formed
/// without the subtraction. A phase is NaN where its R is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflection {
    pub rs: f64,
    pub rp: f64,
    pub r: f64,
    pub one_minus_rs: f64,
    pub one_minus_rp: f64,
    pub one_minus_r: f64,
    pub delta_s: f64,
    pub delta_p: f64,
    /// Total internal reflection: k2 = 0 and nothing is transmitted.
    pub tir: bool,
}

/// Reflection of light coming from the medium n1 at cos θ_i against N = n2 + i k2.
pub fn reflect(n1: f64, n2: f64, k2: f64, cos_theta_i: f64) -> Reflection {
    if n1 == n2 && k2 == 0.0 {
        return NOTHING;
    }
    let waves = Waves::new(n1, n2, k2, cos_theta_i);
    if k2 == 0.0 && waves.inside.re == 0.0 { waves.total() } else { waves.partial() }
}

/// Identical media.
const NOTHING: Reflection = Reflection {
    rs: 0.0,
    rp: 0.0,
    r: 0.0,
    one_minus_rs: 1.0,
    one_minus_rp: 1.0,
    one_minus_r: 1.0,
    delta_s: f64::NAN,
    delta_p: f64::NAN,
    tir: false,
};

#[derive(Clone, Copy)]
struct Complex {
    re: f64,
    im: f64,
}

impl Complex {
    fn arg(self) -> f64 {
        libm::atan2(self.im, self.re)
    }

    fn norm_squared(self) -> f64 {
        self.re * self.re + self.im * self.im
    }
}

/// What both polarisations share, all free of cancellation.
struct Waves {
    n1: f64,
    cos: f64,
    /// N².
    square: Complex,
    /// d = N² − n1².
    contrast: Complex,
    /// w = N cos θ_t.
    inside: Complex,
    /// N²c² − n1²s², zero at Brewster's angle.
    brewster: Complex,
    /// q = |w|².
    inside_squared: f64,
    /// n1²s².
    tangential_squared: f64,
}

impl Waves {
    fn new(n1: f64, n2: f64, k2: f64, cos: f64) -> Self {
        let outside_squared = Double::square(n1);
        let square_re = Double::square(n2) - Double::square(k2);
        let contrast_re = square_re - outside_squared;
        let normal = Double::product(n1, cos);
        let cos_squared = Double::square(cos);
        let inside_squared_re = (contrast_re + normal * normal).rounded();
        let brewster_re = ((square_re + outside_squared) * cos_squared - outside_squared).rounded();
        let half_im = n2 * k2;
        let modulus = libm::hypot(inside_squared_re, 2.0 * half_im);
        Self {
            n1,
            cos,
            square: Complex { re: square_re.rounded(), im: 2.0 * half_im },
            contrast: Complex { re: contrast_re.rounded(), im: 2.0 * half_im },
            inside: root(inside_squared_re, half_im, modulus),
            brewster: Complex { re: brewster_re, im: 2.0 * half_im * cos * cos },
            inside_squared: modulus,
            tangential_squared: n1 * n1 * (1.0 - cos) * (1.0 + cos),
        }
    }

    /// R = 1 exactly; only the phases are to be found.
    fn total(&self) -> Reflection {
        Reflection {
            rs: 1.0,
            rp: 1.0,
            r: 1.0,
            one_minus_rs: 0.0,
            one_minus_rp: 0.0,
            one_minus_r: 0.0,
            delta_s: self.delta_s(),
            delta_p: self.delta_p(),
            tir: true,
        }
    }

    fn partial(&self) -> Reflection {
        let Self { n1, cos, inside_squared: q, tangential_squared, .. } = *self;
        let normal = n1 * cos;
        let flux_s = 2.0 * normal * self.inside.re;
        let flux_p = flux_s * (q + tangential_squared);
        let sum_s = normal * normal + q + flux_s;
        let sum_p = self.square.norm_squared() * cos * cos + n1 * n1 * q + flux_p;
        let contrast = self.contrast.norm_squared();
        let rs = contrast / sum_s / sum_s;
        let rp = contrast / sum_p * (self.brewster.norm_squared() / sum_p);
        let (one_minus_rs, one_minus_rp) = (2.0 * flux_s / sum_s, 2.0 * flux_p / sum_p);
        Reflection {
            rs,
            rp,
            r: 0.5 * (rs + rp),
            one_minus_rs,
            one_minus_rp,
            one_minus_r: 0.5 * (one_minus_rs + one_minus_rp),
            delta_s: if rs == 0.0 { f64::NAN } else { self.delta_s() },
            delta_p: if rp == 0.0 { f64::NAN } else { self.delta_p() },
            tir: false,
        }
    }

    /// arg r_s = arg(−d) − 2 arg(n1 c + w).
    fn delta_s(&self) -> f64 {
        let sum = Complex { re: self.n1 * self.cos + self.inside.re, im: self.inside.im };
        let against = Complex { re: -self.contrast.re, im: -self.contrast.im };
        principal(against.arg() - 2.0 * sum.arg())
    }

    /// arg r_p = arg d + arg(N²c² − n1²s²) − 2 arg(N²c + n1 w).
    fn delta_p(&self) -> f64 {
        let sum = Complex {
            re: self.square.re * self.cos + self.n1 * self.inside.re,
            im: self.square.im * self.cos + self.n1 * self.inside.im,
        };
        principal(self.contrast.arg() + self.brewster.arg() - 2.0 * sum.arg())
    }
}

/// √(re + 2i·half_im) in the first quadrant: the larger part from the modulus, the other from ab = half_im.
fn root(re: f64, half_im: f64, modulus: f64) -> Complex {
    let larger = ((re.abs() + modulus) * 0.5).sqrt();
    let smaller = if larger > 0.0 { half_im / larger } else { 0.0 };
    if re >= 0.0 { Complex { re: larger, im: smaller } } else { Complex { re: smaller, im: larger } }
}

/// The same angle in (−π, π].
fn principal(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    let turned = angle - TAU * (angle / TAU).round();
    if turned <= -PI { turned + TAU } else { turned }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_incidence_is_the_formula_of_textbooks() {
        let gold = reflect(1.0, 0.235, 2.97, 1.0);
        let (n, k) = (0.235_f64, 2.97_f64);
        let f0 = ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k);
        assert!((gold.rs - f0).abs() < 1e-15 && (gold.rp - f0).abs() < 1e-15);
        assert!((principal(gold.delta_s - gold.delta_p).abs() - std::f64::consts::PI).abs() < 1e-14);
    }

    #[test]
    fn total_reflection_is_exact() {
        let glass = reflect(1.5, 1.0, 0.0, 0.5);
        assert!(glass.tir && glass.r == 1.0 && glass.one_minus_r == 0.0);
    }

    #[test]
    fn identical_media_reflect_nothing() {
        for cos in [0.0, 1e-12, 0.3, 1.0] {
            let nothing = reflect(1.33, 1.33, 0.0, cos);
            assert!(nothing.r == 0.0 && nothing.one_minus_r == 1.0 && nothing.delta_s.is_nan());
        }
    }

    #[test]
    fn power_is_the_same_from_both_sides() {
        for cos_i in [0.01, 0.3, 0.8, 1.0_f64] {
            let cos_t = (1.0 - (1.0 - cos_i * cos_i) / (2.417 * 2.417_f64)).sqrt();
            let (there, back) = (reflect(1.0, 2.417, 0.0, cos_i), reflect(2.417, 1.0, 0.0, cos_t));
            assert!((there.rs - back.rs).abs() < 1e-12 && (there.rp - back.rp).abs() < 1e-12, "{there:?} {back:?}");
        }
    }
}
