//! The camera: where it stands, where it looks, how wide it sees and what is sharp.

use super::Resolver;
use super::view::View;
use crate::camera::{Aperture, Camera, CameraError, Lens};
use crate::geometry::loaders::Projection;
use crate::scene::SceneError;
use crate::scene::describe;
use std::ops::Range;
use toml::Spanned;

/// Of full frame.
const SENSOR_WIDTH_MM: f64 = 36.0;

impl Resolver<'_> {
    pub fn camera(
        &self,
        described: &Spanned<describe::Camera>,
        view: &View,
        size: [u32; 2],
    ) -> Result<Camera, SceneError> {
        let lens = self.lens(described, view, size)?;
        let aperture = self.aperture(described, view)?;
        Camera::new(view.position, view.look_at, view.up, lens, aperture, size)
            .map_err(|error| self.text.error(&place(&error, described, view), error))
    }

    /// The opening in scene units; `None` without `f_number`, with which everything is in focus.
    fn aperture(&self, described: &Spanned<describe::Camera>, view: &View) -> Result<Option<Aperture>, SceneError> {
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
        let to_look_at = (view.look_at - view.position).length();
        let distance = camera.focus_distance.as_ref().map_or(f64::from(to_look_at), |distance| *distance.get_ref());
        let blades = camera.blades.as_ref().map_or(0, |blades| *blades.get_ref());
        let aperture = Aperture::new(radius, blades, distance);
        aperture.map(Some).map_err(|error| self.text.error(&place(&error, described, view), error))
    }

    fn lens(
        &self,
        described: &Spanned<describe::Camera>,
        view: &View,
        [width, height]: [u32; 2],
    ) -> Result<Lens, SceneError> {
        let camera = described.get_ref();
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
            (None, None, _) => match &view.projection {
                Some(projection) => Ok(filed(projection, f64::from(width) / f64::from(height))),
                None => {
                    let help = "add `fov = …` in degrees, `focal_length_mm = …` or `orthographic_width = …`";
                    Err(self.text.error(&described.span(), "how wide does the camera see?").help(help))
                }
            },
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

/// The lens of a file's camera.
fn filed(projection: &Projection, aspect_ratio: f64) -> Lens {
    match (projection.horizontal_fov_degrees(aspect_ratio), *projection) {
        (Some(fov), _) => Lens::FieldOfView(fov),
        (None, Projection::Orthographic { width, .. }) => Lens::Parallel { width },
        (None, Projection::Perspective { vertical_fov_degrees, .. }) => Lens::FieldOfView(vertical_fov_degrees),
    }
}

/// Where the value stands that an error is about.
fn place(error: &CameraError, described: &Spanned<describe::Camera>, view: &View) -> Range<usize> {
    let camera = described.get_ref();
    let number = match error {
        CameraError::NoDirection => return view.look_at_at.clone(),
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
