//! The interfaces of a scene as a report shows them: how much each reflects against the angle, and what asking costs.
//!
//! By the very kernels that render, in the eight lanes of a path; the scene's outside medium is on the other side.

use crate::fresnel::{DielectricFresnel, Fresnel, FresnelModel, RgbCurve, RgbFresnel, Specimen, SpectralModel, Target};
use crate::report::comparison::{Curves, Line};
use crate::report::timing::ns_per_call;
use crate::scene::{MediumId, Scene, Surface};
use crate::spectrum::{LANES, Lanes, SpectrumId};
use std::collections::BTreeSet;

/// Where a curve is sampled: 400 to 700 nm, a path's lanes at a time.
const SETS: usize = 6;
const FIRST_NM: f64 = 400.0;
const LAST_NM: f64 = 700.0;

/// From which side an interface is met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum From {
    Outside,
    Inside,
}

/// The indices at the wavelengths of a path.
struct Indices {
    outside: Lanes<LANES>,
    n: Lanes<LANES>,
    k: Lanes<LANES>,
    /// Of RGB models.
    primaries: [Lanes<LANES>; 3],
    /// What the eye makes of each wavelength; all sets together sum to 1.
    weights: Lanes<LANES>,
}

/// What reflects by Fresnel's equations, or by a model of them.
struct Interface {
    model: Ready,
    sets: Vec<Indices>,
    metal: bool,
}

enum Ready {
    Spectral(SpectralModel),
    Rgb(RgbCurve),
}

impl Ready {
    fn new(scene: &Scene, model: FresnelModel, specimen: Specimen) -> Option<Self> {
        Some(match model {
            FresnelModel::Spectral(model) => Self::Spectral(model),
            FresnelModel::Rgb(model) => Self::Rgb(model.fit(&Target::new(specimen, &scene.rgb.as_ref()?.meter))),
        })
    }
}

impl Interface {
    /// `None` if the surface is none.
    fn of(scene: &Scene, surface: usize) -> Option<Self> {
        match *scene.surfaces.get(surface)? {
            Surface::Conductor { n, k, model, .. } => {
                let model = Ready::new(scene, model, scene.metal([n, k], MediumId::OUTSIDE))?;
                Some(Self { model, sets: indices(scene, n, Some(k)), metal: true })
            }
            Surface::Dielectric(interface) => {
                let n = scene.medium(interface.medium).n;
                let [outside, inside] = [scene.medium(MediumId::OUTSIDE).n, n].map(|id| scene.spectra.get(id));
                let model = Ready::new(scene, interface.model, Specimen::between(outside, inside))?;
                Some(Self { model, sets: indices(scene, n, None), metal: false })
            }
            Surface::Black | Surface::Diffuse { .. } => None,
        }
    }

    #[inline]
    fn lanes(&self, set: &Indices, from: From, cos_theta_i: f32) -> Lanes<LANES> {
        let Indices { outside, n, k, primaries, .. } = set;
        if self.metal {
            let fresnel = match self.model {
                Ready::Spectral(model) => Fresnel::Spectral(model.at(outside, n, k)),
                Ready::Rgb(curve) => Fresnel::Rgb(RgbFresnel { curve, primaries: *primaries }),
            };
            return fresnel.reflectance(cos_theta_i);
        }
        let fresnel = match self.model {
            Ready::Spectral(model) => DielectricFresnel::Spectral(model),
            Ready::Rgb(curve) => DielectricFresnel::Rgb(RgbFresnel { curve, primaries: *primaries }),
        };
        let (n1, n2) = if from == From::Outside { (outside, n) } else { (n, outside) };
        fresnel.at(n1, n2, &Lanes::splat(cos_theta_i)).r
    }

    /// Reflectance weighted by what the eye makes of each wavelength.
    fn luminous(&self, from: From, cos_theta_i: f32) -> f64 {
        self.sets.iter().map(|set| f64::from((self.lanes(set, from, cos_theta_i) * set.weights).sum())).sum()
    }

    /// Points (degrees, reflectance).
    fn curve(&self, from: From) -> Vec<[f64; 2]> {
        let at = |degrees: f64| [degrees, self.luminous(from, libm::cos(degrees.to_radians()).max(0.0) as f32)];
        (0..=180).map(|half| at(f64::from(half) / 2.0)).collect()
    }

    fn nanoseconds(&self) -> f64 {
        let set = &self.sets[0];
        ns_per_call(|cos_theta_i| self.lanes(set, From::Outside, cos_theta_i).sum())
    }
}

fn indices(scene: &Scene, n: SpectrumId, k: Option<SpectrumId>) -> Vec<Indices> {
    let step = (LAST_NM - FIRST_NM) / (SETS * LANES - 1) as f64;
    let eye = |i: usize| scene.picture.observer.at(FIRST_NM + step * i as f64)[1];
    let total: f64 = (0..SETS * LANES).map(eye).sum();
    let lanes = |set: usize, value: &dyn Fn(f64) -> f64| {
        // Lanes of a path are spread over the whole range, too.
        Lanes::from_fn(|lane| value(FIRST_NM + step * (lane * SETS + set) as f64) as f32)
    };
    let at = |set: usize, id: SpectrumId| lanes(set, &|nm| scene.spectra.get(id).at(nm));
    let indices = |set| Indices {
        outside: at(set, scene.medium(MediumId::OUTSIDE).n),
        n: at(set, n),
        k: k.map_or(Lanes::ZERO, |k| at(set, k)),
        primaries: scene.rgb.as_ref().map_or([Lanes::ZERO; 3], |rgb| rgb.primaries.map(|id| at(set, id))),
        weights: Lanes::from_fn(|lane| (eye(lane * SETS + set) / total) as f32),
    };
    (0..SETS).map(indices).collect()
}

/// Nanoseconds of one evaluation of eight lanes, the mean of the scene's interfaces; `None` without any.
pub fn nanoseconds(scene: &Scene) -> Option<f64> {
    let all: Vec<f64> =
        (0..scene.surfaces.len()).filter_map(|i| Interface::of(scene, i)).map(|i| i.nanoseconds()).collect();
    (!all.is_empty()).then(|| all.iter().sum::<f64>() / all.len() as f64)
}

/// The curves of every material that reflects by Fresnel's equations, in all variants in which it differs from the first.
///
/// Variants name the same materials in the same order, so that a surface is the same one in all.
pub fn curves(scenes: &[Scene], labels: &[String]) -> Vec<Curves> {
    let mut seen = BTreeSet::new();
    let first = scenes.first().map_or(&[][..], |scene| &scene.objects);
    let materials = first.iter().filter(|object| seen.insert(object.surface));
    let mut all = Vec::new();
    for object in materials {
        let interfaces: Vec<_> = scenes.iter().map(|scene| Interface::of(scene, object.surface as usize)).collect();
        let transparent = interfaces.iter().flatten().any(|interface| !interface.metal);
        all.extend(side(&object.material, From::Outside, &interfaces, labels, transparent));
        if transparent {
            all.extend(side(&object.material, From::Inside, &interfaces, labels, transparent));
        }
    }
    all
}

fn side(
    material: &str,
    from: From,
    interfaces: &[Option<Interface>],
    labels: &[String],
    transparent: bool,
) -> Option<Curves> {
    let title = match (transparent, from) {
        (false, _) => material.to_owned(),
        (true, From::Outside) => format!("{material}, from outside"),
        (true, From::Inside) => format!("{material}, from inside"),
    };
    let mut lines: Vec<Line> = Vec::new();
    for (variant, (interface, label)) in interfaces.iter().zip(labels).enumerate() {
        let Some(interface) = interface.as_ref().filter(|it| !it.metal || from == From::Outside) else { continue };
        let points = interface.curve(from);
        if variant == 0 || lines.first().is_none_or(|first| first.points != points) {
            lines.push(Line { variant, label: label.clone(), points });
        }
    }
    (!lines.is_empty()).then_some(Curves { title, lines })
}
