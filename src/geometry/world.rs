//! All shapes of a scene, and the two questions that are asked of them.

use glam::Vec2;

use super::ray::{Crossing, Departure, Hit, Probe, Ray, ShapeId, Side, sum_abs};
use super::tree::{BoxRay, Tree};
use super::{Bounds, GeometryError, Shape};

/// Shapes up to which a plain list is searched. Measured on a table-top scene, ns a ray, list against tree: 6 shapes 85
/// and 116, 8 shapes 137 and 117, 12 shapes 203 and 136.
const LIST: usize = 6;

/// Shapes in world space, in the order they were given.
#[derive(Clone, Debug)]
pub struct World {
    shapes: Vec<Shape>,
    bounds: Bounds,
    tree: Option<Tree>,
}

/// The nearest crossing so far.
#[derive(Clone, Copy)]
struct Nearest {
    crossing: Crossing,
    shape: u32,
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
        Ok(Self { shapes, bounds, tree })
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
    pub fn closest(&self, ray: &Ray, t_max: f32) -> Option<Hit> {
        let probe = self.probe(ray);
        let mut limit = t_max.min(f32::MAX);
        let mut best: Option<Nearest> = None;
        let departed = departed(ray);
        if let Some((id, exit)) = self.exit(ray)
            && exit.t <= limit
        {
            best = Some(Nearest { crossing: exit, shape: id });
            // Strictly less: what touches the solid at its exit comes after it.
            limit = exit.t - exit.slack;
        }
        self.visit(ray, &probe, limit, |shape, limit| {
            if shape == departed {
                return limit;
            }
            let Some(crossing) = self.shapes[shape as usize].meet(&probe) else { return limit };
            if !(crossing.t <= limit) {
                return limit;
            }
            // `limit` is the best distance or, at first, the farthest allowed: a tie goes to the lower number.
            if let Some(b) = best
                && crossing.t == b.crossing.t
                && b.shape < shape
            {
                return limit;
            }
            best = Some(Nearest { crossing, shape });
            crossing.t
        });
        best.map(|nearest| self.hit(ray, nearest))
    }

    /// Whether anything lies between the ray's origin and the point `t_max` away.
    ///
    /// For a shadow ray to a point sampled on a shape, give the shape as `target`: it never hides its own point, since
    /// [`Shape::sample_toward`] only gives points that the convex shape itself does not hide. Surfaces that may touch the
    /// end point, to within rounding, do not hide it either; so `t_max` is the distance and needs no shortening.
    pub fn occluded(&self, ray: &Ray, t_max: f32, target: Option<ShapeId>) -> bool {
        let limit = t_max.min(f32::MAX);
        if !(limit > 0.0) {
            return false;
        }
        let target = target.map_or(u32::MAX, |id| id.0);
        if let Some((id, exit)) = self.exit(ray)
            && id != target
            && exit.t + exit.slack < limit
        {
            return true;
        }
        let probe = self.probe(ray);
        let departed = departed(ray);
        let mut hidden = false;
        self.visit(ray, &probe, limit, |shape, limit| {
            if shape == departed || shape == target {
                return limit;
            }
            match self.shapes[shape as usize].meet(&probe) {
                Some(crossing) if crossing.t + crossing.slack < limit => {
                    hidden = true;
                    -1.0
                }
                _ => limit,
            }
        });
        hidden
    }

    /// Texture coordinates of a hit, v upwards; none where the shape has none.
    pub fn uv(&self, hit: &Hit) -> Option<Vec2> {
        self.shape(hit.shape)?.uv(hit.point, hit.facet)
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

    /// The exit of the solid that the ray sets off into, if it does.
    #[inline]
    fn exit(&self, ray: &Ray) -> Option<(u32, Crossing)> {
        match ray.departs {
            Departure::Surface { shape, side: Side::Inside } => {
                let exit = self.shape(shape)?.exit(ray.origin, ray.direction)?;
                Some((shape.0, exit))
            }
            _ => None,
        }
    }

    /// A hit point is good to a few roundings of its coordinates and of the size of its shape.
    #[inline]
    fn probe(&self, ray: &Ray) -> Probe {
        let shape = match ray.departs {
            Departure::Free => None,
            Departure::Surface { shape, side } => self.shape(shape).map(|s| (s, side)),
        };
        let extent = shape.map_or(0.0, |(s, _)| s.extent());
        Probe {
            origin: ray.origin,
            direction: ray.direction,
            origin_error: 4.0 * f32::EPSILON * (sum_abs(ray.origin) + extent),
            leaves_solid: shape.is_some_and(|(s, side)| s.is_solid() && side == Side::Outside),
        }
    }

    fn hit(&self, ray: &Ray, nearest: Nearest) -> Hit {
        let Crossing { t, side, facet, .. } = nearest.crossing;
        let near = ray.origin + ray.direction * t;
        let (point, normal) = self.shapes[nearest.shape as usize].surface(near, facet);
        Hit { t, shape: ShapeId(nearest.shape), side, facet, point, normal }
    }
}

/// The shape that cannot be met again, if any: the one departed from. (Its exit is looked for on its own.)
#[inline]
fn departed(ray: &Ray) -> u32 {
    match ray.departs {
        Departure::Free => u32::MAX,
        Departure::Surface { shape, .. } => shape.0,
    }
}
