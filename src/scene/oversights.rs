//! What a scene says that is possible and was hardly meant.

use super::{Interface, Scene, Surface, listed};
use crate::geometry::{Bounds, Shape, ShapeId};
use crate::light::{Emitter, Environment, Point, Source};
use glam::{DVec3, Vec3};

/// Below this, metres, the colours of thin films show, which are left out.
const THIN: f64 = 20e-6;

/// A mesh that is not in the picture is far from it at so many times the camera's distance from what it looks at.
const FAR: f32 = 10.0;

/// How a scene's numbers are meant.
pub struct Measures {
    pub meters_per_unit: Option<f64>,
    /// What places are measured from.
    pub origin: DVec3,
    /// The point that the camera looks at, measured from there.
    pub look_at: Vec3,
}

/// Warnings of a scene whose parts are all resolved.
pub fn of(scene: &Scene, measures: &Measures) -> Vec<String> {
    let all = [
        lights_turned_away(scene),
        points_in_mirrors(scene),
        nothing_to_see(scene),
        thin_films(scene, measures),
        far_meshes(scene, measures),
    ];
    all.into_iter().flatten().collect()
}

fn surface(scene: &Scene, index: usize) -> &Surface {
    &scene.surfaces[scene.objects[index].surface as usize]
}

fn names(scene: &Scene, holds: impl Fn(usize) -> bool) -> Vec<&str> {
    (0..scene.objects.len()).filter(|&index| holds(index)).map(|index| scene.objects[index].name.as_str()).collect()
}

/// "is" or "are", for so many.
fn verb(names: &[&str]) -> &'static str {
    if names.len() == 1 { "is" } else { "are" }
}

/// Everything that light can do something to.
fn lit(scene: &Scene) -> impl Iterator<Item = (usize, Bounds)> + '_ {
    let shapes = scene.world.shapes().iter().enumerate();
    shapes.filter(|(index, _)| *surface(scene, *index) != Surface::Black).map(|(index, shape)| (index, shape.bounds()))
}

fn lights_turned_away(scene: &Scene) -> Option<String> {
    let away = |emitter: &&Emitter| match emitter.source {
        Source::Shape { id, two_sided: false } => turned_away(scene, id),
        Source::Point(point) => point.cone().is_some() && !lit(scene).any(|(_, bounds)| reaches(&point, &bounds)),
        _ => false,
    };
    let shining = scene.lights.emitters().iter().filter(|emitter| emitter.power > 0.0);
    let away: Vec<&str> = shining.filter(away).map(|emitter| name(scene, emitter)).collect();
    let verb = if away.len() == 1 { "shines" } else { "shine" };
    (!away.is_empty() && lit(scene).next().is_some()).then(|| {
        format!("{} {verb} away from everything: flat lights shine from their front, the side of their `normal`, unless `two_sided = true`", listed(&away))
    })
}

fn name<'a>(scene: &'a Scene, emitter: &Emitter) -> &'a str {
    match emitter.source {
        Source::Shape { id, .. } => &scene.object(id).name,
        _ => "a point light with a cone",
    }
}

/// Whether a flat light has all other things, and whoever sees it, behind it.
fn turned_away(scene: &Scene, id: ShapeId) -> bool {
    let light = &scene.world.shapes()[id.0 as usize];
    let (center, normal) = match light {
        Shape::Rectangle(rectangle) => (rectangle.center(), rectangle.normal()),
        Shape::Disk(disk) => (disk.center(), disk.normal()),
        _ => return false,
    };
    let in_front = |point: Vec3| (point - center).dot(normal) > 1e-5 * (point - center).length();
    let seen = in_front(scene.camera.position()) && scene.camera.may_see(&light.bounds());
    !seen && !lit(scene).any(|(other, bounds)| other != id.0 as usize && bounds.corners().into_iter().any(in_front))
}

/// Whether a cone of light may meet something in a box.
fn reaches(point: &Point, bounds: &Bounds) -> bool {
    let Some((axis, _, widest)) = point.cone() else { return true };
    let offset = (bounds.center() - point.position()).as_dvec3();
    let (distance, radius) = (offset.length(), f64::from(bounds.size().length()) / 2.0);
    distance <= radius || {
        let aside = libm::acos((axis.dot(offset) / distance).clamp(-1.0, 1.0));
        aside - libm::asin(radius / distance) <= widest
    }
}

fn points_in_mirrors(scene: &Scene) -> Option<String> {
    let points = scene.lights.emitters().iter().any(|emitter| matches!(emitter.source, Source::Point(_)));
    let smooth = names(scene, |index| surface(scene, index).is_smooth());
    // Where everything is smooth, point lights light nothing, which is told already.
    (points && !smooth.is_empty() && scene.surfaces.iter().any(Surface::scatters)).then(|| {
        format!(
            "{} {} smooth and {} no point light: a small sphere that shines is seen everywhere",
            listed(&smooth),
            verb(&smooth),
            if smooth.len() == 1 { "shows" } else { "show" }
        )
    })
}

fn nothing_to_see(scene: &Scene) -> Option<String> {
    let lamps = scene.lights.emitters().iter().any(|emitter| emitter.power > 0.0);
    let even = matches!(scene.lights.environment, Environment::Constant(_)) && !lamps;
    let colourless = |interface: &Interface| scene.medium(interface.medium).absorption.is_none();
    let clear = |index: usize| surface(scene, index).interface().is_some_and(colourless);
    let all = !scene.objects.is_empty() && (0..scene.objects.len()).all(clear);
    (even && all).then(|| {
        "everything here is clear, and the same light comes from all around: nothing can be seen of it, as in nature. Lamps, a gradient or a picture all around, or something dark show a stone".to_owned()
    })
}

fn thin_films(scene: &Scene, measures: &Measures) -> Option<String> {
    let metres = measures.meters_per_unit?;
    // Of a plate, its thickness; of a ball, a third of its diameter.
    let thickness = |shape: &Shape| 2.0 * shape.volume() / f64::from(shape.area()) * metres;
    let closed = |shape: &Shape| !matches!(shape, Shape::Mesh(placed) if placed.mesh().surroundings().open_edges > 0);
    let thin = |index: usize| {
        let shape = &scene.world.shapes()[index];
        let thickness = thickness(shape);
        surface(scene, index).is_clear() && closed(shape) && thickness > 0.0 && thickness < THIN
    };
    let films = names(scene, thin);
    (!films.is_empty()).then(|| {
        let verb = verb(&films);
        format!(
            "{} {verb} thinner than 20 µm: the colours that its two sides make together (interference) are left out",
            listed(&films)
        )
    })
}

fn far_meshes(scene: &Scene, measures: &Measures) -> Option<String> {
    let view = (measures.look_at - scene.camera.position()).length();
    let far = |index: usize| {
        let shape = &scene.world.shapes()[index];
        let bounds = shape.bounds();
        let aside = !scene.camera.may_see(&bounds) && bounds.distance_to(measures.look_at) > FAR * view;
        matches!(shape, Shape::Mesh(_)) && *surface(scene, index) != Surface::Black && aside
    };
    let first = (0..scene.objects.len()).find(|&index| far(index))?;
    let (far, bounds) = (names(scene, far), scene.world.shapes()[first].bounds());
    let center = bounds.center().as_dvec3() + measures.origin;
    let across = bounds.size().max_element();
    Some(format!(
        "{} {} far outside of the picture: `{}` is {across:.4} across, around {:.4}, {:.4}, {:.4}. Is its file in another unit, or another axis up?",
        listed(&far),
        verb(&far),
        scene.objects[first].name,
        center.x,
        center.y,
        center.z
    ))
}
