//! Where a smooth lossless interface sends light: mirror direction and Snell's direction, for one vector or lane by lane.
//!
//! ```text
//! reflected = d + 2 cos θ_i n        refracted = η (d + cos θ_i n) − cos θ_t n        η = n1/n2
//! ```
//!
//! - `direction` d travels towards the surface, `normal` n points to the side it comes from, cos θ_i = −d·n ≥ 0.
//!   How much is reflected, and cos θ_t, come from `fresnel::dielectric::fresnel`; how to choose between the two from `branch`.
//! - Source: Born & Wolf, *Principles of Optics* (7th ed., 1999), 1.5.1. The tangential part is formed first, so its rounding
//!   scales with its own size; one Newton step for 1/√x ends at unit length.
//! - Error (tests below): length 1 to 1.5e-7, Snell's law (n sin θ as a vector) to 6e-7 at any angle; no drift in 1,000 refractions.
//! - Cost (`benches/bsdf.rs`): 22 ns for Fresnel, the shared choice and eight refracted directions together.
//! - Under total reflection (cos θ_t = 0) there is no refracted ray: what `refract` returns then is finite and unused.

use crate::math::{Lanes, Vectors};
use glam::Vec3;

/// Mirror direction of one vector.
#[inline]
pub fn reflect(direction: Vec3, normal: Vec3, cos_theta_i: f32) -> Vec3 {
    unit(direction + normal * (2.0 * cos_theta_i))
}

/// Refracted direction of one vector; `eta` = n1/n2.
#[inline]
pub fn refract(direction: Vec3, normal: Vec3, eta: f32, cos_theta_i: f32, cos_theta_t: f32) -> Vec3 {
    unit((direction + normal * cos_theta_i) * eta - normal * cos_theta_t)
}

/// Mirror directions, lane by lane.
#[inline]
pub fn reflect_lanes<const N: usize>(
    directions: &Vectors<N>,
    normals: &Vectors<N>,
    cos_theta_i: &Lanes<N>,
) -> Vectors<N> {
    let mut reflected = *directions;
    for lane in 0..N {
        reflected.set(lane, reflect(directions.get(lane), normals.get(lane), cos_theta_i[lane]));
    }
    reflected
}

/// Refracted directions, lane by lane; a shared direction or normal is `Vectors::splat`.
#[inline]
pub fn refract_lanes<const N: usize>(
    directions: &Vectors<N>,
    normals: &Vectors<N>,
    eta: &Lanes<N>,
    cos_theta_i: &Lanes<N>,
    cos_theta_t: &Lanes<N>,
) -> Vectors<N> {
    let mut refracted = *directions;
    for lane in 0..N {
        let (direction, normal) = (directions.get(lane), normals.get(lane));
        refracted.set(lane, refract(direction, normal, eta[lane], cos_theta_i[lane], cos_theta_t[lane]));
    }
    refracted
}

/// Unit length from nearly unit length: v (3 − |v|²)/2.
#[inline]
fn unit(v: Vec3) -> Vec3 {
    v * (1.5 - 0.5 * v.length_squared())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::dielectric::fresnel;

    fn incoming(cos: f32, azimuth: f64) -> Vec3 {
        let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
        Vec3::new(sin * libm::cos(azimuth) as f32, sin * libm::sin(azimuth) as f32, -cos)
    }

    #[test]
    fn refraction_obeys_snell_and_stays_unit() {
        for (n1, n2) in [(1.0, 1.5), (1.5, 1.0), (1.0, 2.417), (2.417, 1.0)] {
            for step in 1..1000 {
                let cos = step as f32 * 1e-3;
                let direction = incoming(cos, step as f64);
                let cos_t = fresnel(&Lanes([n1]), &Lanes([n2]), &Lanes([cos])).cos_theta_t[0];
                if cos_t == 0.0 {
                    continue;
                }
                let refracted = refract(direction, Vec3::Z, n1 / n2, cos, cos_t);
                assert!((refracted.as_dvec3().length() - 1.0).abs() < 1.5e-7);
                let snell = refracted.truncate() * n2 - direction.truncate() * n1;
                assert!(snell.length() < 6e-7, "{n1} {n2} {cos} {snell}");
            }
        }
    }

    #[test]
    fn a_long_path_does_not_drift() {
        let mut direction = incoming(0.4, 0.3);
        for bounce in 0..1000 {
            let normal = incoming(0.9, bounce as f64 * 2.399);
            let normal = if normal.dot(direction) > 0.0 { -normal } else { normal };
            let cos = -normal.dot(direction);
            let (n1, n2) = if bounce % 2 == 0 { (1.0, 1.5) } else { (1.5, 1.0) };
            let cos_t = fresnel(&Lanes([n1]), &Lanes([n2]), &Lanes([cos])).cos_theta_t[0];
            direction = if cos_t > 0.0 {
                refract(direction, normal, n1 / n2, cos, cos_t)
            } else {
                reflect(direction, normal, cos)
            };
            assert!((direction.as_dvec3().length() - 1.0).abs() < 2e-7, "{bounce}");
        }
    }

    #[test]
    fn lanes_agree_with_single_vectors() {
        let n2 = Lanes([1.4, 1.5, 1.6, 2.4]);
        let directions = Vectors::from_fn(|lane| incoming(0.2 + 0.2 * lane as f32, lane as f64));
        let normals = Vectors::splat(Vec3::Z);
        let cos_i = directions.dot(&Vectors::splat(-Vec3::Z));
        let interface = fresnel(&Lanes::ONE, &n2, &cos_i);
        let eta = Lanes::ONE / n2;
        let refracted = refract_lanes(&directions, &normals, &eta, &cos_i, &interface.cos_theta_t);
        let reflected = reflect_lanes(&directions, &normals, &cos_i);
        for lane in 0..4 {
            let direction = directions.get(lane);
            assert_eq!(
                refracted.get(lane),
                refract(direction, Vec3::Z, eta[lane], cos_i[lane], interface.cos_theta_t[lane])
            );
            assert!((reflected.get(lane) - direction * Vec3::new(1.0, 1.0, -1.0)).length() < 2e-7);
        }
    }
}
