//! Whether one shape reaches into another, or only touches it.
//!
//! All shapes here are convex, and meshes are made of triangles, which are; two convex sets do not share inner points just when some direction separates them. Likely
//! directions are tried: axes, the line of centres, a few steps of Gilbert's algorithm (E. G. Gilbert, SIAM J. Control 4, 1966), facet
//! normals, and more such steps. If none is found the answer is "may".

use glam::DVec3;

use super::{Shape, ShapeId, World};

/// Shapes are stored in single precision, and so exact to that: in units of a rounding of their coordinates, bodies that meet may seem
/// to overlap by this much,
const MEETING: f64 = 4.0;

/// and those that are this much apart have room between them.
const ROOM: f64 = -16.0;

/// Steps of Gilbert's algorithm; each one costs two support points.
const STEPS: usize = 64;

/// Those of them that come before the facets' normals.
const FIRST_STEPS: usize = 12;

/// A convex body: a shape of this room that is convex, or a triangle of a mesh.
#[derive(Clone, Copy)]
enum Body<'a> {
    Shape(&'a Shape),
    Triangle(&'a [DVec3; 3]),
}

impl Shape {
    /// Whether the surface of `other` may lie inside this solid. False only if it surely does not: the two are apart, touch
    /// from outside (a stone on a table, facets in common), or this solid lies wholly within `other`. False for flat
    /// shapes, which have no inside; always true for meshes that are closed.
    ///
    /// If it is false for all other shapes of a world, light inside this solid can be traced with the solid alone.
    pub fn may_touch_inside(&self, other: &Shape) -> bool {
        match (self, other) {
            (Shape::Mesh(_), _) => self.is_solid(),
            (_, Shape::Mesh(mesh)) => {
                let reaches = |triangle: &[DVec3; 3]| !Body::Shape(self).apart(&Body::Triangle(triangle), MEETING);
                self.is_solid() && mesh.any_triangle_near(&self.bounds(), reaches)
            }
            _ => {
                let (own, its) = (Body::Shape(self), Body::Shape(other));
                self.is_solid() && !own.apart(&its, MEETING) && !own.within(other, MEETING)
            }
        }
    }

    /// Whether the surfaces of two shapes may have points in common. False only if they surely have none: one is outside of the
    /// other, or within it, with room between. Of two meshes only the boxes are looked at.
    pub fn may_touch(&self, other: &Shape) -> bool {
        if !self.bounds().padded().meets(&other.bounds().padded()) {
            return false;
        }
        let (own, its) = (Body::Shape(self), Body::Shape(other));
        match (self, other) {
            (Shape::Mesh(_), Shape::Mesh(_)) => true,
            (Shape::Mesh(mesh), solid) | (solid, Shape::Mesh(mesh)) => {
                let solid_body = Body::Shape(solid);
                let touches = |triangle: &[DVec3; 3]| {
                    let within = triangle.iter().all(|corner| solid.contains(corner.as_vec3()));
                    !within && !solid_body.apart(&Body::Triangle(triangle), ROOM)
                };
                mesh.any_triangle_near(&solid.bounds().padded(), touches)
            }
            _ => !(own.apart(&its, ROOM) || own.within(other, ROOM) || its.within(self, ROOM)),
        }
    }
}

impl Body<'_> {
    /// Whether some direction separates the two, but for an overlap of some roundings.
    fn apart(&self, other: &Body, roundings: f64) -> bool {
        let tolerance = roundings * f32::EPSILON as f64 * (self.extent() + other.extent());
        let separates = |axis: DVec3| {
            let length = axis.length();
            length > 0.0 && self.reach(axis) + other.reach(-axis) <= tolerance * length
        };
        let either = |axis: DVec3| separates(axis) || separates(-axis);
        let centers = other.center() - self.center();
        let mut nearest = centers;
        // A few steps first: most stones beside each other are apart, and have more facets than that.
        [DVec3::X, DVec3::Y, DVec3::Z, centers].into_iter().any(either)
            || self.steps_part(other, &mut nearest, FIRST_STEPS, separates)
            || self.normals().into_iter().chain(other.normals()).any(either)
            || self.steps_part(other, &mut nearest, STEPS - FIRST_STEPS, separates)
    }

    /// Returns whether a direction separates the two on the way to the point of {b − a} nearest to zero, which gives the best one.
    /// `nearest` is how far the way has come.
    fn steps_part(&self, other: &Body, nearest: &mut DVec3, steps: usize, separates: impl Fn(DVec3) -> bool) -> bool {
        for _ in 0..steps {
            if separates(*nearest) {
                return true;
            }
            let support = other.farthest(-*nearest) - self.farthest(*nearest);
            let step = support - *nearest;
            let length2 = step.length_squared();
            if !(length2 > 0.0) {
                return false;
            }
            *nearest += step * (-nearest.dot(step) / length2).clamp(0.0, 1.0);
        }
        false
    }

    /// Whether this body surely lies within a solid, its surface included, but for some roundings.
    fn within(&self, other: &Shape, roundings: f64) -> bool {
        match other {
            Shape::Rectangle(_) | Shape::Disk(_) | Shape::Mesh(_) => false,
            Shape::Convex(outer) => {
                let center = outer.center().as_dvec3();
                let slack = roundings * f32::EPSILON as f64 * (center.abs().max_element() + outer.radius() as f64);
                let mut facets = outer.facets().iter();
                facets.all(|f| {
                    let normal = f.normal.as_dvec3();
                    self.reach(normal) - normal.dot(center) <= f.offset as f64 + slack
                })
            }
            Shape::Sphere(outer) => {
                let (center, radius) = (outer.center().as_dvec3(), outer.radius() as f64);
                let far = match self {
                    Body::Shape(Shape::Sphere(s)) => (s.center().as_dvec3() - center).length() + s.radius() as f64,
                    Body::Shape(Shape::Convex(s)) => {
                        s.vertices().iter().map(|v| (v.as_dvec3() - center).length()).fold(0.0, f64::max)
                    }
                    _ => return false,
                };
                far <= radius + roundings * f32::EPSILON as f64 * (center.abs().max_element() + radius)
            }
        }
    }

    /// Largest coordinate of its points.
    fn extent(&self) -> f64 {
        match self {
            Body::Shape(s) => s.bounds().min.abs().max(s.bounds().max.abs()).max_element() as f64,
            Body::Triangle(corners) => corners.iter().map(|c| c.abs().max_element()).fold(0.0, f64::max),
        }
    }

    fn center(&self) -> DVec3 {
        match self {
            Body::Shape(s) => s.bounds().center().as_dvec3(),
            Body::Triangle([a, b, c]) => (*a + *b + *c) / 3.0,
        }
    }

    /// Largest axis·p over its points.
    fn reach(&self, axis: DVec3) -> f64 {
        match self {
            Body::Shape(Shape::Sphere(s)) => axis.dot(s.center().as_dvec3()) + s.radius() as f64 * axis.length(),
            _ => axis.dot(self.farthest(axis)),
        }
    }

    /// A point of it that lies farthest along the axis; of a mesh, of its box.
    fn farthest(&self, axis: DVec3) -> DVec3 {
        let extreme = |points: &mut dyn Iterator<Item = DVec3>| {
            points.max_by(|a, b| axis.dot(*a).total_cmp(&axis.dot(*b))).unwrap_or(self.center())
        };
        let shape = match self {
            Body::Triangle(corners) => return extreme(&mut corners.iter().copied()),
            Body::Shape(shape) => shape,
        };
        match shape {
            Shape::Sphere(s) => s.center().as_dvec3() + axis.normalize_or_zero() * s.radius() as f64,
            Shape::Rectangle(s) => {
                let [c, u, v] = [s.flat.center, s.flat.u, s.flat.v].map(|p| p.as_dvec3());
                c + u * axis.dot(u).signum() + v * axis.dot(v).signum()
            }
            Shape::Disk(s) => {
                let [c, u, v] = [s.flat.center, s.flat.u, s.flat.v].map(|p| p.as_dvec3());
                let (a, b) = (axis.dot(u), axis.dot(v));
                let length = (a * a + b * b).sqrt();
                if length > 0.0 { c + (u * a + v * b) / length } else { c }
            }
            Shape::Convex(s) => extreme(&mut s.vertices().iter().map(|v| v.as_dvec3())),
            Shape::Mesh(s) => extreme(&mut s.bounds().corners().into_iter().map(|v| v.as_dvec3())),
        }
    }

    fn normals(&self) -> Vec<DVec3> {
        match self {
            Body::Triangle([a, b, c]) => vec![(*b - *a).cross(*c - *a)],
            Body::Shape(Shape::Rectangle(s)) => vec![s.flat.normal.as_dvec3()],
            Body::Shape(Shape::Disk(s)) => vec![s.flat.normal.as_dvec3()],
            Body::Shape(Shape::Convex(s)) => s.facets().iter().map(|f| f.normal.as_dvec3()).collect(),
            Body::Shape(Shape::Sphere(_) | Shape::Mesh(_)) => Vec::new(),
        }
    }
}

impl World {
    /// The other shapes whose boxes meet that of a shape.
    pub fn near(&self, id: ShapeId) -> impl Iterator<Item = (ShapeId, &Shape)> {
        let near = self.shape(id).map_or_else(Vec::new, |shape| self.meeting(&shape.bounds().padded()));
        near.into_iter().filter(move |&other| other != id).filter_map(|other| Some((other, self.shape(other)?)))
    }

    /// Whether light inside the given solid can be traced with the solid alone: it is a solid, and nothing else reaches
    /// into it.
    pub fn stands_alone(&self, id: ShapeId) -> bool {
        self.shape(id)
            .is_some_and(|solid| solid.is_solid() && self.near(id).all(|(_, other)| !solid.may_touch_inside(other)))
    }
}
