//! The Fresnel model of a surface, made ready for the wavelengths of a path.
//!
//! Spectral models are made of the indices at each hit. RGB models are fitted once to each interface that a path meets: fits take
//! milliseconds, and most pairs of media never touch.

use super::Tracer;
use super::vertex::Vertex;
use crate::fresnel::absorbing::{Absorbing, By};
use crate::fresnel::{DielectricFresnel, Fresnel, FresnelModel, RgbCurve, RgbFresnel, RgbModel, SpectralModel, Target};
use crate::math::Lanes;
use crate::scene::{MediumId, Physics, RgbColors, Scene};
use crate::spectrum::{SpectrumId, Wavelengths};
use std::collections::HashMap;
use std::sync::{OnceLock, PoisonError, RwLock};

/// Curves of RGB models by interface, as far as they were needed.
pub struct RgbCurves<'a> {
    scene: &'a Scene,
    colors: &'a RgbColors,
    /// By surface and the medium it is seen from.
    metals: Vec<OnceLock<RgbCurve>>,
    boundaries: RwLock<HashMap<(RgbModel, MediumId, MediumId), RgbCurve>>,
}

impl<'a> RgbCurves<'a> {
    pub fn new(scene: &'a Scene) -> Option<Self> {
        let colors = scene.rgb.as_ref()?;
        let metals = (0..scene.surfaces.len() * scene.media.len()).map(|_| OnceLock::new()).collect();
        Some(Self { scene, colors, metals, boundaries: RwLock::default() })
    }

    /// Of a metal, `surface` of the scene, seen from a medium.
    fn metal(&self, model: RgbModel, surface: u32, index: [SpectrumId; 2], medium: MediumId) -> RgbCurve {
        let place = surface as usize * self.scene.media.len() + usize::from(medium.0);
        *self.metals[place].get_or_init(|| model.fit(&Target::new(self.scene.metal(index, medium), &self.colors.meter)))
    }

    fn boundary(&self, model: RgbModel, from: MediumId, to: MediumId) -> RgbCurve {
        let key = (model, from.min(to), from.max(to));
        let known = self.boundaries.read().unwrap_or_else(PoisonError::into_inner).get(&key).copied();
        known.unwrap_or_else(|| {
            let curve = model.fit(&Target::new(self.scene.boundary(from, to), &self.colors.meter));
            self.boundaries.write().unwrap_or_else(PoisonError::into_inner).insert(key, curve);
            curve
        })
    }
}

impl<const P: u32> Tracer<'_, P> {
    /// Returns the reflectance of the metal of these indices that a path has met.
    #[inline]
    pub fn metal<const N: usize>(&self, model: FresnelModel, index: [SpectrumId; 2], vertex: &Vertex<N>) -> Fresnel<N> {
        let &Vertex { medium, wavelengths, .. } = vertex;
        let spectral = match (model, &self.rgb) {
            _ if !Self::runs(Physics::APPROXIMATIONS) => SpectralModel::Exact,
            (FresnelModel::Rgb(model), Some(curves)) => {
                let surface = self.scene.object(vertex.hit.shape).surface;
                return Fresnel::Rgb(on_lanes(curves.metal(model, surface, index, medium), curves, wavelengths));
            }
            (FresnelModel::Spectral(model), _) => model,
            (FresnelModel::Rgb(_), None) => NEVER,
        };
        let [n, k] = index.map(|id| wavelengths.at(id));
        Fresnel::Spectral(spectral.at(&self.n(medium, wavelengths), &n, &k))
    }

    /// The model at the boundary of two clear media.
    #[inline]
    pub fn boundary<const N: usize>(
        &self,
        model: FresnelModel,
        from: MediumId,
        to: MediumId,
        wavelengths: Wavelengths<N>,
    ) -> DielectricFresnel<N> {
        if Self::runs(Physics::COMPLEX_INDEX)
            && let Some(absorbing) = self.absorbing(model, from, to, wavelengths)
        {
            return DielectricFresnel::Absorbing(absorbing);
        }
        match (model, &self.rgb) {
            _ if !Self::runs(Physics::APPROXIMATIONS) => DielectricFresnel::Spectral(SpectralModel::Exact),
            (FresnelModel::Rgb(model), Some(curves)) => {
                DielectricFresnel::Rgb(on_lanes(curves.boundary(model, from, to), curves, wavelengths))
            }
            (FresnelModel::Spectral(model), _) => DielectricFresnel::Spectral(model),
            (FresnelModel::Rgb(_), None) => DielectricFresnel::Spectral(NEVER),
        }
    }

    /// None where both media are as good as clear.
    #[inline(never)]
    fn absorbing<const N: usize>(
        &self,
        model: FresnelModel,
        from: MediumId,
        to: MediumId,
        wavelengths: Wavelengths<N>,
    ) -> Option<Absorbing<N>> {
        let ids = [from, to].map(|medium| self.scene.medium(medium).k);
        let [k1, k2] = ids.map(|k| k.map_or(Lanes::ZERO, |k| wavelengths.at(k)));
        let by = match (ids, model, &self.rgb) {
            ([None, None], ..) => return None,
            ([Some(_), _], ..) => By::Exact,
            ([None, _], FresnelModel::Rgb(model), Some(curves)) => {
                By::Rgb(on_lanes(curves.boundary(model, from, to), curves, wavelengths))
            }
            ([None, _], FresnelModel::Spectral(model), _) if !model.dielectrics_only() => By::Spectral(model),
            _ => By::Exact,
        };
        let by = if by == By::Spectral(SpectralModel::Exact) { By::Exact } else { by };
        Some(Absorbing { k1, k2, by })
    }
}

#[inline(never)]
fn on_lanes<const N: usize>(curve: RgbCurve, curves: &RgbCurves, wavelengths: Wavelengths<N>) -> RgbFresnel<N> {
    RgbFresnel { curve, primaries: curves.colors.primaries.map(|id| wavelengths.at(id)) }
}

/// For RGB models in a scene without their colours, which `resolve` never makes.
const NEVER: SpectralModel = SpectralModel::Exact;
