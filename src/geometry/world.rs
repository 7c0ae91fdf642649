//! All shapes of a scene, and the two questions that are asked of them.

use glam::{Vec2, Vec3};

use super::escape::Few;
use super::ray::{Crossing, Departure, Hit, Met, Probe, Ray, ShapeId, Side, Surface, Target, sum_abs};
use super::shape::Leaving;
use super::tree::{BoxRay, Tree};
use super::{Bounds, GeometryError, Shape};

/// Shapes up to which a plain list is searched. Measured on a table-top scene, ns a ray, list against tree: 6 shapes 85
/// and 116, 8 shapes 137 and 117, 12 shapes 203 and 136.
const LIST: usize = 6;

/// Shapes in world space, in the order they were given.
#[derive(Clone, Debug)]
pub struct World {
    shapes: Vec<Shape>,
    /// Of each shape.
    solidity: Vec<Solidity>,
    bounds: Bounds,
    /// Largest extent of a shape.
    largest: f32,
    tree: Option<Tree>,
    pub(super) few: Option<Few>,
}

/// What the origin of each ray is judged by, which takes two roots for a flat shape.
#[derive(Clone, Copy, Debug, Default)]
struct Solidity {
    extent: f32,
    is_solid: bool,
}

/// The nearest crossing so far.
#[derive(Clone, Copy)]
struct Nearest {
    crossing: Crossing,
    shape: u32,
}

impl Nearest {
    #[inline]
    fn met(self) -> Met {
        let Crossing { t, side, facet, place, .. } = self.crossing;
        Met { t, shape: ShapeId(self.shape), side, facet, place }
    }
}

impl World {
    pub fn new(shapes: Vec<Shape>) -> Result<Self, GeometryError> {
        let max = (u32::MAX / 4) as usize;
        if shapes.len() > max {
            return Err(GeometryError::TooManyShapes { count: shapes.len(), max });
        }
        let boxes: Vec<Bounds> = shapes.iter().map(Shape::bounds).collect();
        let bounds = boxes.iter().fold(Bounds::EMPTY, |all, b| all.union(b));
        let tree = (shapes.len() > LIST).then(|| Tree::new(&boxes));
        let solidity = |shape: &Shape| Solidity { extent: shape.extent(), is_solid: shape.is_solid() };
        let solidity: Vec<Solidity> = shapes.iter().map(solidity).collect();
        let largest = solidity.iter().map(|shape| shape.extent).fold(0.0, f32::max);
        let few = Few::new(&boxes);
        Ok(Self { shapes, solidity, bounds, largest, tree, few })
    }

    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    pub fn shape(&self, id: ShapeId) -> Option<&Shape> {
        self.shapes.get(id.0 as usize)
    }

    /// The box around all shapes; empty if there are none.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// The nearest surface within `t_max`.
    ///
    /// Among surfaces at the same distance the first shape wins, whatever the tree looks like. A ray that departs into a
    /// solid finds the solid's exit before whatever touches it there.
    #[inline]
    pub fn closest(&self, ray: &Ray, t_max: f32) -> Option<Hit> {
        self.first(ray, &[], t_max).map(|met| self.surface(ray, &met))
    }

    /// The same for a ray that has left more than one surface at its origin: those of solids whose faces coincide there.
    #[inline]
    pub fn closest_beyond(&self, ray: &Ray, also: &[Departure], t_max: f32) -> Option<Hit> {
        self.first(ray, also, t_max).map(|met| self.surface(ray, &met))
    }

    /// What [`Self::closest_beyond`] finds, before its surface is looked at.
    #[inline]
    pub fn first(&self, ray: &Ray, also: &[Departure], t_max: f32) -> Option<Met> {
        let probe = self.probe(ray);
        let mut limit = t_max.min(f32::MAX);
        let mut best: Option<Nearest> = None;
        let departed = departed(ray);
        // Not by an iterator over all of them: to put it together took longer than a node.
        let mut leave = |departs| {
            if let Some((shape, leaving)) = leaving(ray, departs)
                && let Some(again) = self.shape(shape).and_then(|own| own.again(&leaving, limit))
                && again.t <= limit
            {
                best = Some(Nearest { crossing: again, shape: shape.0 });
                // Strictly less: what touches the solid at its exit comes after it.
                limit = if again.side == Side::Inside { again.t - again.slack } else { again.t };
            }
        };
        leave(ray.departs);
        also.iter().for_each(|&departs| leave(departs));
        let asked = |shape: u32| shape != departed && !is_among(also, shape);
        match &self.tree {
            None => {
                for (shape, own) in (0..).zip(&self.shapes).filter(|&(shape, _)| asked(shape)) {
                    (best, limit) = nearer(&probe, (shape, own), best, limit);
                }
            }
            Some(tree) => {
                let boxes = BoxRay::new(ray.origin, ray.direction, probe.origin_error);
                tree.visit(&boxes, limit, |shape, limit| {
                    let own = &self.shapes[shape as usize];
                    let (found, limit) =
                        if asked(shape) { nearer(&probe, (shape, own), best, limit) } else { (best, limit) };
                    best = found;
                    limit
                })
            }
        }
        best.map(Nearest::met)
    }

    /// Whether anything lies between the ray's origin and the point `t_max` away.
    ///
    /// For a shadow ray to a point sampled on a shape, give its facet as `target`: a convex shape never hides its own point,
    /// since [`Shape::sample_toward`] only gives points that it does not hide, and a facet of a mesh does not hide itself.
    /// Surfaces that may touch the end point, to within rounding, do not hide it either; so `t_max` is the distance and needs
    /// no shortening.
    pub fn occluded(&self, ray: &Ray, t_max: f32, target: Option<Target>) -> bool {
        let limit = t_max.min(f32::MAX);
        if !(limit > 0.0) {
            return false;
        }
        let but = |shape: u32| target.filter(|target| target.shape.0 == shape).map(|target| target.facet);
        if let Some((shape, leaving)) = leaving(ray, ray.departs)
            && self.shape(shape).is_some_and(|own| own.hides_again(&leaving, limit, but(shape.0)))
        {
            return true;
        }
        let probe = self.probe(ray);
        let departed = departed(ray);
        let mut hidden = false;
        match &self.tree {
            None => {
                hidden =
                    (0..self.shapes.len() as u32).any(|shape| self.hides(shape, departed, &probe, limit, but(shape)))
            }
            Some(tree) => {
                tree.visit(&BoxRay::new(ray.origin, ray.direction, probe.origin_error), limit, |shape, limit| {
                    hidden = self.hides(shape, departed, &probe, limit, but(shape));
                    if hidden { -1.0 } else { limit }
                })
            }
        }
        hidden
    }

    /// In its callers: called as a closure from both of them it took 2 % of the time of a path among metals.
    #[inline(always)]
    fn hides(&self, shape: u32, departed: u32, probe: &Probe, limit: f32, but: Option<u32>) -> bool {
        shape != departed && self.shapes[shape as usize].hides(probe, limit, but)
    }

    /// Texture coordinates of a hit, v upwards; none where the shape has none.
    pub fn uv(&self, hit: &Hit) -> Option<Vec2> {
        self.shape(hit.shape)?.uv(hit.point, hit.facet)
    }

    /// The next surface along a ray that coincides, up to rounding, with the last one that was met
    /// at a place, `far`; those `before` it are not met again.
    ///
    /// It is looked for along the ray that has found the first one. A ray from there would have to judge anew which surface is
    /// still to come: one that this ray meets later by a hair, that one could take for passed, and then nobody crosses it.
    /// `also` as in [`Self::closest_beyond`].
    pub fn beside(&self, ray: &Ray, also: &[Departure], far: &Hit, before: &[Hit]) -> Option<Hit> {
        let within = |extent: f32| far.t + self.rounding(ray, far, extent);
        let asked = |shape: ShapeId| shape != far.shape && before.iter().all(|hit| hit.shape != shape);
        let mut best = self.first_within(ray, also, within, asked);
        // Two solids of one mesh may touch each other.
        if let Some(Shape::Mesh(mesh)) = self.shape(far.shape) {
            let side = far.side.opposite();
            let &Hit { facet, place, .. } = far;
            let from_there = Ray::free(far.point, ray.direction);
            let again = mesh.again(&Leaving { ray: &from_there, facet, side, place }, within(mesh.extent()) - far.t);
            let again = again.map(|crossing| Crossing { t: far.t + crossing.t, ..crossing });
            best = self.sooner(best, far.shape, again, within);
        }
        best.map(|nearest| self.surface(ray, &nearest.met()))
    }

    /// The first of some surfaces, in their order, that coincides up to rounding with what a ray
    /// has met, from however far it came. `also` as in [`Self::closest_beyond`].
    pub fn upon(&self, ray: &Ray, also: &[Departure], met: &Hit, among: &[ShapeId]) -> Option<Hit> {
        let within = |extent: f32| met.t + self.rounding(ray, met, extent + met.t);
        let first = self.first_within(ray, also, within, |shape| among.binary_search(&shape).is_ok());
        first.map(|nearest| self.surface(ray, &nearest.met()))
    }

    /// The first of the surfaces that are `asked`, no farther away than `within` allows a shape of
    /// an extent.
    fn first_within(
        &self,
        ray: &Ray,
        also: &[Departure],
        within: impl Fn(f32) -> f32,
        asked: impl Fn(ShapeId) -> bool,
    ) -> Option<Nearest> {
        let probe = self.probe(ray);
        let departed = departed(ray);
        let mut best: Option<Nearest> = None;
        self.visit(ray, &probe, within(self.largest), |shape, limit| {
            if shape != departed && !is_among(also, shape) && asked(ShapeId(shape)) {
                let crossing = self.shapes[shape as usize].meet(&probe, limit);
                best = self.sooner(best, ShapeId(shape), crossing, &within);
            }
            limit
        });
        for (shape, leaving) in all_left(ray, also).filter(|&(shape, _)| asked(shape)) {
            let again = self.shape(shape).and_then(|own| own.again(&leaving, within(own.extent())));
            best = self.sooner(best, shape, again, &within);
        }
        best
    }

    /// The best so far or one more crossing, if that is near enough and comes before it.
    fn sooner(
        &self,
        best: Option<Nearest>,
        ShapeId(shape): ShapeId,
        crossing: Option<Crossing>,
        within: impl Fn(f32) -> f32,
    ) -> Option<Nearest> {
        let near = crossing.filter(|crossing| crossing.t <= within(self.extent(ShapeId(shape))));
        let Some(crossing) = near else { return best };
        let before = |b: &Nearest| (b.crossing.t, b.shape) <= (crossing.t, shape);
        if best.as_ref().is_some_and(before) { best } else { Some(Nearest { crossing, shape }) }
    }

    /// Whether a hit is at the origin of its ray, up to rounding.
    pub fn is_at_origin(&self, ray: &Ray, hit: &Hit) -> bool {
        hit.t <= self.rounding(ray, hit, self.extent(hit.shape))
    }

    /// Whether a hit is where a shadow ray ends, `t_max` away on a target, up to rounding.
    pub fn is_at_end(&self, ray: &Ray, hit: &Hit, t_max: f32, target: Target) -> bool {
        t_max - hit.t <= self.rounding(ray, hit, self.extent(target.shape) + hit.t)
    }

    /// How far along a ray rounding can move a hit against that with a surface of an extent.
    fn rounding(&self, ray: &Ray, hit: &Hit, extent: f32) -> f32 {
        let coordinates = 2.0 * sum_abs(hit.point) + self.extent(hit.shape);
        16.0 * f32::EPSILON * (coordinates + extent) / hit.normal.dot(ray.direction).abs().max(0.01)
    }

    fn extent(&self, shape: ShapeId) -> f32 {
        self.solidity(shape).extent
    }

    #[inline]
    fn solidity(&self, shape: ShapeId) -> Solidity {
        self.solidity.get(shape.0 as usize).copied().unwrap_or_default()
    }

    /// The shapes whose boxes meet a box, in their order.
    pub(super) fn meeting(&self, bounds: &Bounds) -> Vec<ShapeId> {
        let mut found = match &self.tree {
            Some(tree) => tree.near(bounds),
            None => (0..self.shapes.len() as u32).collect(),
        };
        found.retain(|&shape| self.shapes[shape as usize].bounds().padded().meets(bounds));
        found.sort_unstable();
        found.into_iter().map(ShapeId).collect()
    }

    /// Shows candidates to `each`, which takes and returns the farthest distance of interest.
    #[inline]
    fn visit(&self, ray: &Ray, probe: &Probe, limit: f32, mut each: impl FnMut(u32, f32) -> f32) {
        match &self.tree {
            Some(tree) => tree.visit(&BoxRay::new(ray.origin, ray.direction, probe.origin_error), limit, each),
            None => {
                let mut limit = limit;
                for shape in 0..self.shapes.len() as u32 {
                    limit = each(shape, limit);
                    if limit < 0.0 {
                        return;
                    }
                }
            }
        }
    }

    /// A hit point is good to a few roundings of its coordinates and of the size of its shape; a free one is what it says.
    #[inline]
    fn probe<'a>(&self, ray: &'a Ray) -> Probe<'a> {
        let (origin_error, leaves_solid) = match ray.departs {
            Departure::Free => (0.0, false),
            Departure::Surface { shape, side, .. } => {
                (self.origin_error(ray.origin, shape), self.solidity(shape).is_solid && side == Side::Outside)
            }
        };
        Probe { ray, origin_error, leaves_solid }
    }

    /// How far an origin on a shape may be off.
    #[inline]
    pub(super) fn origin_error(&self, origin: Vec3, shape: ShapeId) -> f32 {
        4.0 * f32::EPSILON * (sum_abs(origin) + self.extent(shape))
    }

    /// Point and normals of what a ray has met in this world.
    #[inline]
    pub fn surface(&self, ray: &Ray, met: &Met) -> Hit {
        let &Met { t, shape, side, facet, place } = met;
        let near = ray.origin + ray.direction * t;
        let Surface { point, normal, shading } = self.shapes[shape.0 as usize].surface(near, met);
        Hit { t, shape, side, facet, place, point, normal, shading }
    }
}

/// What is nearest, and how far away at most, once one more shape has been asked.
///
/// By values and in its caller, as they stay in registers then: a structure that is written field by field and read whole is not
/// forwarded, and waiting for it took a tenth of a camera's ray with its surface.
#[inline(always)]
fn nearer(probe: &Probe, (shape, own): (u32, &Shape), best: Option<Nearest>, limit: f32) -> (Option<Nearest>, f32) {
    let Some(crossing) = own.meet(probe, limit) else { return (best, limit) };
    // `limit` is the best distance or, at first, the farthest allowed: a tie goes to the lower number.
    let tie = best.is_some_and(|b| crossing.t == b.crossing.t && b.shape < shape);
    if tie || !(crossing.t <= limit) {
        return (best, limit);
    }
    (Some(Nearest { crossing, shape }), crossing.t)
}

/// The shapes that a ray leaves, and how.
#[inline]
fn all_left<'a>(ray: &'a Ray, also: &[Departure]) -> impl Iterator<Item = (ShapeId, Leaving<'a>)> {
    leaving(ray, ray.departs).into_iter().chain(also.iter().filter_map(|&departs| leaving(ray, departs)))
}

#[inline]
fn is_among(departures: &[Departure], shape: u32) -> bool {
    departures.iter().any(|departs| matches!(departs, Departure::Surface { shape: left, .. } if left.0 == shape))
}

#[inline]
fn leaving(ray: &Ray, departs: Departure) -> Option<(ShapeId, Leaving<'_>)> {
    match departs {
        Departure::Free => None,
        Departure::Surface { shape, facet, side, place } => Some((shape, Leaving { ray, facet, side, place })),
    }
}

/// The shape that the search leaves out, if any: the one departed from. (What is met of it again is looked for on its own.)
#[inline]
fn departed(ray: &Ray) -> u32 {
    match ray.departs {
        Departure::Free => u32::MAX,
        Departure::Surface { shape, .. } => shape.0,
    }
}
