//! Spheres: the cone they fill from outside, their area from inside.
//!
//! Source: M. Pharr, W. Jakob, G. Humphreys, Physically Based Rendering, 4th ed. (2023), 6.2.4. The cone's opening is kept
//! as 1 − cos θ, from sin² / (1 + cos), so that it keeps its digits at any distance.

use std::f32::consts::PI;

use glam::Vec3;

use super::{Toward, area_pdf, basis, by_area};
use crate::geometry::{Hit, Sphere};

/// 1 − cos of the half opening of the cone, and its sin²; `None` from inside.
fn cone(sphere: &Sphere, reference: Vec3) -> Option<(f32, f32)> {
    let distance2 = (sphere.center() - reference).length_squared();
    let sin2 = sphere.radius() * sphere.radius() / distance2;
    (sin2 < 1.0).then(|| (sin2 / (1.0 + (1.0 - sin2).sqrt()), sin2))
}

pub(super) fn sample(sphere: &Sphere, reference: Vec3, u: [f32; 2]) -> Option<Toward> {
    let (sin_phi, cos_phi) = libm::sincosf(2.0 * PI * u[1]);
    let Some((opening, sin2_max)) = cone(sphere, reference) else {
        let z = 1.0 - 2.0 * u[0];
        let r = 2.0 * (u[0] * (1.0 - u[0])).sqrt();
        let normal = Vec3::new(r * cos_phi, r * sin_phi, z);
        return by_area(reference, sphere.center() + normal * sphere.radius(), normal, 0, sphere.area());
    };
    let axis = sphere.center() - reference;
    let distance_to_center = axis.length();
    let axis = axis / distance_to_center;
    let (x, y) = basis(axis);
    let down = u[0] * opening;
    let (cos_theta, sin2_theta) = (1.0 - down, (down * (2.0 - down)).max(0.0));
    let sin_theta = sin2_theta.sqrt();
    let direction = x * (sin_theta * cos_phi) + y * (sin_theta * sin_phi) + axis * cos_theta;
    // The angle at the sphere's centre, without subtracting what is nearly equal.
    let depth = (1.0 - sin2_theta / sin2_max).max(0.0).sqrt();
    let cos_alpha = sin2_theta / sin2_max.sqrt() + cos_theta * depth;
    let sin_alpha = (1.0 - cos_alpha * cos_alpha).max(0.0).sqrt();
    let normal = x * (sin_alpha * cos_phi) + y * (sin_alpha * sin_phi) - axis * cos_alpha;
    let normal = normal.try_normalize()?;
    let distance = distance_to_center * cos_theta - sphere.radius() * depth;
    Some(Toward {
        point: sphere.center() + normal * sphere.radius(),
        normal,
        facet: 0,
        direction: direction.try_normalize()?,
        distance: distance.max(0.0),
        pdf: 1.0 / (2.0 * PI * opening),
    })
}

pub(super) fn pdf(sphere: &Sphere, reference: Vec3, direction: Vec3, hit: &Hit) -> f32 {
    match cone(sphere, reference) {
        Some((opening, _)) => 1.0 / (2.0 * PI * opening),
        None => area_pdf(reference, direction, hit.point, hit.normal, sphere.area()),
    }
}
