//! Spheres: the cone they fill from outside, their area from inside.
//!
//! Source: M. Pharr, W. Jakob, G. Humphreys, Physically Based Rendering, 4th ed. (2023), 6.2.4. The cone's opening is kept
//! as 1 − cos θ, from sin² / (1 + cos), so that it keeps its digits at any distance. In double precision, which costs little and makes lamps
//! of any size at any distance good to single precision.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};

use super::{Toward, area_pdf, basis, by_area};
use crate::geometry::{Hit, Sphere};

/// The cone of directions that meet a sphere.
struct Cone {
    axis: DVec3,
    distance2: f64,
    /// sin² of the half opening.
    sin2: f64,
    /// 1 − cos of it.
    opening: f64,
}

impl Cone {
    /// `None` from inside.
    fn new(sphere: &Sphere, reference: Vec3) -> Option<Self> {
        let axis = sphere.center().as_dvec3() - reference.as_dvec3();
        let distance2 = axis.length_squared();
        let sin2 = squared(sphere.radius()) / distance2;
        let opening = sin2 / (1.0 + (1.0 - sin2).sqrt());
        (sin2 < 1.0).then(|| Self { axis: axis / distance2.sqrt(), distance2, sin2, opening })
    }

    fn pdf(&self) -> f32 {
        (1.0 / (2.0 * PI * self.opening)) as f32
    }
}

fn squared(x: f32) -> f64 {
    x as f64 * x as f64
}

pub(super) fn sample(sphere: &Sphere, reference: Vec3, u: [f32; 2]) -> Option<Toward> {
    let (sin_phi, cos_phi) = libm::sincosf(2.0 * std::f32::consts::PI * u[1]);
    let Some(cone) = Cone::new(sphere, reference) else {
        let z = 1.0 - 2.0 * u[0];
        let r = 2.0 * (u[0] * (1.0 - u[0])).sqrt();
        let normal = Vec3::new(r * cos_phi, r * sin_phi, z);
        return by_area(reference, sphere.center() + normal * sphere.radius(), normal, 0, sphere.area());
    };
    let (x, y) = basis(cone.axis.as_vec3());
    let sideways = x.as_dvec3() * cos_phi as f64 + y.as_dvec3() * sin_phi as f64;
    let down = u[0] as f64 * cone.opening;
    let (cos, sin2) = (1.0 - down, down * (2.0 - down));
    let sin = sin2.sqrt();
    // Half the chord over the radius, and the nearer end by the product of both ends' distances: nothing is subtracted
    // that is nearly equal, from afar or near the surface.
    let half_chord = (1.0 - sin2 / cone.sin2).max(0.0).sqrt();
    let (radius, center_distance) = (sphere.radius() as f64, cone.distance2.sqrt());
    let distance = (cone.distance2 - radius * radius) / (center_distance * cos + radius * half_chord);
    // The normal's angle to the axis: its sine by the law of sines, its cosine as pbrt has it.
    let sin_alpha = distance * sin / radius;
    let cos_alpha = sin2 / cone.sin2.sqrt() + cos * half_chord;
    let normal = (sideways * sin_alpha - cone.axis * cos_alpha).normalize_or(-cone.axis).as_vec3();
    Some(Toward {
        point: sphere.center() + normal * sphere.radius(),
        normal,
        facet: 0,
        direction: (sideways * sin + cone.axis * cos).normalize_or(cone.axis).as_vec3(),
        distance: distance as f32,
        pdf: cone.pdf(),
    })
}

pub(super) fn pdf(sphere: &Sphere, reference: Vec3, direction: Vec3, hit: &Hit) -> f32 {
    match Cone::new(sphere, reference) {
        Some(cone) => cone.pdf(),
        None => area_pdf(reference, direction, hit.point, hit.normal, sphere.area()),
    }
}
