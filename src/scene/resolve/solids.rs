//! Dielectric solids among each other: which fills the space where they overlap, and which can be traced alone.

use super::Resolver;
use crate::geometry::{Shape, ShapeId, World};
use crate::scene::{Inside, Interface, Object, Surface};
use glam::Vec3;

/// Pairs of objects that are named; of more, how many.
const PAIRS: usize = 3;

/// Points of a shape's surface that are looked at to tell whether it overlaps another one.
const POINTS: usize = 256;

impl Resolver<'_> {
    /// The boundary of a clear object; none of an opaque one.
    pub fn interface(&self, object: &Object) -> Option<Interface> {
        match self.surfaces[object.surface as usize] {
            Surface::Dielectric(interface) => Some(interface),
            _ => None,
        }
    }

    /// Works out how solids stand to each other, and warns where the scene does not say.
    pub fn solids(&mut self, world: &World, objects: &mut [Object]) {
        rank(world, objects, |object| self.interface(object).is_some());
        for index in 0..objects.len() {
            let Some(interface) = self.interface(&objects[index]) else { continue };
            let id = ShapeId(index as u32);
            let refracting = |object: &Object| self.interface(object).is_some();
            let shape = &world.shapes()[index];
            objects[index].touches =
                world.near(id).any(|(other, its)| refracting(&objects[other.0 as usize]) && shape.may_touch(its));
            let joined = objects[index].touches || objects[index].covers;
            let alone = matches!(shape, Shape::Convex(_)) && !joined && world.stands_alone(id);
            if alone && !interface.is_rough() {
                objects[index].inside = Inside::Alone;
            }
        }
        self.warn_of_overlaps(world, objects);
    }

    /// Media that contradict each other: two solids of different media fill the same space, and nothing says which is there.
    fn warn_of_overlaps(&mut self, world: &World, objects: &[Object]) {
        let mut told = Vec::new();
        for (index, object) in objects.iter().enumerate().filter(|(_, object)| object.touches) {
            let Some(medium) = self.interface(object).map(|interface| interface.medium) else { continue };
            for (other, its) in world.near(ShapeId(index as u32)).filter(|(other, _)| other.0 as usize > index) {
                let second = &objects[other.0 as usize];
                let differs = self.interface(second).is_some_and(|interface| interface.medium != medium);
                if differs && object.priority == second.priority && overlap(&world.shapes()[index], its) {
                    let (inner, outer) = if object.rank > second.rank { (object, second) } else { (second, object) };
                    let same = world.shapes()[index].volume() == its.volume();
                    let why = if same { "comes later" } else { "is the smaller one" };
                    told.push(format!(
                        "`{}` and `{}` overlap: where both are, `{}` fills the space, for it {why}; `priority` says otherwise",
                        outer.name, inner.name, inner.name
                    ));
                }
            }
        }
        self.warn_of_pairs(told, "pairs of solids overlap");
    }

    /// The first few of what is told of pairs of objects, and how many more there are.
    pub fn warn_of_pairs(&mut self, mut told: Vec<String>, what: &str) {
        let more = told.len().saturating_sub(PAIRS);
        told.truncate(PAIRS);
        self.warnings.append(&mut told);
        if more > 0 {
            self.warnings.push(format!("{more} more {what} like that"));
        }
    }
}

/// Ranks dielectrics: by priority, then the smaller before the larger, then the later one.
fn rank(world: &World, objects: &mut [Object], refracts: impl Fn(&Object) -> bool) {
    let mut order: Vec<usize> = (0..objects.len()).filter(|&index| refracts(&objects[index])).collect();
    let volumes: Vec<f64> = world.shapes().iter().map(Shape::volume).collect();
    order.sort_by(|&a, &b| {
        let by_size = || volumes[b].total_cmp(&volumes[a]);
        objects[a].priority.cmp(&objects[b].priority).then_with(by_size).then(a.cmp(&b))
    });
    for (rank, index) in (1..).zip(order) {
        objects[index].rank = rank;
    }
}

/// Whether one of two solids surely lies partly inside the other and partly outside.
fn overlap(a: &Shape, b: &Shape) -> bool {
    let parted = |points: Vec<Vec3>, solid: &Shape| {
        let size = solid.bounds().size().max_element();
        let inside = |p: &Vec3| solid.contains(*p) && !near_surface(solid, *p, 1e-4 * size);
        let outside = |p: &Vec3| !solid.contains(*p) && !near_surface(solid, *p, 1e-4 * size);
        points.iter().any(inside) && points.iter().any(outside)
    };
    parted(points(a), b) || parted(points(b), a)
}

/// Whether a step along an axis changes sides.
fn near_surface(solid: &Shape, point: Vec3, step: f32) -> bool {
    let inside = solid.contains(point);
    let steps = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| axis * step);
    steps.iter().any(|&step| solid.contains(point + step) != inside || solid.contains(point - step) != inside)
}

/// Points spread over the surface of a solid.
fn points(shape: &Shape) -> Vec<Vec3> {
    let from = shape.bounds().center();
    match shape {
        Shape::Convex(solid) => {
            let mean = |facet: u32| {
                let corners = solid.corners(facet);
                corners.iter().map(|&corner| solid.vertices()[corner as usize]).sum::<Vec3>() / corners.len() as f32
            };
            solid.vertices().iter().copied().chain((0..solid.facets().len() as u32).map(mean)).collect()
        }
        Shape::Mesh(placed) => placed.some_corners(POINTS).collect(),
        _ => (0..POINTS).filter_map(|i| on_sphere(shape, from, i)).collect(),
    }
}

/// Points of a golden spiral around a sphere.
fn on_sphere(shape: &Shape, center: Vec3, i: usize) -> Option<Vec3> {
    let Shape::Sphere(sphere) = shape else { return None };
    let z = 1.0 - (2 * i + 1) as f32 / POINTS as f32;
    let (sin, cos) = libm::sincosf(i as f32 * 2.399_963);
    let across = (1.0 - z * z).sqrt();
    Some(center + Vec3::new(across * cos, across * sin, z) * sphere.radius())
}
