//! The interfaces of a scene as a report shows them: how much each reflects against the angle, and what asking costs.
//!
//! By the very kernels that render, in the eight lanes of a path; the scene's outside medium is on the other side.

use crate::fresnel::{Fitted, FresnelModel, Ready, Specimen, Target};
use crate::math::{LANES, Lanes};
use crate::report::comparison::{Curves, Line};
use crate::report::timing::{self, BRIEF};
use crate::scene::{MediumId, Metal, Scene, Surface};
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

/// What reflects by Fresnel's equations, or by a model of them: seen from outside, for each set of wavelengths with what the eye makes
/// of each; all sets together sum to 1.
struct Interface {
    sets: Vec<(Ready<LANES>, Lanes<LANES>)>,
    metal: bool,
}

impl Interface {
    /// `None` if the surface is none.
    fn of(scene: &Scene, surface: usize) -> Option<Self> {
        match *scene.surfaces.get(surface)? {
            Surface::Conductor(Metal { n, k, model, .. }) => {
                let specimen = scene.metal([n, k], MediumId::OUTSIDE);
                Some(Self::new(scene, fitted(scene, model, specimen)?, specimen, true))
            }
            Surface::Dielectric(interface) => {
                let boundary = scene.boundary(MediumId::OUTSIDE, interface.medium);
                let model = fitted(scene, interface.model, boundary)?;
                if scene.medium(interface.medium).k.is_some() {
                    return Some(Self::new(scene, model, boundary, true));
                }
                let [outside, inside] =
                    [MediumId::OUTSIDE, interface.medium].map(|id| scene.spectra.get(scene.medium(id).n));
                Some(Self::new(scene, model, Specimen::clear(outside, inside), false))
            }
            Surface::Black | Surface::Diffuse(_) => None,
        }
    }

    fn new(scene: &Scene, model: Fitted, specimen: Specimen, metal: bool) -> Self {
        let step = (LAST_NM - FIRST_NM) / (SETS * LANES - 1) as f64;
        let eye = |nm: f64| scene.picture.observer.at(nm)[1];
        let total: f64 = (0..SETS * LANES).map(|i| eye(FIRST_NM + step * i as f64)).sum();
        let set = |set: usize| {
            // Lanes of a path are spread over the whole range, too.
            let nm = std::array::from_fn(|lane| FIRST_NM + step * (lane * SETS + set) as f64);
            let lanes = |value: &dyn Fn(f64) -> f64| Lanes(nm.map(|nm| value(nm) as f32));
            let primary = |id| lanes(&|nm| scene.spectra.get(id).at(nm));
            let primaries = scene.rgb.as_ref().map_or([Lanes::ZERO; 3], |rgb| rgb.primaries.map(primary));
            (Ready::new(model, &specimen, &nm, primaries, !metal), lanes(&|nm| eye(nm) / total))
        };
        Self { sets: (0..SETS).map(set).collect(), metal }
    }

    /// Points (degrees, reflectance weighted by what the eye makes of each wavelength).
    fn curve(&self, from: From) -> Vec<[f64; 2]> {
        let seen = |ready: &Ready<LANES>| if from == From::Outside { *ready } else { ready.from_inside() };
        let sets: Vec<_> = self.sets.iter().map(|(ready, weights)| (seen(ready), *weights)).collect();
        let luminous = |cos_theta_i: f32| -> f64 {
            sets.iter().map(|(ready, weights)| f64::from((ready.reflectance(cos_theta_i) * *weights).sum())).sum()
        };
        let at = |degrees: f64| [degrees, luminous(libm::cos(degrees.to_radians()).max(0.0) as f32)];
        (0..=180).map(|half| at(f64::from(half) / 2.0)).collect()
    }
}

/// `None` of an RGB model in a scene without their colours, which `resolve` never makes.
fn fitted(scene: &Scene, model: FresnelModel, specimen: Specimen) -> Option<Fitted> {
    match model {
        FresnelModel::Spectral(model) => Some(Fitted::Spectral(model)),
        FresnelModel::Rgb(_) => Some(Fitted::new(model, &Target::new(specimen, &scene.rgb.as_ref()?.meter))),
    }
}

/// Nanoseconds of one evaluation of eight lanes, the mean of the scene's interfaces; `None` without any.
pub fn nanoseconds(scene: &Scene) -> Option<f64> {
    let interfaces = (0..scene.surfaces.len()).filter_map(|i| Interface::of(scene, i));
    let all: Vec<f64> = interfaces.map(|interface| timing::nanoseconds(&interface.sets[0].0, BRIEF)).collect();
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
