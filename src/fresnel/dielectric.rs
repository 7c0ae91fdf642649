//! Exact Fresnel reflectance and refraction angle of a lossless interface in f32, unpolarised; each lane has its own cosine,
//! because after a dispersive refraction each wavelength has its own direction.
//!
//! ```text
//! d = (n2 − n1)(n2 + n1)   C = n1 c   a = n2 cos θ_t = √(d + C²)   S = n1²s²
//! R_s = d²/(C + a)⁴        R_p = R_s ((C a − S)/(C a + S))²        R = (R_s + R_p)/2 = R_s ((C a)² + S²)/(C a + S)²
//! ```
//!
//! - Source: Born & Wolf, *Principles of Optics* (7th ed., 1999), 1.5.2; r_p/r_s = −cos(θ_i + θ_t)/cos(θ_i − θ_t).
//! - d + C² ≤ 0 is total reflection: R = 1 exactly and cos θ_t = 0. Identical media: R = 0 at every angle.
//! - Valid for n1, n2 > 0 and 0 ≤ c ≤ 1 (a cosine a rounding above 1 does no harm).
//! - Error against `exact` at the same f32 inputs (`tests/it/fresnel/kernels.rs`): R to 8e-7; beside the critical angle, where the
//!   input itself is ill-conditioned, to 2e-3. The second form of a² that `conductor` uses gains a factor 4 there and costs 5 ns: not taken.
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids): 5.3 ns for one lane, 9.3 ns for eight, cos θ_t included.

use crate::math::Lanes;

/// What an interface does to light: reflected part, and the cosine of the refracted ray (0 under total reflection).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric<const N: usize> {
    pub r: Lanes<N>,
    pub cos_theta_t: Lanes<N>,
}

/// Light in n1 meets n2 at cos θ_i, lane by lane.
#[inline]
pub fn fresnel<const N: usize>(n1: &Lanes<N>, n2: &Lanes<N>, cos_theta_i: &Lanes<N>) -> Dielectric<N> {
    let mut interface = Dielectric { r: Lanes::ZERO, cos_theta_t: Lanes::ZERO };
    for lane in 0..N {
        let (r, cos_theta_t) = one(n1[lane], n2[lane], cos_theta_i[lane]);
        interface.r[lane] = r;
        interface.cos_theta_t[lane] = cos_theta_t;
    }
    interface
}

/// Cosine of the refracted ray by Snell's law, 0 under total reflection.
#[inline]
pub fn cos_theta_t<const N: usize>(n1: &Lanes<N>, n2: &Lanes<N>, cos_theta_i: &Lanes<N>) -> Lanes<N> {
    let mut cos_theta_t = Lanes::ZERO;
    for lane in 0..N {
        cos_theta_t[lane] = inside(n1[lane], n2[lane], n1[lane] * cos_theta_i[lane]).max(0.0).sqrt() / n2[lane];
    }
    cos_theta_t
}

/// The cosine on the side of the smaller index, where the angle covers 0…90°.
#[inline]
pub(super) fn on_the_rarer_side<const N: usize>(
    n1: &Lanes<N>,
    n2: &Lanes<N>,
    cos_theta_i: &Lanes<N>,
    cos_theta_t: &Lanes<N>,
) -> Lanes<N> {
    Lanes::from_fn(|lane| if n1[lane] > n2[lane] { cos_theta_t[lane] } else { cos_theta_i[lane] })
}

/// What an approximation may say of an interface: nothing is reflected where there is none, all beyond the critical angle, and
/// elsewhere a share within 0…1.
#[inline]
pub(super) fn bounded<const N: usize>(
    n1: &Lanes<N>,
    n2: &Lanes<N>,
    curve: &Lanes<N>,
    cos_theta_t: Lanes<N>,
) -> Dielectric<N> {
    let r = Lanes::from_fn(|lane| match () {
        () if n1[lane] == n2[lane] => 0.0,
        () if cos_theta_t[lane] == 0.0 => 1.0,
        () => curve[lane].clamp(0.0, 1.0),
    });
    Dielectric { r, cos_theta_t }
}

/// a² = n2² cos²θ_t, negative under total reflection.
#[inline(always)]
fn inside(n1: f32, n2: f32, normal: f32) -> f32 {
    (n2 - n1) * (n2 + n1) + normal * normal
}

#[inline(always)]
fn one(n1: f32, n2: f32, cos: f32) -> (f32, f32) {
    let d = (n2 - n1) * (n2 + n1);
    let normal = n1 * cos;
    let tangential = n1 * n1 * ((1.0 - cos) * (1.0 + cos)).max(0.0);
    let a_squared = inside(n1, n2, normal);
    let a = a_squared.max(0.0).sqrt();
    let sum = normal + a;
    let product = normal * a;
    let both = sum * sum * (product + tangential);
    let r = d * d * (product * product + tangential * tangential) / (both * both + f32::MIN_POSITIVE);
    (if (a_squared > 0.0 || d == 0.0) && r < 1.0 { r } else { 1.0 }, a / n2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lane(n1: f32, n2: f32, cos: f32) -> (f32, f32) {
        let interface = fresnel(&Lanes([n1]), &Lanes([n2]), &Lanes([cos]));
        (interface.r[0], interface.cos_theta_t[0])
    }

    #[test]
    fn glass_reflects_four_percent() {
        let (r, cos_theta_t) = lane(1.0, 1.5, 1.0);
        assert!((r - 0.04).abs() < 1e-8 && (cos_theta_t - 1.0).abs() < 1e-7);
    }

    #[test]
    fn beyond_the_critical_angle_everything_is_reflected() {
        assert_eq!(lane(1.5, 1.0, 0.5), (1.0, 0.0));
        assert_eq!(lane(2.417, 1.0, 0.0), (1.0, 0.0));
    }

    #[test]
    fn identical_media_are_not_there() {
        for cos in [0.0, 0.25, 1.0] {
            assert_eq!(lane(1.5, 1.5, cos), (0.0, cos));
        }
    }

    #[test]
    fn snell_holds_on_both_sides() {
        for cos in [0.999, 0.8, 0.3, 0.01_f32] {
            let (_, cos_t) = lane(1.0, 2.417, cos);
            let (_, back) = lane(2.417, 1.0, cos_t);
            assert!((back - cos).abs() < 2e-6 / cos, "{cos} {back}");
        }
    }
}
