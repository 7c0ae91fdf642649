//! Where paths begin: a camera, and the filter that spreads samples over a pixel's neighbourhood.

mod aperture;
mod filter;

pub use aperture::Aperture;
pub use filter::Filter;

use crate::geometry::{Bounds, Ray, Rectangle};
use glam::{DVec3, Vec3};
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
    #[error("{name} is {value}: it must be a positive finite length")]
    Length { name: &'static str, value: f64 },
    #[error("an aperture of {0} blades: it has 3 to 32, or 0 to be round")]
    Blades(u32),
}

/// How wide the camera sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// Horizontal field of view in degrees.
    FieldOfView(f64),
    /// Focal length and sensor width in mm; the sensor's height follows from the picture's shape.
    FocalLength { focal_length_mm: f64, sensor_width_mm: f64 },
    /// Parallel rays (orthographic): the picture is this wide in scene units at every distance.
    Parallel { width: f64 },
}

impl Lens {
    /// Half the picture's width at distance 1, for parallel rays at every distance.
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
            Self::Parallel { width } if width > 0.0 && width.is_finite() => Ok(width / 2.0),
            Self::Parallel { width } => Err(CameraError::Length { name: "orthographic_width", value: width }),
        }
    }
}

/// A camera: rays from one point, from the opening of a lens, or side by side.
#[derive(Clone, Debug)]
pub struct Camera {
    position: Vec3,
    forward: Vec3,
    right: Vec3,
    down: Vec3,
    /// From the position to the picture's upper left corner at distance 1; for parallel rays across the view only.
    corner: Vec3,
    step_x: Vec3,
    step_y: Vec3,
    parallel: bool,
    aperture: Option<Aperture>,
}

impl Camera {
    /// A camera for a picture of `width` × `height` square pixels.
    pub fn new(
        position: Vec3,
        look_at: Vec3,
        up: Vec3,
        lens: Lens,
        aperture: Option<Aperture>,
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
        let parallel = matches!(lens, Lens::Parallel { .. });
        let ahead = if parallel { DVec3::ZERO } else { forward };
        Ok(Self {
            position,
            forward: forward.as_vec3(),
            right: right.as_vec3(),
            down: down.as_vec3(),
            corner: (ahead - right * half_width - down * half_height).as_vec3(),
            step_x: (right * pixel).as_vec3(),
            step_y: (down * pixel).as_vec3(),
            parallel,
            aperture,
        })
    }

    pub fn position(&self) -> Vec3 {
        self.position
    }

    /// A ray through a point of the picture, in pixels from its upper left corner. `lens` gives two uniform numbers for
    /// the point of the opening; a pinhole does not ask for them.
    #[inline]
    pub fn ray(&self, x: f32, y: f32, lens: impl FnOnce() -> [f32; 2]) -> Ray {
        let view = self.corner + self.step_x * x + self.step_y * y;
        if self.parallel {
            return Ray::free(self.position + view, self.forward);
        }
        let Some(aperture) = &self.aperture else { return Ray::free(self.position, view.normalize()) };
        let [across, along] = aperture.sample(lens());
        let opening = self.right * across + self.down * along;
        Ray::free(self.position + opening, (view * aperture.focus_distance - opening).normalize())
    }
}

impl Camera {
    /// The ray through a point of the picture that no opening blurs: from the lens's middle.
    pub fn principal_ray(&self, x: f32, y: f32) -> Ray {
        let view = self.corner + self.step_x * x + self.step_y * y;
        match self.parallel {
            true => Ray::free(self.position + view, self.forward),
            false => Ray::free(self.position, view.normalize()),
        }
    }

    /// Whether a ray of the picture, or of the reach of its filter around it, may meet something in a box; false only if surely none does.
    pub fn may_see(&self, bounds: &Bounds) -> bool {
        let corners = bounds.corners().map(|corner| self.seen(corner));
        let beyond = |outside: &dyn Fn(&[f64; 3]) -> bool| corners.iter().all(outside);
        let [x, y] = self.half_extent();
        let sides = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
        let aside = |[a, b]: [f64; 2]| {
            beyond(&|[across, down, ahead]| {
                let limit = (a * x + b * y).abs() * if self.parallel { 1.0 } else { ahead.max(0.0) };
                a * across + b * down > limit + self.blur(*ahead)
            })
        };
        !beyond(&|[_, _, ahead]| *ahead < 0.0) && !sides.into_iter().any(aside)
    }

    /// The same for what is infinitely far in a direction, up to an angle from it in radians.
    pub fn may_see_toward(&self, direction: Vec3, half_angle: f64) -> bool {
        let own = if self.parallel { 0.0 } else { self.half_angle() };
        angle(direction.as_dvec3(), self.forward.as_dvec3()) <= own + half_angle
    }

    /// Where a point is, in scene units to the right of the camera, below and in front of it.
    fn seen(&self, point: Vec3) -> [f64; 3] {
        let to = (point - self.position).as_dvec3();
        [self.right, self.down, self.forward].map(|axis| to.dot(axis.as_dvec3()))
    }

    /// How far the opening smears a point at a distance along the view, scene units.
    fn blur(&self, ahead: f64) -> f64 {
        self.aperture.map_or(0.0, |aperture| {
            f64::from(aperture.radius) * (1.0 - ahead / f64::from(aperture.focus_distance)).abs()
        })
    }

    /// Half of the picture's width and height at distance 1, with the reach of the filter around it.
    fn half_extent(&self) -> [f64; 2] {
        let corner = self.corner - (self.step_x + self.step_y) * Filter::REACH;
        [self.right, self.down].map(|axis| f64::from(corner.dot(axis).abs()))
    }

    /// Largest angle of a ray to the direction of view, radians.
    fn half_angle(&self) -> f64 {
        let [x, y] = self.half_extent();
        let slant = self.aperture.map_or(0.0, |aperture| f64::from(aperture.radius / aperture.focus_distance));
        libm::atan(libm::hypot(x, y)) + libm::atan(slant)
    }

    /// Where the rays of a picture of so many pixels begin, if not all in one point: the opening,
    /// with the square around it, or for parallel rays the picture and what the filter adds to it
    /// on each side.
    pub fn origins(&self, [width, height]: [u32; 2], overhang: f32) -> Option<Rectangle> {
        let edges = match (self.parallel, &self.aperture) {
            (true, _) => {
                [self.step_x * (width as f32 + 2.0 * overhang), self.step_y * (height as f32 + 2.0 * overhang)]
            }
            (false, Some(aperture)) => [self.right, self.down].map(|axis| axis * (2.0 * aperture.radius)),
            (false, None) => return None,
        };
        Rectangle::new(self.position, edges[0], edges[1]).ok()
    }

    /// How far in front of the camera a point is, along the direction of view.
    pub fn depth(&self, point: Vec3) -> f32 {
        (point - self.position).dot(self.forward)
    }
}

/// Between unit vectors, radians.
fn angle(a: DVec3, b: DVec3) -> f64 {
    2.0 * libm::atan2((a - b).length(), (a + b).length())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(lens: Lens) -> Result<Camera, CameraError> {
        Camera::new(Vec3::new(0.0, -10.0, 0.0), Vec3::ZERO, Vec3::Z, lens, None, [300, 200])
    }

    #[test]
    fn centre_looks_forward_and_edges_span_the_field_of_view() {
        let camera = camera(Lens::FieldOfView(60.0)).unwrap();
        assert!((camera.ray(150.0, 100.0, || unreachable!("a pinhole")).direction - Vec3::Y).length() < 1e-6);
        let left = camera.ray(0.0, 100.0, || unreachable!("a pinhole")).direction;
        let right = camera.ray(300.0, 100.0, || unreachable!("a pinhole")).direction;
        assert!(left.x < 0.0 && right.x > 0.0, "x grows to the right");
        assert!((left.angle_between(right).to_degrees() - 60.0).abs() < 1e-4);
        assert!(camera.ray(150.0, 0.0, || unreachable!("a pinhole")).direction.z > 0.0, "the first row is the top");
    }

    #[test]
    fn focal_length_on_full_frame_equals_its_field_of_view() {
        let by_focal = camera(Lens::FocalLength { focal_length_mm: 50.0, sensor_width_mm: 36.0 }).unwrap();
        let fov = 2.0 * (18.0f64 / 50.0).atan().to_degrees();
        let by_fov = camera(Lens::FieldOfView(fov)).unwrap();
        assert!(
            (by_focal.ray(3.0, 7.0, || unreachable!("a pinhole")).direction
                - by_fov.ray(3.0, 7.0, || unreachable!("a pinhole")).direction)
                .length()
                < 1e-6
        );
    }

    #[test]
    fn impossible_cameras_are_errors() {
        assert_eq!(camera(Lens::FieldOfView(0.0)).unwrap_err(), CameraError::FieldOfView(0.0));
        assert!(camera(Lens::FieldOfView(f64::NAN)).is_err());
        assert!(camera(Lens::FocalLength { focal_length_mm: -1.0, sensor_width_mm: 36.0 }).is_err());
        let same = Camera::new(Vec3::ONE, Vec3::ONE, Vec3::Z, Lens::FieldOfView(40.0), None, [2, 2]);
        assert_eq!(same.unwrap_err(), CameraError::NoDirection);
        let along = Camera::new(Vec3::ZERO, Vec3::Z, Vec3::Z, Lens::FieldOfView(40.0), None, [2, 2]);
        assert_eq!(along.unwrap_err(), CameraError::UpAlongView);
    }

    #[test]
    fn rays_through_an_opening_meet_in_the_plane_of_focus() {
        let aperture = Aperture::new(0.5, 0, 8.0).unwrap();
        let camera = |aperture| {
            let lens = Lens::FieldOfView(60.0);
            Camera::new(Vec3::new(0.0, -10.0, 0.0), Vec3::ZERO, Vec3::Z, lens, aperture, [300, 200]).unwrap()
        };
        let at = |ray: Ray, y: f32| ray.origin + ray.direction * ((y - ray.origin.y) / ray.direction.y);
        let sharp = at(camera(None).ray(20.0, 30.0, || [0.0; 2]), -2.0);
        let mut widest: f32 = 0.0;
        for i in 0..64 {
            let ray = camera(Some(aperture)).ray(20.0, 30.0, || [i as f32 / 64.0, 0.999]);
            assert!((at(ray, -2.0) - sharp).length() < 1e-4, "8 units ahead everything is sharp");
            // Twice as far the blur is as wide as the opening.
            let far = at(camera(None).ray(20.0, 30.0, || [0.0; 2]), 6.0);
            widest = widest.max((at(ray, 6.0) - far).length());
        }
        assert!((widest - 0.5).abs() < 1e-3, "{widest}");
    }

    #[test]
    fn rays_begin_within_their_origins() {
        let at = |lens, aperture| {
            let position = Vec3::new(0.0, -10.0, 0.0);
            Camera::new(position, Vec3::ZERO, Vec3::Z, lens, aperture, [300, 200]).expect("a good camera")
        };
        let size = |camera: &Camera| camera.origins([300, 200], 1.0).map(|all| all.bounds().size());
        assert_eq!(size(&at(Lens::FieldOfView(60.0), None)), None);
        let opening = size(&at(Lens::FieldOfView(60.0), Aperture::new(0.5, 6, 8.0).ok())).expect("an opening");
        assert!((opening - Vec3::new(1.0, 0.0, 1.0)).length() < 1e-6, "{opening}");
        // A pixel more on each side.
        let view = size(&at(Lens::Parallel { width: 30.0 }, None)).expect("a view");
        assert!((view - Vec3::new(30.2, 0.0, 20.2)).length() < 1e-4, "{view}");
    }

    #[test]
    fn parallel_rays_keep_their_distance() {
        let camera = camera(Lens::Parallel { width: 30.0 }).unwrap();
        let [left, right] = [0.0, 300.0].map(|x| camera.ray(x, 100.0, || unreachable!("no opening")));
        assert_eq!((left.direction, right.direction), (Vec3::Y, Vec3::Y));
        assert!((left.origin - Vec3::new(-15.0, -10.0, 0.0)).length() < 1e-5, "{}", left.origin);
        assert!((right.origin - Vec3::new(15.0, -10.0, 0.0)).length() < 1e-5);
    }
}
