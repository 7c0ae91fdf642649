//! The camera: where it stands, where it looks and how wide it sees.

use super::{Resolver, vector};
use crate::camera::{Camera, CameraError, Lens};
use crate::geometry::World;
use crate::scene::describe;
use crate::scene::{Object, SceneError};
use std::ops::Range;
use toml::Spanned;

/// Up in the picture unless the scene says otherwise.
const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// Of full frame.
const SENSOR_WIDTH_MM: f64 = 36.0;

impl Resolver<'_> {
    pub fn camera(
        &self,
        described: &Spanned<describe::Camera>,
        size: [u32; 2],
        world: &World,
        objects: &[Object],
    ) -> Result<Camera, SceneError> {
        let camera = described.get_ref();
        let lens = self.lens(camera, described.span())?;
        let [position, look_at] = [&camera.position, &camera.look_at].map(|v| vector(v.get_ref().values()));
        let up = camera.up.as_ref().map_or(UP, |up| up.get_ref().values());
        if let Some(inside) = world.shapes().iter().position(|shape| shape.contains(position)) {
            let message = format!("the camera stands inside `{}`, which is solid", objects[inside].name);
            return Err(self.text.error(&camera.position.span(), message).help("move it out of the object"));
        }
        Camera::new(position, look_at, vector(up), lens, size)
            .map_err(|error| self.text.error(&place(&error, described), error))
    }

    fn lens(&self, camera: &describe::Camera, span: Range<usize>) -> Result<Lens, SceneError> {
        match (&camera.fov, &camera.focal_length_mm, &camera.sensor_width_mm) {
            (Some(fov), None, None) => Ok(Lens::FieldOfView(*fov.get_ref())),
            (None, Some(focal), sensor) => Ok(Lens::FocalLength {
                focal_length_mm: *focal.get_ref(),
                sensor_width_mm: sensor.as_ref().map_or(SENSOR_WIDTH_MM, |width| *width.get_ref()),
            }),
            (None, None, _) => {
                let help = "add `fov = …` in degrees, or `focal_length_mm = …`";
                Err(self.text.error(&span, "how wide does the camera see?").help(help))
            }
            (Some(_), Some(focal), _) => {
                Err(self.text.error(&focal.span(), "`fov` and `focal_length_mm` both say how wide the camera sees"))
            }
            (Some(_), None, Some(width)) => {
                let message = "`sensor_width_mm` goes with `focal_length_mm`, not with `fov`";
                Err(self.text.error(&width.span(), message))
            }
        }
    }
}

/// Where the value stands that an error is about.
fn place(error: &CameraError, described: &Spanned<describe::Camera>) -> Range<usize> {
    let camera = described.get_ref();
    let number = match error {
        CameraError::NoDirection => return camera.look_at.span(),
        CameraError::UpAlongView => return camera.up.as_ref().map_or(described.span(), Spanned::span),
        CameraError::FieldOfView(_) => &camera.fov,
        CameraError::Length { name: "sensor_width_mm", .. } => &camera.sensor_width_mm,
        CameraError::Length { .. } => &camera.focal_length_mm,
    };
    number.as_ref().map_or(described.span(), Spanned::span)
}
