//! Which physics a scene uses, and why: what it does not need is neither loaded nor run.

use super::chance::{self, Chance};
use super::{Inside, Interface, MediumId, Object, Pattern, Physics, Scene, Surface, lighting};
use crate::bsdf::conductor::MIRROR_ALPHA;
use crate::fresnel::FresnelModel;
use crate::fresnel::absorbing::LEAST_K;
use crate::geometry::ShapeId;
use crate::light::{Environment, FEW};
use crate::spectrum::Density;
use serde::Serialize;

/// What the renderer runs for a scene.
#[derive(Debug)]
pub struct Needs {
    /// How wavelengths are chosen.
    pub wavelength_density: Density,
    /// What a kernel must be able to do.
    pub physics: Physics,
    /// Whether anything takes its colour from a picture.
    pub pictures: bool,
    /// The most that one path may find that nothing aims at.
    pub chance: Chance,
    pub decisions: Vec<Decision>,
}

/// One part of the physics: whether it runs, and the reason.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Decision {
    pub part: &'static str,
    pub used: bool,
    pub reason: String,
}

impl Needs {
    pub fn of(scene: &Scene) -> Self {
        let (wavelength_density, wavelengths) = lighting::wavelengths(scene);
        let (chance, by_chance) = chance::of(scene, &wavelength_density);
        let decisions = vec![
            wavelengths,
            dispersion(scene),
            stones(scene),
            absorption(scene),
            complex_index(scene),
            immersion(scene),
            contact(scene),
            microfacets(scene),
            approximations(scene),
            textures(scene),
            light_sampling(scene),
            light_tree(scene),
            environment(scene),
            by_chance,
        ];
        Self { wavelength_density, physics: physics(scene), pictures: pictures(scene), chance, decisions }
    }
}

fn decision(part: &'static str, used: bool, reason: impl Into<String>) -> Decision {
    Decision { part, used, reason: reason.into() }
}

fn physics(scene: &Scene) -> Physics {
    let any = |holds: &dyn Fn(&Surface) -> bool| !objects_with(scene, holds).is_empty();
    let varies = scene.patterns.values().any(|pattern| pattern.alpha.is_some());
    let rough = |surface: &Surface| varies || surface.is_rough();
    let metal = |surface: &Surface| matches!(surface, Surface::Conductor(_)) && rough(surface);
    let glass = |surface: &Surface| surface.is_clear() && rough(surface);
    [
        (Physics::LIGHT_SAMPLING, light_sampling(scene).used),
        (Physics::ROUGH_METAL, any(&metal)),
        (Physics::TEXTURES, textures(scene).used),
        (Physics::APPROXIMATIONS, approximations(scene).used),
        (Physics::CLEAR_MEDIA, any(&Surface::is_clear)),
        (Physics::ABSORPTION, absorption(scene).used),
        (Physics::COMPLEX_INDEX, complex_index(scene).used),
        (Physics::DISPERSION, dispersion(scene).used),
        (Physics::CONTACT, contact(scene).used),
        (Physics::ROUGH_GLASS, any(&glass)),
    ]
    .into_iter()
    .filter_map(|(part, needed)| needed.then_some(part))
    .collect()
}

/// Names of the objects for which something holds, for people.
fn objects_with(scene: &Scene, holds: impl Fn(&Surface) -> bool) -> Vec<&str> {
    let has = |object: &&super::Object| holds(&scene.surfaces[object.surface as usize]);
    scene.objects.iter().filter(has).map(|object| object.name.as_str()).collect()
}

/// Names in a sentence: the first few and how many more.
pub fn listed(names: &[&str]) -> String {
    match names {
        [] => "nothing".into(),
        [one] => (*one).into(),
        [a, b, c, _, rest @ ..] => format!("{a}, {b}, {c} and {} more", rest.len() + 1),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

fn dispersion(scene: &Scene) -> Decision {
    let smooth_somewhere = |object: &Object, interface: &Interface| match scene.patterns.get(&object.surface) {
        Some(Pattern { alpha: Some(alphas), .. }) => alphas.all().iter().any(|alpha| *alpha < MIRROR_ALPHA),
        _ => !interface.is_rough(),
    };
    let disperses = |object: &&Object| match &scene.surfaces[object.surface as usize] {
        Surface::Dielectric(interface) if smooth_somewhere(object, interface) => {
            scene.medium(interface.medium).dispersive || scene.medium(MediumId::OUTSIDE).dispersive
        }
        _ => false,
    };
    match scene.objects.iter().filter(disperses).map(|object| object.name.as_str()).collect::<Vec<_>>() {
        names if names.is_empty() => {
            decision("dispersion", false, "no smooth dielectric's index changes with wavelength")
        }
        names => decision(
            "dispersion",
            true,
            format!("the index changes with wavelength in {}: lanes part there", listed(&names)),
        ),
    }
}

fn stones(scene: &Scene) -> Decision {
    let interface = |object: &Object| scene.surfaces[object.surface as usize].interface();
    let smooth = |object: &&Object| interface(object).is_some_and(|interface| !interface.is_rough());
    let parts = |object: &&Object| {
        interface(object).is_some_and(|interface| {
            let disperses = |medium| scene.medium(medium).dispersive;
            scene.settings.lanes == 1 || disperses(interface.medium) || disperses(MediumId::OUTSIDE)
        })
    };
    let alone = scene.objects.iter().filter(|object| object.inside == Inside::Alone).filter(smooth).filter(parts);
    match alone.map(|object| object.name.as_str()).collect::<Vec<_>>() {
        names if names.is_empty() => {
            decision("stone kernel", false, "no smooth convex solid with nothing in it in which lanes part")
        }
        names => {
            let reason = format!("nothing reaches into {}: traced facet by facet, all lanes at once", listed(&names));
            decision("stone kernel", true, reason)
        }
    }
}

fn absorption(scene: &Scene) -> Decision {
    let names: Vec<&str> =
        scene.media.iter().filter(|medium| medium.absorption.is_some()).map(|medium| medium.name.as_str()).collect();
    match names.is_empty() {
        true => decision("absorption", false, "every medium is clear"),
        false => decision("absorption", true, format!("along the path (Beer–Lambert) in {}", listed(&names))),
    }
}

fn complex_index(scene: &Scene) -> Decision {
    let names: Vec<&str> =
        scene.media.iter().filter(|medium| medium.k.is_some()).map(|medium| medium.name.as_str()).collect();
    match names.is_empty() {
        true => decision("k in reflection", false, format!("no medium has k > {LEAST_K}: R moves by less than 1e-6")),
        false => decision("k in reflection", true, format!("Fresnel's equations with n + ik in {}", listed(&names))),
    }
}

fn immersion(scene: &Scene) -> Decision {
    let outside = scene.medium(MediumId::OUTSIDE);
    match outside.name.as_str() {
        "vacuum" => decision("outside medium", false, "n = 1 around everything"),
        name => decision("outside medium", true, format!("everything is in {name}")),
    }
}

fn contact(scene: &Scene) -> Decision {
    const PART: &str = "media in contact";
    match [order(scene), covered(scene)].into_iter().flatten().collect::<Vec<_>>() {
        reasons if reasons.is_empty() => {
            decision(PART, false, "no two clear solids can touch or overlap, and nothing opaque lies on a clear face")
        }
        reasons => decision(PART, true, reasons.join("; ")),
    }
}

/// Solids that may touch or overlap, in the order in which they fill the space.
fn order(scene: &Scene) -> Option<String> {
    let mut touching: Vec<&Object> = scene.objects.iter().filter(|object| object.touches).collect();
    touching.sort_by_key(|object| std::cmp::Reverse(object.rank));
    let names: Vec<&str> = touching.iter().map(|object| object.name.as_str()).collect();
    let what = "each boundary is asked for another one at its place; where they overlap, first comes first";
    (!names.is_empty()).then(|| format!("{what}: {}", names.join(", ")))
}

/// What opaque lies on which faces.
fn covered(scene: &Scene) -> Option<String> {
    let name = |id: &ShapeId| scene.object(*id).name.as_str();
    let on = |(solid, lying): (&ShapeId, &Vec<ShapeId>)| {
        let lying: Vec<&str> = lying.iter().map(name).collect();
        format!("{} on {}", listed(&lying), name(solid))
    };
    let all: Vec<String> = scene.covers.iter().map(on).collect();
    let names: Vec<&str> = all.iter().map(String::as_str).collect();
    let what = "light meets what is opaque before the clear face that it lies on";
    (!names.is_empty()).then(|| format!("{what}: {}", listed(&names)))
}

fn microfacets(scene: &Scene) -> Decision {
    match objects_with(scene, Surface::is_rough) {
        names if names.is_empty() => decision("microfacets", false, "no rough conductor or dielectric"),
        names => decision("microfacets", true, format!("rough: {}", listed(&names))),
    }
}

fn approximations(scene: &Scene) -> Decision {
    let of = |surface: &Surface| surface.model().filter(|model| *model != FresnelModel::EXACT);
    let mut models: Vec<FresnelModel> = scene.surfaces.iter().filter_map(of).collect();
    let in_rgb = models.iter().any(|model| matches!(model, FresnelModel::Rgb(_)));
    models.sort_by_key(|model| model.name());
    models.dedup();
    let names: Vec<&str> = models.iter().map(|model| model.name()).collect();
    match names.is_empty() {
        true => decision("approximate Fresnel", false, "every interface is exact"),
        false => {
            let on = listed(&objects_with(scene, |surface| of(surface).is_some()));
            let spread = if in_rgb { ", RGB spread over wavelengths by three smooth reflectances" } else { "" };
            decision("approximate Fresnel", true, format!("{} on {on}{spread}", names.join(", ")))
        }
    }
}

fn light_sampling(scene: &Scene) -> Decision {
    let shining = scene.lights.emitters().iter().filter(|emitter| emitter.power > 0.0).count();
    match (shining, objects_with(scene, Surface::scatters).is_empty()) {
        (0, _) => decision("light sampling", false, "nothing shines that could be aimed at"),
        (_, true) => {
            decision("light sampling", false, "every surface is smooth: its one direction finds the light or not")
        }
        (1, false) => decision("light sampling", true, "one light shines on surfaces that scatter"),
        (count, false) => decision("light sampling", true, format!("{count} lights shine on surfaces that scatter")),
    }
}

fn light_tree(scene: &Scene) -> Decision {
    match scene.lights.in_tree() {
        0 => {
            let reason =
                format!("not more than {FEW} lights have a place: there is little to choose, and power tells enough");
            decision("light tree", false, reason)
        }
        count => {
            let reason = format!("{count} lights, more than {FEW}: chosen by power, distance and direction");
            decision("light tree", true, reason)
        }
    }
}

fn pictures(scene: &Scene) -> bool {
    let printed = scene.patterns.values().any(|pattern| pattern.reflectance.is_some());
    printed || matches!(scene.lights.environment, Environment::Map(_))
}

fn textures(scene: &Scene) -> Decision {
    let mut files: Vec<&str> = scene.patterns.values().flat_map(|pattern| &pattern.files).map(String::as_str).collect();
    files.sort_unstable();
    files.dedup();
    let on = scene.objects.iter().filter(|object| scene.patterns.contains_key(&object.surface));
    match on.map(|object| object.name.as_str()).collect::<Vec<_>>() {
        names if names.is_empty() => decision("textures", false, "no picture lies on a surface"),
        names => decision("textures", true, format!("{} on {}, bilinear", listed(&files), listed(&names))),
    }
}

fn environment(scene: &Scene) -> Decision {
    match &scene.lights.environment {
        Environment::Dark => decision("environment", false, "none"),
        Environment::Constant(_) => {
            decision("environment", true, "constant: found by the directions that surfaces choose")
        }
        Environment::Gradient { .. } => {
            decision("environment", true, "gradient: found by the directions that surfaces choose")
        }
        Environment::Map(map) => {
            let [width, height] = map.size();
            let reason = format!("picture of {width} × {height} texels: its bright ones are aimed at as lights are");
            decision("environment", true, reason)
        }
    }
}
