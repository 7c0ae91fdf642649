//! A model made ready for an interface, for whoever asks as rendering does but has no scene: tables, curves, what it costs.
//!
//! A render keeps its own (`render::models`), for its indices come from tables and its fits from many threads.

use super::{DielectricFresnel, Fresnel, FresnelModel, RgbCurve, RgbFresnel, Specimen, SpectralModel, Target};
use crate::math::Lanes;

/// A model with all that does not depend on the wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fitted {
    Spectral(SpectralModel),
    Rgb(RgbCurve),
}

impl Fitted {
    /// RGB models are fitted to the target's colours.
    pub fn new(model: FresnelModel, target: &Target) -> Self {
        match model {
            FresnelModel::Spectral(model) => Self::Spectral(model),
            FresnelModel::Rgb(model) => Self::Rgb(model.fit(target)),
        }
    }
}

/// One side of an interface at the wavelengths of a path, by the kernels that render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ready<const N: usize> {
    model: Fitted,
    n1: Lanes<N>,
    n2: Lanes<N>,
    k2: Lanes<N>,
    primaries: [Lanes<N>; 3],
    clear: bool,
}

impl<const N: usize> Ready<N> {
    /// A model at wavelengths in nm; `clear` if what enters goes on, and `primaries` as in [`RgbFresnel`].
    pub fn new(model: Fitted, specimen: &Specimen, nm: &[f64; N], primaries: [Lanes<N>; 3], clear: bool) -> Self {
        let indices = nm.map(|nm| specimen.indices(nm));
        let [n1, n2, k2] = [0, 1, 2].map(|part| Lanes::from_fn(|lane| indices[lane][part] as f32));
        Self { model, n1, n2, k2, primaries, clear }
    }

    /// The other side of an interface of clear media.
    pub fn from_inside(self) -> Self {
        Self { n1: self.n2, n2: self.n1, ..self }
    }

    /// Unpolarised reflectance of all lanes at one cos θ_i.
    #[inline]
    pub fn reflectance(&self, cos_theta_i: f32) -> Lanes<N> {
        let Self { model, n1, n2, k2, primaries, clear } = self;
        if *clear {
            let fresnel = match *model {
                Fitted::Spectral(model) => DielectricFresnel::Spectral(model),
                Fitted::Rgb(curve) => DielectricFresnel::Rgb(RgbFresnel { curve, primaries: *primaries }),
            };
            return fresnel.at(n1, n2, &Lanes::splat(cos_theta_i)).r;
        }
        let fresnel = match *model {
            Fitted::Spectral(model) => Fresnel::Spectral(model.at(n1, n2, k2)),
            Fitted::Rgb(curve) => Fresnel::Rgb(RgbFresnel { curve, primaries: *primaries }),
        };
        fresnel.reflectance(cos_theta_i)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::exact::reflect;
    use crate::spectrum::Spectrum;

    #[test]
    fn lanes_are_the_exact_equations_on_either_side() {
        let [one, n, k] = [1.0, 1.5, 3.0].map(Spectrum::Constant);
        let near = |found: Lanes<2>, expected: f64| found.0.iter().all(|r| (f64::from(*r) - expected).abs() < 2e-6);
        let exact = Fitted::Spectral(SpectralModel::Exact);
        let ready = |specimen: Specimen, clear| Ready::new(exact, &specimen, &[450.0, 650.0], [Lanes::ZERO; 3], clear);
        let metal = ready(Specimen { n1: &one, n2: &n, k2: &k }, false);
        let glass = ready(Specimen::clear(&one, &n), true);
        for cos in [1.0, 0.75, 0.5, 0.125_f32] {
            let expected = |n1, n2, k2| reflect(n1, n2, k2, f64::from(cos)).r;
            assert!(near(metal.reflectance(cos), expected(1.0, 1.5, 3.0)));
            assert!(near(glass.reflectance(cos), expected(1.0, 1.5, 0.0)));
            assert!(near(glass.from_inside().reflectance(cos), expected(1.5, 1.0, 0.0)));
        }
    }
}
