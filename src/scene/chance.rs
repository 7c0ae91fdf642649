//! Light that paths meet by chance, because nothing aims at it that way, and how bright it is.
//!
//! Shadow rays go straight to a light. By way of a smooth mirror or glass, and to the camera itself, light comes only along paths that
//! happen to meet the lamp: what such a path brings is the lamp's whole radiance, and a lamp that is small and bright is found by one path
//! in many. A render that has not met it yet knows nothing of it, so whoever promises an error has to add what may have been missed
//! (`adaptive::bound`). No path brings more than the brightest light that has such a way; [`Chance`] is that bound.
//!
//! On a surface of roughness α a light of solid angle Ω is aimed at, but only within the lobe: one sample brings at most
//! F D / 4 · L Ω ≈ L Ω / (4 π α²) (GGX at its peak, B. Walter et al. 2007, equation 33); at grazing angles up to twice that. So sharp lobes
//! count as L · min(1, Ω / (2 π α²)). What goes through a rough surface is bent less than it is tilted: there the lobe is as sharp as that of
//! α (η − 1)/(√2 η) (the same, equation 17). Wide lobes and matt surfaces count as what they send on: L · min(1, Ω / π), for a bounce may find
//! a small place that is lit.

use super::{Decision, MediumId, Object, Pattern, Scene, Surface, listed};
use crate::bsdf::conductor::MIRROR_ALPHA;
use crate::geometry::{Bounds, Shape, ShapeId};
use crate::light::{Emitter, Environment, Source};
use crate::spectrum::{Density, Nodes, Spectrum, SpectrumId, Xyz, radiance_xyz};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, SQRT_2};

/// From this α on, lobes are wide enough to be met by one path in a few: what they bring is found like the light on a matt surface.
const WIDE: f64 = 0.15;

/// Of more lamps it is not asked how far they are from what they light: each may be next to it.
const FEW: usize = 64;

/// The most that one path brings along by a way that nothing aims at.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chance {
    /// XYZ in cd/m²; 0 where nothing shines.
    pub brightest: Xyz,
    /// What shines so, and which way it comes, for people.
    pub way: String,
}

/// The bound of a scene whose wavelengths are chosen by a density, and the reason.
pub fn of(scene: &Scene, wavelengths: &Density) -> (Chance, Decision) {
    let look = Look { scene, lobes: Lobes::of(scene), radiances: radiances(scene, wavelengths), dense: dense(scene) };
    let chance = look.brightest().map(|way| way.told(&look)).unwrap_or_default();
    let enclosed = enclosed(scene);
    let reason = match (chance.way.as_str(), enclosed.as_slice()) {
        ("", []) => "nothing shines on anything".into(),
        (way, []) => way.to_owned(),
        (way, enclosed) => format!("no shadow ray ever reaches {}; {way}", enclosed.join(", ")),
    };
    let used = !chance.way.is_empty();
    (chance, Decision { part: "light by chance", used, reason })
}

/// Largest XYZ in cd/m² that a sample may see of each spectrum that shines. Where few of the wavelengths show a line, they count for the
/// others too: two standard deviations of what one set of wavelengths tells are added.
fn radiances(scene: &Scene, wavelengths: &Density) -> BTreeMap<SpectrumId, Xyz> {
    let (observer, nodes) = (&scene.picture.observer, Nodes::new(wavelengths));
    let shining = scene.lights.emitters().iter().map(|emitter| emitter.radiance).chain(around(scene));
    let ids: BTreeSet<SpectrumId> = shining.collect();
    let (mut kinds, mut all) = (Vec::<(&Spectrum, Xyz)>::new(), BTreeMap::new());
    for id in ids {
        // Lamps of one kind differ in their strength only.
        let spectrum = scene.spectra.get(id);
        let kind = spectrum.unscaled();
        let known = kinds.iter().find(|(known, _)| *known == kind).map(|(_, xyz)| *xyz);
        let xyz = known.unwrap_or_else(|| {
            let uneven = 1.0 + 2.0 * nodes.variance(kind, observer).sqrt();
            let xyz = radiance_xyz(kind, observer).map(|c| c * uneven);
            kinds.push((kind, xyz));
            xyz
        });
        all.insert(id, xyz.map(|c| c * spectrum.factor()));
    }
    all
}

/// Spectra of surroundings that are constant or a gradient, which are found by the directions that surfaces choose.
fn around(scene: &Scene) -> Vec<SpectrumId> {
    match scene.lights.environment {
        Environment::Dark | Environment::Map(_) => vec![],
        Environment::Constant(id) => vec![id],
        Environment::Gradient { nadir, horizon, zenith } => vec![nadir, horizon, zenith],
    }
}

fn sum(xyz: &Xyz) -> f64 {
    xyz.iter().sum()
}

impl Chance {
    /// The brighter one of two; the first if they are equal.
    pub fn brighter(self, other: Self) -> Self {
        if sum(&other.brightest) > sum(&self.brightest) { other } else { self }
    }
}

/// The surfaces that show lights, sharply or as a glow.
struct Lobes<'a> {
    smooth: Vec<&'a str>,
    /// Those of the sharpest lobe of the others; its α is infinite if there are none.
    rough: Vec<&'a str>,
    alpha: f64,
    /// Whether anything scatters more widely.
    wide: bool,
}

impl<'a> Lobes<'a> {
    fn of(scene: &'a Scene) -> Self {
        let all: Vec<_> = (0..)
            .zip(&scene.objects)
            .filter_map(|(id, object)| Some((object.name.as_str(), alpha(scene, ShapeId(id), object)?)))
            .collect();
        let least = all
            .iter()
            .map(|(_, alpha)| *alpha)
            .filter(|alpha| *alpha > 0.0 && *alpha < WIDE)
            .fold(f64::INFINITY, f64::min);
        let with = |wanted: f64| all.iter().filter(|(_, alpha)| *alpha == wanted).map(|(name, _)| *name).collect();
        let scatters = |object: &Object| scene.surfaces[object.surface as usize] != Surface::Black;
        Self { smooth: with(0.0), rough: with(least), alpha: least, wide: scene.objects.iter().any(scatters) }
    }

    /// Share of its radiance that a light of a solid angle (sr) brings by a rough surface.
    fn share(&self, solid_angle: f64) -> f64 {
        (solid_angle / (2.0 * PI * self.alpha * self.alpha)).min(1.0)
    }
}

/// The α of the sharpest lobe of an object's surface, 0 if it is smooth; `None` if it has no lobe.
fn alpha(scene: &Scene, id: ShapeId, object: &Object) -> Option<f64> {
    let (own, sharper) = match scene.surfaces[object.surface as usize] {
        Surface::Black | Surface::Diffuse(_) => return None,
        Surface::Conductor(metal) => (metal.alpha, 1.0),
        Surface::Dielectric(interface) => {
            let eta = least_contrast(scene, id, interface.medium);
            (interface.alpha, ((1.0 - 1.0 / eta) / SQRT_2).max(THINNEST))
        }
    };
    let least = match scene.patterns.get(&object.surface) {
        Some(Pattern { alpha: Some(alphas), .. }) => alphas.all().iter().copied().fold(own, f32::min),
        _ => own,
    };
    Some(if least < MIRROR_ALPHA { 0.0 } else { f64::from(least) * sharper })
}

/// The smallest ratio, above 1, of the indices of a solid's medium and of another that it may stand in or touch.
fn least_contrast(scene: &Scene, id: ShapeId, medium: MediumId) -> f64 {
    let beside = scene.world.near(id).filter_map(|(other, _)| {
        let surface = &scene.surfaces[scene.object(other).surface as usize];
        surface.interface().map(|interface| interface.medium)
    });
    let own = index(scene, medium);
    let others = beside.chain([MediumId::OUTSIDE]).filter(|other| *other != medium).map(|other| index(scene, other));
    others.map(|other| (own / other).max(other / own)).fold(f64::INFINITY, f64::min)
}

/// What is looked at.
struct Look<'a> {
    scene: &'a Scene,
    lobes: Lobes<'a>,
    radiances: BTreeMap<SpectrumId, Xyz>,
    dense: f64,
}

/// Index of refraction of a medium in the middle of the visible.
fn index(scene: &Scene, medium: MediumId) -> f64 {
    scene.spectra.get(scene.medium(medium).n).at(MIDDLE_NM)
}

const MIDDLE_NM: f64 = 550.0;

/// How much sharper the lobe through a rough surface is taken to be at most.
const THINNEST: f64 = 0.1;

/// How much more radiance there is where the camera stands than where a lamp may be: the square of their indices.
fn dense(scene: &Scene) -> f64 {
    let around = &scene.around_camera;
    let fillings = around.all.iter().chain(around.some.iter().map(|(_, filling)| filling));
    let seen_from =
        fillings.map(|filling| index(scene, filling.medium)).fold(index(scene, MediumId::OUTSIDE), f64::max);
    let media = (0..scene.media.len()).map(|medium| index(scene, MediumId(medium as u16)));
    let ratio = seen_from / media.fold(seen_from, f64::min);
    ratio * ratio
}

/// How a light comes by chance.
struct Way<'a> {
    /// None for the surroundings.
    emitter: Option<&'a Emitter>,
    brightest: Xyz,
    is_seen: bool,
    /// Whether smooth surfaces, or else rough ones, show it.
    by_smooth: bool,
    by_rough: bool,
    by_matt: bool,
}

impl<'a> Look<'a> {
    fn brightest(&self) -> Option<Way<'a>> {
        let shining = self.scene.lights.emitters().iter().filter(|emitter| emitter.power > 0.0);
        let ways = shining.filter_map(|emitter| self.way(emitter)).chain(self.surroundings());
        ways.reduce(|a, b| if sum(&b.brightest) > sum(&a.brightest) { b } else { a })
    }

    fn way(&self, emitter: &'a Emitter) -> Option<Way<'a>> {
        let Light { radiance, solid_angle, is_met } = self.light(emitter);
        let is_seen = is_seen(self.scene, emitter);
        let by_smooth = is_met && !self.lobes.smooth.is_empty();
        let by_rough = !by_smooth && !self.lobes.rough.is_empty();
        let by_matt = !is_seen && !by_smooth && !by_rough && self.lobes.wide;
        let share = match (is_seen || by_smooth, by_rough, by_matt) {
            (true, ..) => 1.0,
            (false, true, _) => self.lobes.share(solid_angle),
            (false, false, true) => (solid_angle / PI).min(1.0),
            (false, false, false) => return None,
        };
        let brightest = radiance.map(|c| c * share * self.dense);
        Some(Way { emitter: Some(emitter), brightest, is_seen, by_smooth, by_rough, by_matt })
    }

    fn surroundings(&self) -> Option<Way<'a>> {
        let brightest =
            around(self.scene).iter().map(|id| self.radiances[id]).max_by(|a, b| sum(a).total_cmp(&sum(b)))?;
        let by_smooth = !self.lobes.smooth.is_empty();
        let brightest = brightest.map(|c| c * self.dense);
        Some(Way { emitter: None, brightest, is_seen: true, by_smooth, by_rough: false, by_matt: false })
    }

    /// A point is taken for a tiny disk that gives as much light.
    fn light(&self, emitter: &Emitter) -> Light {
        let (scene, radiance) = (self.scene, self.radiances[&emitter.radiance]);
        match (emitter.source, &scene.lights.environment) {
            (Source::Shape { id, .. }, _) => {
                let covered = scene.world.shape(id).map(|shape| covered(shape, distance(scene, &shape.bounds())));
                Light { radiance, solid_angle: covered.unwrap_or(PI), is_met: true }
            }
            (Source::Sun(sun), _) => Light { radiance, solid_angle: sun.projected_solid_angle(), is_met: true },
            (Source::Point(point), _) => {
                let near = NEAR * f64::from(scene.world.bounds().size().length());
                let irradiance = point.irradiance(distance(scene, &Bounds::of([point.position()])).max(near));
                Light { radiance: radiance.map(|c| c * irradiance / POINT), solid_angle: POINT, is_met: false }
            }
            (Source::Map, Environment::Map(map)) => {
                let brightest = map.brightest();
                let radiance = radiance.map(|c| c * brightest);
                Light { radiance, solid_angle: map.chosen() / brightest, is_met: true }
            }
            (Source::Map, _) => Light { radiance, solid_angle: PI, is_met: true },
        }
    }
}

impl Way<'_> {
    fn told(self, look: &Look) -> Chance {
        let lobes = &look.lobes;
        let ways = [
            (self.is_seen, "into the camera".to_owned()),
            (self.by_smooth, format!("by way of smooth {}", listed(&lobes.smooth))),
            (self.by_rough, format!("by way of rough {}", listed(&lobes.rough))),
            (self.by_matt, "by way of what it lights".to_owned()),
        ];
        let ways: Vec<String> = ways.into_iter().filter_map(|(comes, way)| comes.then_some(way)).collect();
        let name = self.emitter.map_or("the light of the surroundings".into(), |emitter| name(look.scene, emitter));
        let luminance = self.brightest[1];
        let way = format!("{name}, up to {luminance:.0} cd/m² a path, comes {}", ways.join(" and "));
        Chance { brightest: self.brightest, way }
    }
}

/// An emitter where it is largest.
struct Light {
    /// XYZ in cd/m².
    radiance: Xyz,
    /// What it covers at most, sr.
    solid_angle: f64,
    /// Whether a path can meet it.
    is_met: bool,
}

/// Largest projected solid angle of a lamp whose middle is so far from what it lights, sr: that of a ball around it, or of the disk around a
/// flat one.
fn covered(shape: &Shape, distance: f64) -> f64 {
    let around = f64::from(shape.bounds().size().length()) / 2.0;
    let (square, away) = (around * around, distance * distance);
    match shape {
        Shape::Rectangle(_) => PI * square / (square + away),
        // The box around a disk has twice its square.
        Shape::Disk(disk) => {
            let square = f64::from(disk.area()) / PI;
            PI * square / (square + away)
        }
        Shape::Sphere(sphere) => {
            let square = f64::from(sphere.radius()) * f64::from(sphere.radius());
            PI * square / away.max(square)
        }
        Shape::Convex(_) | Shape::Mesh(_) => PI * square / away.max(square),
    }
}

/// Solid angle that a point is given, sr: less than any lobe has.
const POINT: f64 = 1e-9;

/// Nearer than this part of the scene's size no point light is taken to be to what it lights.
const NEAR: f64 = 0.02;

fn name(scene: &Scene, emitter: &Emitter) -> String {
    match emitter.source {
        Source::Shape { id, .. } => format!("`{}`", scene.object(id).name),
        Source::Sun(_) => "the sun".into(),
        Source::Point(_) => "a point light".into(),
        Source::Map => "the brightest texel of the surroundings".into(),
    }
}

/// From the middle of a light to what reflects it, at least.
fn distance(scene: &Scene, light: &Bounds) -> f64 {
    if scene.lights.emitters().len() > FEW {
        return 0.0;
    }
    let reflecting = scene.objects.iter().zip(scene.world.shapes());
    let reflecting = reflecting.filter(|(object, _)| scene.surfaces[object.surface as usize] != Surface::Black);
    reflecting.map(|(_, shape)| f64::from(shape.bounds().distance_to(light.center()))).fold(f64::INFINITY, f64::min)
}

/// Whether the camera itself may look at an emitter, were nothing in between.
fn is_seen(scene: &Scene, emitter: &Emitter) -> bool {
    match emitter.source {
        Source::Shape { id, .. } => scene.world.shape(id).is_some_and(|shape| scene.camera.may_see(&shape.bounds())),
        Source::Sun(sun) => scene.camera.may_see_toward(sun.toward(), sun.half_angle()),
        Source::Point(_) => false,
        Source::Map => true,
    }
}

/// Lamps that stand inside of clear solids, each with one of them: whatever is outside has no straight way to them.
fn enclosed(scene: &Scene) -> Vec<String> {
    let inside = |id: ShapeId| {
        let center = scene.world.shape(id)?.bounds().center();
        let (outer, _) = scene.world.near(id).find(|(other, its)| {
            scene.surfaces[scene.object(*other).surface as usize].is_clear() && its.contains(center)
        })?;
        Some(format!("`{}`, which is inside of `{}`", scene.object(id).name, scene.object(outer).name))
    };
    let lamps = scene.lights.emitters().iter().filter_map(|emitter| match emitter.source {
        Source::Shape { id, .. } if emitter.power > 0.0 => Some(id),
        _ => None,
    });
    lamps.filter_map(inside).take(FEW_NAMED).collect()
}

/// Lamps that are named.
const FEW_NAMED: usize = 3;

#[cfg(test)]
mod tests {
    use super::super::{Overrides, Text, resolve};
    use super::*;
    use crate::spectrum::Library;

    const CAMERA: &str = "meters_per_unit = 0.01\ncamera = { position = [0, -5, 2], look_at = [0, 0, 0], fov = 20 }\n\
        materials.grey.diffuse.reflectance = 0.5\n\
        [[objects]]\nmaterial = \"grey\"\nshape.rectangle = { size = [9, 9] }\n";

    const LAMP: &str = "[[objects]]\nname = \"lamp\"\nshape.sphere = { radius = 0.1, center = [0, 0, 4] }\n\
        emission = { spectrum = \"D65\", luminance = 1000 }\n";

    fn chance(more: &str) -> (Chance, Decision) {
        in_medium("", more)
    }

    fn in_medium(outside: &str, more: &str) -> (Chance, Decision) {
        let text = Text::new("scene.toml", format!("{outside}{CAMERA}{LAMP}{more}"));
        let scene = resolve(text, &Library::new(Vec::new()), &Overrides::default());
        of(&scene.unwrap_or_else(|error| panic!("{error}")), &Density::visible())
    }

    fn luminance(more: &str) -> f64 {
        chance(more).0.brightest[1]
    }

    #[test]
    fn a_lamp_out_of_view_over_matt_things_is_as_bright_as_what_it_lights() {
        let (chance, _) = chance("");
        // Its ball of radius 0.1 stands 4 over the floor.
        assert!((chance.brightest[1] / (1000.0 * 0.01 / 16.0) - 1.0).abs() < 0.15, "{chance:?}");
        assert!(chance.way.contains("by way of what it lights"), "{chance:?}");
    }

    #[test]
    fn smooth_things_and_the_view_show_a_lamp_as_bright_as_it_is() {
        let gold = "[[objects]]\nmaterial = \"gold\"\nshape.sphere = { radius = 0.5, center = [0, 0, 0.5] }\n";
        let in_view = "[[objects]]\nname = \"other\"\nshape.sphere = { radius = 0.1, center = [0, 0, 0.5] }\n\
            emission = { spectrum = \"D65\", luminance = 1000 }\n";
        for more in [gold, in_view] {
            // One set of wavelengths is off by some per cent.
            assert!((1000.0..1150.0).contains(&luminance(more)), "{more}: {}", luminance(more));
        }
        assert!(chance(gold).0.way.contains("by way of smooth object"), "{:?}", chance(gold));
        assert!(chance(in_view).0.way.contains("`other`") && chance(in_view).0.way.contains("into the camera"));
    }

    /// The lamp's ball of radius 0.1 stands 3.4 above the sphere's box: π (0.1 / 3.4)² / (2 π α²) of its luminance.
    #[test]
    fn sharp_lobes_bring_what_the_lamp_fills_of_them() {
        let satin = |alpha: f64| {
            format!(
                "[materials.satin.conductor]\nior = \"Au/olmon-2012-evaporated\"\nroughness = {alpha}\n\
                 [[objects]]\nmaterial = \"satin\"\nshape.sphere = {{ radius = 0.3, center = [0, 0, 0.3] }}\n"
            )
        };
        let expected = luminance(&satin(0.01)) * 0.01 / (3.4 * 3.4 * 2.0 * 0.05 * 0.05);
        assert!((luminance(&satin(0.05)) / expected - 1.0).abs() < 1e-3, "{} {expected}", luminance(&satin(0.05)));
        // Wide lobes count as matt.
        assert!(luminance(&satin(0.3)) < 0.01 * luminance(&satin(0.05)));
    }

    /// The lobe through glass of 1.5 is α (1 − 1/1.5)/√2 wide in air, and in a liquid of 1.25 half of that: four times as much comes by it.
    #[test]
    fn rough_glass_is_sharper_in_a_liquid() {
        let frosted = "[materials.liquid.dielectric]\nior = 1.25\n[materials.frost.dielectric]\nior = 1.5\nroughness = 0.3\n\
            [[objects]]\nmaterial = \"frost\"\nshape.sphere = { radius = 0.3, center = [0, 0, 0.4] }\n";
        let [air, liquid] = ["", "outside = \"liquid\"\n"].map(|outside| in_medium(outside, frosted).0.brightest[1]);
        assert!((liquid / air / 4.0 - 1.0).abs() < 1e-3, "{air} {liquid}");
    }

    #[test]
    fn what_no_shadow_ray_reaches_is_named() {
        let bulb =
            "[[objects]]\nname = \"bulb\"\nmaterial = \"bk7\"\nshape.sphere = { radius = 0.5, center = [0, 0, 4] }\n";
        let (_, decision) = chance(bulb);
        assert!(
            decision.reason.contains("no shadow ray ever reaches `lamp`, which is inside of `bulb`"),
            "{decision:?}"
        );
    }
}
