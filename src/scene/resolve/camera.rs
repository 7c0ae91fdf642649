//! The camera: where it stands, where it looks, how wide it sees and what is sharp.

use super::{Resolver, vector};
use crate::camera::{Aperture, Camera, CameraError, Lens};
use crate::geometry::World;
use crate::scene::describe;
use crate::scene::{Filling, Object, SceneError};
use std::ops::Range;
use toml::Spanned;

/// Up in the picture unless the scene says otherwise.
const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// Of full frame.
const SENSOR_WIDTH_MM: f64 = 36.0;

impl Resolver<'_> {
    pub fn camera(&self, described: &Spanned<describe::Camera>, size: [u32; 2]) -> Result<Camera, SceneError> {
        let camera = described.get_ref();
        let lens = self.lens(camera, described.span())?;
        let [position, look_at] = [&camera.position, &camera.look_at].map(|v| vector(v.get_ref().values()));
        let up = camera.up.as_ref().map_or(UP, |up| up.get_ref().values());
        let aperture = self.aperture(described, (look_at - position).length())?;
        Camera::new(position, look_at, vector(up), lens, aperture, size)
            .map_err(|error| self.text.error(&place(&error, described), error))
    }

    /// What the camera stands in.
    pub fn around_camera(
        &self,
        described: &Spanned<describe::Camera>,
        world: &World,
        objects: &[Object],
    ) -> Result<Vec<Filling>, SceneError> {
        let position = &described.get_ref().position;
        self.around(vector(position.get_ref().values()), world, objects).map_err(|inside| {
            let message = format!("the camera stands inside `{}`, which lets no light through", objects[inside].name);
            self.text.error(&position.span(), message).help("move it out of the object")
        })
    }

    /// The opening in scene units; `None` without `f_number`, with which everything is in focus.
    fn aperture(&self, described: &Spanned<describe::Camera>, to_look_at: f32) -> Result<Option<Aperture>, SceneError> {
        let camera = described.get_ref();
        let Some(f_number) = &camera.f_number else {
            let spans = [camera.focus_distance.as_ref().map(Spanned::span), camera.blades.as_ref().map(Spanned::span)];
            return match spans.into_iter().flatten().next() {
                Some(span) => {
                    Err(self.text.error(&span, "this goes with `f_number`: without it everything is in focus"))
                }
                None => Ok(None),
            };
        };
        let span = f_number.span();
        let n = self.positive(f_number, "`f_number`")?;
        let Some(focal_length) = &camera.focal_length_mm else {
            return Err(self.text.error(&span, "`f_number` goes with `focal_length_mm`, whose part the aperture is"));
        };
        let metres = self.meters_per_unit.ok_or_else(|| {
            let error = self.text.error(&span, "an aperture has a size in mm, so the scene must say how large it is");
            error.help("add `meters_per_unit = …` at the top, 0.001 if the scene is in millimetres")
        })?;
        let radius = focal_length.get_ref() / (2.0 * n) * 1e-3 / metres;
        let distance = camera.focus_distance.as_ref().map_or(f64::from(to_look_at), |distance| *distance.get_ref());
        let blades = camera.blades.as_ref().map_or(0, |blades| *blades.get_ref());
        let aperture = Aperture::new(radius, blades, distance);
        aperture.map(Some).map_err(|error| self.text.error(&place(&error, described), error))
    }

    fn lens(&self, camera: &describe::Camera, span: Range<usize>) -> Result<Lens, SceneError> {
        if let Some(width) = &camera.orthographic_width {
            let others = [&camera.fov, &camera.focal_length_mm, &camera.sensor_width_mm];
            return match others.into_iter().flatten().next() {
                Some(other) => Err(self
                    .text
                    .error(&other.span(), "`orthographic_width` and this both say how wide the camera sees")),
                None => Ok(Lens::Parallel { width: *width.get_ref() }),
            };
        }
        match (&camera.fov, &camera.focal_length_mm, &camera.sensor_width_mm) {
            (Some(fov), None, None) => Ok(Lens::FieldOfView(*fov.get_ref())),
            (None, Some(focal), sensor) => Ok(Lens::FocalLength {
                focal_length_mm: *focal.get_ref(),
                sensor_width_mm: sensor.as_ref().map_or(SENSOR_WIDTH_MM, |width| *width.get_ref()),
            }),
            (None, None, _) => {
                let help = "add `fov = …` in degrees, `focal_length_mm = …` or `orthographic_width = …`";
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
        CameraError::Length { name: "orthographic_width", .. } => &camera.orthographic_width,
        CameraError::Length { name: "focus_distance", .. } => &camera.focus_distance,
        CameraError::Length { name: "the radius of the aperture", .. } => &camera.f_number,
        CameraError::Blades(_) => return camera.blades.as_ref().map_or(described.span(), Spanned::span),
        CameraError::Length { .. } => &camera.focal_length_mm,
    };
    number.as_ref().map_or(described.span(), Spanned::span)
}
