//! Point lights: intensity or flux, and a cone.

use super::Resolver;
use super::place::place;
use crate::light::{Cone, Emitter, Point, Source};
use crate::scene::SceneError;
use crate::scene::describe;
use glam::DVec3;

impl Resolver<'_> {
    pub fn point(&mut self, described: &describe::PointLight) -> Result<Emitter, SceneError> {
        let span = described.spectrum.span();
        let Some(metres) = self.meters_per_unit else {
            let error =
                self.text.error(&span, "light from a point fades with metres, so the scene must say how large it is");
            return Err(error.help("add `meters_per_unit = …` at the top, 0.001 if the scene is in millimetres"));
        };
        let light =
            Point::new(place(described.position.get_ref().values(), self.origin), metres, self.cone(described)?);
        let (spectrum, _) = self.light_spectrum(described.spectrum.get_ref(), &span, "a point light")?;
        let candela = match (&described.luminous_intensity, &described.luminous_flux) {
            (Some(candela), None) => self.not_negative(candela, "luminous_intensity")?,
            (None, Some(lumen)) => self.not_negative(lumen, "luminous_flux")? / light.solid_angle(),
            (Some(_), Some(flux)) => {
                let message = "`luminous_intensity` and `luminous_flux` both say how strong the light is";
                return Err(self.text.error(&flux.span(), message));
            }
            (None, None) => {
                let help = "give `luminous_intensity` in cd or `luminous_flux` in lm (a candle: 1 cd; a bulb: 800 lm)";
                return Err(self.text.error(&span, "how strong is the light?").help(help));
            }
        };
        // A candela over a square metre is the unit of luminance, and the same factor leads to both.
        let factor = self.factor("luminance", candela, &spectrum, &span)?;
        let resolved = self.scaled(spectrum, factor, &span, "cd")?;
        // As a lamp's power is luminance times area, in scene units and without π.
        let power = candela * light.solid_angle() / std::f64::consts::PI / (metres * metres);
        self.white_candidates.push((power, resolved.id));
        Ok(Emitter { source: Source::Point(light), radiance: resolved.id, power })
    }

    fn cone(&self, described: &describe::PointLight) -> Result<Option<Cone>, SceneError> {
        let (direction, angle, fade) = (&described.direction, &described.cone_angle, &described.fade);
        match (direction, angle) {
            (None, None) => match fade {
                None => Ok(None),
                Some(fade) => Err(self.text.error(&fade.span(), "`fade` goes with `cone_angle`")),
            },
            (Some(direction), None) => {
                Err(self.text.error(&direction.span(), "`direction` goes with `cone_angle`: how wide is the cone?"))
            }
            (None, Some(angle)) => {
                Err(self.text.error(&angle.span(), "`cone_angle` goes with `direction`: whereto does the cone open?"))
            }
            (Some(direction), Some(angle)) => {
                let none = angle.get_ref().to_radians() / 2.0;
                let fade = fade.as_ref().map_or(0.0, |fade| fade.get_ref().to_radians());
                let axis = DVec3::from_array(direction.get_ref().values());
                Cone::new(axis, none - fade, none).map(Some).ok_or_else(|| {
                    let message = "a cone needs a direction other than zero, an angle of 0.02° to 360°, and a `fade` of at most half of it";
                    self.text.error(&angle.span(), message)
                })
            }
        }
    }
}
