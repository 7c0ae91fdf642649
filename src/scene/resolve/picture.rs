//! How the film is to be developed: exposure, what is white, and whose eye sees.

use super::Resolver;
use crate::scene::describe::{self, ExposureValue, ObserverName};
use crate::scene::{Picture, SceneError};
use crate::spectrum::{Observer, Spectrum, white_xyz};
use toml::Spanned;

/// What is white unless the scene says otherwise.
const WHITE: &str = "D65";

/// Exposures go from −64 to 64 EV: far beyond any light, and what the film can develop.
const EV_LIMIT: f64 = 64.0;

impl Resolver<'_> {
    pub fn picture(&mut self, picture: &describe::Picture) -> Result<Picture, SceneError> {
        let observer = self.library.observer(observer(picture.observer))?;
        let white_balance = picture.white_balance.as_ref().map_or(WHITE, |name| name.get_ref()).to_owned();
        let span = picture.white_balance.as_ref().map_or(0..0, Spanned::span);
        let white = if white_balance == "scene" {
            self.strongest_light()
        } else {
            let found = self.library.light(&white_balance, self.text.base());
            found.map_err(|error| self.text.error(&span, error))?.spectrum.clone()
        };
        let white = white_xyz(&white, &observer).map_err(|error| self.text.error(&span, error))?;
        let exposure = self.exposure(&picture.exposure)?;
        Ok(Picture { exposure, white_balance, white, gamut: picture.gamut, observer })
    }

    /// The light with the greatest power; equal-energy white where nothing shines.
    fn strongest_light(&self) -> Spectrum {
        let shining = self.white_candidates.iter().filter(|(power, _)| *power > 0.0);
        let strongest = shining.max_by(|a, b| a.0.total_cmp(&b.0));
        strongest.map_or(Spectrum::Constant(1.0), |&(_, id)| self.spectra.get(id).clone())
    }

    fn exposure(&self, exposure: &Option<Spanned<ExposureValue>>) -> Result<ExposureValue, SceneError> {
        let Some(exposure) = exposure else { return Ok(ExposureValue::Auto) };
        match *exposure.get_ref() {
            ExposureValue::Ev(ev) if !(-EV_LIMIT..=EV_LIMIT).contains(&ev) => {
                let message = format!("an exposure of {ev} EV: it lies between −{EV_LIMIT} and {EV_LIMIT}");
                Err(self.text.error(&exposure.span(), message))
            }
            exposure => Ok(exposure),
        }
    }
}

fn observer(name: ObserverName) -> Observer {
    match name {
        ObserverName::Cie1931 => Observer::Cie1931,
        ObserverName::Cie1964 => Observer::Cie1964,
        ObserverName::Cie2015 => Observer::Cie2015,
    }
}
