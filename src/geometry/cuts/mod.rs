//! Gem cuts from their proportions, as convex solids.
//!
//! Lengths are scene units, angles degrees against the girdle plane, ratios as gemmologists state them. The stone stands
//! on its culet: the lowest point is the origin, the table looks to +z.

mod brilliant;
mod step;

pub use brilliant::Brilliant;
pub use step::StepCut;

use super::GeometryError;

/// A proportion within its limits, or an error that names it.
fn within(name: &'static str, value: f64, min: f64, max: f64) -> Result<f64, GeometryError> {
    if value >= min && value <= max {
        return Ok(value);
    }
    Err(GeometryError::Proportion { name, value, wants: format!("it goes from {min} to {max}") })
}

/// sin, cos and tan of an angle in degrees.
fn trigonometry(degrees: f64) -> (f64, f64, f64) {
    let (sin, cos) = libm::sincos(degrees * (std::f64::consts::PI / 180.0));
    (sin, cos, sin / cos)
}
