//! Any model on a specimen, as tables and plots ask for it: at a wavelength, and as a colour.

use super::{Fitted, FresnelModel, RgbCurve, Specimen, SpectralModel, Target};
use crate::math::Lanes;
use crate::spectrum::Colorimeter;

/// A model made ready for one specimen.
#[derive(Clone, Copy, Debug)]
pub struct Tabulated<'a> {
    specimen: Specimen<'a>,
    model: Fitted,
}

impl<'a> Tabulated<'a> {
    /// RGB models are fitted to the target's colours.
    pub fn new(model: FresnelModel, target: &Target<'a>) -> Self {
        Self { specimen: target.specimen, model: Fitted::new(model, target) }
    }

    /// The fitted curve of an RGB model.
    pub fn rgb_curve(&self) -> Option<&RgbCurve> {
        match &self.model {
            Fitted::Spectral(_) => None,
            Fitted::Rgb(curve) => Some(curve),
        }
    }

    /// Reflectance at a wavelength, nm; none of an RGB model. The exact model is the f64 reference, others are the kernels that render.
    pub fn at(&self, nm: f64, cos_theta_i: f64) -> Option<f64> {
        match self.model {
            Fitted::Spectral(model) => Some(spectral(model, &self.specimen, nm, cos_theta_i)),
            Fitted::Rgb(_) => None,
        }
    }

    /// The colour after `bounces` reflections at the same angle, linear RGB: the colour of the spectrum's power, or the power of each
    /// channel of an RGB model, which knows no light but its own.
    pub fn color(&self, cos_theta_i: f64, bounces: i32, meter: &Colorimeter) -> [f64; 3] {
        match self.model {
            Fitted::Spectral(model) => meter.rgb(|nm| spectral(model, &self.specimen, nm, cos_theta_i).powi(bounces)),
            Fitted::Rgb(curve) => curve.reflectance(cos_theta_i as f32).0.map(|value| f64::from(value).powi(bounces)),
        }
    }
}

fn spectral(model: SpectralModel, specimen: &Specimen, nm: f64, cos_theta_i: f64) -> f64 {
    if model == SpectralModel::Exact {
        return specimen.reflect(nm, cos_theta_i).r;
    }
    let [n1, n2, k2] = specimen.indices(nm).map(|value| Lanes([value as f32]));
    let cos = cos_theta_i as f32;
    match model.dielectrics_only() {
        true => f64::from(model.dielectric(&n1, &n2, &Lanes([cos])).r[0]),
        false => f64::from(model.at(&n1, &n2, &k2).reflectance(cos)[0]),
    }
}
