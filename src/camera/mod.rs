//! Where paths begin: a pinhole camera and the filter that spreads samples over a pixel's neighbourhood.

mod filter;

pub use filter::Filter;

use crate::geometry::{Departure, Ray};
use glam::Vec3;
use thiserror::Error;

/// What is wrong with a camera.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CameraError {
    #[error("the camera's position and look_at are the same point")]
    NoDirection,
    #[error("`up` is parallel to the direction of view (or zero): the picture's roll is undefined")]
    UpAlongView,
    #[error("a field of view of {0}° is not between 0° and 180° (both excluded)")]
    FieldOfView(f64),
    #[error("{name} is {value}, but must be a positive finite length in mm")]
    Length { name: &'static str, value: f64 },
}

/// How wide the camera sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// Horizontal field of view in degrees.
    FieldOfView(f64),
    /// Focal length and sensor width in mm; the sensor's height follows from the picture's shape.
    FocalLength { focal_length_mm: f64, sensor_width_mm: f64 },
}

impl Lens {
    /// Half the picture's width at distance 1.
    fn half_width(self) -> Result<f64, CameraError> {
        match self {
            Self::FieldOfView(degrees) => {
                if !(degrees > 0.0 && degrees < 180.0) {
                    return Err(CameraError::FieldOfView(degrees));
                }
                Ok(libm::tan(degrees.to_radians() / 2.0))
            }
            Self::FocalLength { focal_length_mm, sensor_width_mm } => {
                for (name, value) in [("focal_length_mm", focal_length_mm), ("sensor_width_mm", sensor_width_mm)] {
                    if !(value > 0.0 && value.is_finite()) {
                        return Err(CameraError::Length { name, value });
                    }
                }
                Ok(sensor_width_mm / (2.0 * focal_length_mm))
            }
        }
    }
}

/// A pinhole camera: everything in focus, rays from one point.
#[derive(Clone, Debug)]
pub struct Camera {
    position: Vec3,
    corner: Vec3,
    step_x: Vec3,
    step_y: Vec3,
}

impl Camera {
    /// A camera for a picture of `width` × `height` square pixels.
    pub fn new(
        position: Vec3,
        look_at: Vec3,
        up: Vec3,
        lens: Lens,
        [width, height]: [u32; 2],
    ) -> Result<Self, CameraError> {
        let half_width = lens.half_width()?;
        let forward = (look_at - position).as_dvec3().try_normalize().ok_or(CameraError::NoDirection)?;
        let up = up.as_dvec3().try_normalize().ok_or(CameraError::UpAlongView)?;
        let across = forward.cross(up);
        if across.length() < 1e-6 {
            return Err(CameraError::UpAlongView);
        }
        let right = across.normalize();
        let down = forward.cross(right);
        let pixel = 2.0 * half_width / f64::from(width);
        let half_height = pixel * f64::from(height) / 2.0;
        Ok(Self {
            position,
            corner: (forward - right * half_width - down * half_height).as_vec3(),
            step_x: (right * pixel).as_vec3(),
            step_y: (down * pixel).as_vec3(),
        })
    }

    pub fn position(&self) -> Vec3 {
        self.position
    }

    /// The ray through a point of the picture, in pixels from its upper left corner.
    #[inline]
    pub fn ray(&self, x: f32, y: f32) -> Ray {
        let direction = (self.corner + self.step_x * x + self.step_y * y).normalize();
        Ray { origin: self.position, direction, departs: Departure::Free }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(lens: Lens) -> Result<Camera, CameraError> {
        Camera::new(Vec3::new(0.0, -10.0, 0.0), Vec3::ZERO, Vec3::Z, lens, [300, 200])
    }

    #[test]
    fn centre_looks_forward_and_edges_span_the_field_of_view() {
        let camera = camera(Lens::FieldOfView(60.0)).unwrap();
        assert!((camera.ray(150.0, 100.0).direction - Vec3::Y).length() < 1e-6);
        let left = camera.ray(0.0, 100.0).direction;
        let right = camera.ray(300.0, 100.0).direction;
        assert!(left.x < 0.0 && right.x > 0.0, "x grows to the right");
        assert!((left.angle_between(right).to_degrees() - 60.0).abs() < 1e-4);
        assert!(camera.ray(150.0, 0.0).direction.z > 0.0, "the first row is the top");
    }

    #[test]
    fn focal_length_on_full_frame_equals_its_field_of_view() {
        let by_focal = camera(Lens::FocalLength { focal_length_mm: 50.0, sensor_width_mm: 36.0 }).unwrap();
        let fov = 2.0 * (18.0f64 / 50.0).atan().to_degrees();
        let by_fov = camera(Lens::FieldOfView(fov)).unwrap();
        assert!((by_focal.ray(3.0, 7.0).direction - by_fov.ray(3.0, 7.0).direction).length() < 1e-6);
    }

    #[test]
    fn impossible_cameras_are_errors() {
        assert_eq!(camera(Lens::FieldOfView(0.0)).unwrap_err(), CameraError::FieldOfView(0.0));
        assert!(camera(Lens::FieldOfView(f64::NAN)).is_err());
        assert!(camera(Lens::FocalLength { focal_length_mm: -1.0, sensor_width_mm: 36.0 }).is_err());
        let same = Camera::new(Vec3::ONE, Vec3::ONE, Vec3::Z, Lens::FieldOfView(40.0), [2, 2]);
        assert_eq!(same.unwrap_err(), CameraError::NoDirection);
        let along = Camera::new(Vec3::ZERO, Vec3::Z, Vec3::Z, Lens::FieldOfView(40.0), [2, 2]);
        assert_eq!(along.unwrap_err(), CameraError::UpAlongView);
    }
}
