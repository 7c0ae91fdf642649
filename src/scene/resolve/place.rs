//! Where the scene's origin is put, and what single precision leaves of places far from it.
//!
//! Rays go in single precision, which keeps 24 bits of a coordinate: 1e6 units away places are 0.06
//! units apart, and a lamp three units over a floor there lit it 0.8 % too brightly (2026-11). So what
//! the camera looks at becomes the origin if it is far away. It is taken from places in double
//! precision, in the last step that places an object: its copies, its `transform`, or its shape.

use super::Resolver;
use crate::geometry::Shape;
use crate::scene::{describe, listed};
use glam::{DVec3, Vec3};

/// The origin stays where it is if it is not this many times as far away as the camera from what it looks at. Places in view are then
/// rounded by 6e-6 of that distance.
const FAR: f64 = 100.0;

/// Objects whose places are rounded by more than this share of their size are told.
const COARSE: f32 = 1.0 / 1024.0;

/// An object that is small for its distance from the origin.
pub struct Rounded {
    name: String,
    /// By how much its places are off, scene units.
    by: f32,
}

/// Returns what places are measured from.
pub fn origin(camera: &describe::Camera) -> DVec3 {
    let (Some(position), Some(look_at)) = (&camera.position, &camera.look_at) else { return DVec3::ZERO };
    let [position, look_at] = [position, look_at].map(|place| DVec3::from_array(place.get_ref().values()));
    // A number of single precision, so that meshes lose nothing when it is taken from their corners.
    let origin = look_at.as_vec3().as_dvec3();
    let far = look_at.length() > FAR * (position - look_at).length();
    if far && origin.is_finite() { origin } else { DVec3::ZERO }
}

/// Returns a place as seen from an origin.
pub fn place(values: [f64; 3], origin: DVec3) -> Vec3 {
    (DVec3::from_array(values) - origin).as_vec3()
}

impl Resolver<'_> {
    /// Returns what the shape, the `transform` and the copies of an object are each measured from.
    pub fn origins(&self, object: &describe::Object) -> [DVec3; 3] {
        let last = match (&object.transform, object.copies.is_empty()) {
            (_, false) => 2,
            (Some(_), true) => 1,
            (None, true) => 0,
        };
        let mut origins = [DVec3::ZERO; 3];
        origins[last] = self.origin;
        origins
    }

    /// Remembers a shape whose places are rounded so much that it shows.
    pub fn note_rounding(&mut self, name: &str, shape: &Shape) {
        let bounds = shape.bounds();
        let farthest = bounds.min.abs().max(bounds.max.abs()).max_element();
        let by = farthest * 0.5 * f32::EPSILON;
        if by > COARSE * bounds.size().length() {
            self.rounded.push(Rounded { name: name.to_owned(), by });
        }
    }

    pub fn warn_of_rounding(&mut self) {
        let mut names: Vec<&str> = self.rounded.iter().map(|rounded| rounded.name.as_str()).collect();
        names.dedup();
        let by = self.rounded.iter().map(|rounded| rounded.by).fold(0.0, f32::max);
        if !names.is_empty() {
            self.warnings.push(format!(
                "small things so far from where the camera looks that single precision shifts their places by up to {by:.1e} units, \
                 more than a thousandth of their size: {}. Let the camera look at them, or bring them nearer (a mesh, in its file)",
                listed(&names)
            ));
        }
    }
}
