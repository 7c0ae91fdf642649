//! The shapes there are, and what all of them answer.

use glam::{Affine3A, Vec2, Vec3};

use super::ray::{Crossing, Met, Probe, Ray, Side, Surface};
use super::{Bounds, Convex, Disk, GeometryError, Placed, Rectangle, Sphere};

/// A ray that leaves a shape's surface. (With copies of origin and direction in it, what leaves a gem waited for them 4 % of its time.)
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaving<'a> {
    pub ray: &'a Ray,
    pub facet: u32,
    pub side: Side,
    /// As in [`Hit`](super::Hit).
    pub place: u32,
}

/// A shape in world space. A box is a [`Convex`] of six half-spaces.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    Sphere(Sphere),
    Rectangle(Rectangle),
    Disk(Disk),
    Convex(Box<Convex>),
    Mesh(Placed),
}

macro_rules! each {
    ($shape:expr, $s:ident => $e:expr) => {
        match $shape {
            Shape::Sphere($s) => $e,
            Shape::Rectangle($s) => $e,
            Shape::Disk($s) => $e,
            Shape::Convex($s) => $e,
            Shape::Mesh($s) => $e,
        }
    };
}

impl Shape {
    /// Whether it encloses a volume.
    pub fn is_solid(&self) -> bool {
        match self {
            Shape::Sphere(_) | Shape::Convex(_) => true,
            Shape::Mesh(s) => s.is_closed(),
            Shape::Rectangle(_) | Shape::Disk(_) => false,
        }
    }

    pub fn bounds(&self) -> Bounds {
        each!(self, s => s.bounds())
    }

    /// Scene units squared; of a flat shape, one side.
    pub fn area(&self) -> f32 {
        each!(self, s => s.area())
    }

    /// Scene units cubed; zero for what encloses nothing.
    pub fn volume(&self) -> f64 {
        match self {
            Shape::Sphere(s) => 4.0 / 3.0 * std::f64::consts::PI * f64::from(s.radius()).powi(3),
            Shape::Convex(s) => f64::from(s.volume()),
            Shape::Mesh(s) => s.volume(),
            Shape::Rectangle(_) | Shape::Disk(_) => 0.0,
        }
    }

    /// The shape under an affine map of world space. Fronts and outsides stay so under mirrors.
    pub fn transformed(&self, affine: &Affine3A) -> Result<Self, GeometryError> {
        Ok(match self {
            Shape::Sphere(s) => s.transformed(affine)?.into(),
            Shape::Rectangle(s) => s.transformed(affine)?.into(),
            Shape::Disk(s) => s.transformed(affine)?.into(),
            Shape::Convex(s) => s.transformed(affine)?.into(),
            Shape::Mesh(s) => s.transformed(affine)?.into(),
        })
    }

    /// The same to within rounding, but a copy shares with this shape what no map changes.
    pub fn copied(&self, affine: &Affine3A) -> Result<Self, GeometryError> {
        match self {
            Shape::Convex(s) => Ok(s.copied(affine)?.into()),
            _ => self.transformed(affine),
        }
    }

    /// Strictly inside a solid; never for flat shapes.
    pub fn contains(&self, point: Vec3) -> bool {
        match self {
            Shape::Sphere(s) => s.contains(point),
            Shape::Convex(s) => s.contains(point),
            Shape::Mesh(s) => s.contains(point),
            Shape::Rectangle(_) | Shape::Disk(_) => false,
        }
    }

    /// A ray that comes from elsewhere. What lies beyond `limit` need not be found.
    #[inline(always)]
    pub(super) fn meet(&self, probe: &Probe, limit: f32) -> Option<Crossing> {
        match self {
            Shape::Sphere(s) => s.meet(probe),
            Shape::Rectangle(s) => s.meet(probe),
            Shape::Disk(s) => s.meet(probe),
            Shape::Convex(s) => s.meet(probe),
            Shape::Mesh(s) => s.meet(probe, limit),
        }
    }

    /// Whether the shape is surely met before `limit`; of a mesh the facet `but` is not asked.
    #[inline]
    pub(super) fn hides(&self, probe: &Probe, limit: f32, but: Option<u32>) -> bool {
        match (self, but) {
            (Shape::Mesh(s), _) => s.hides(probe, limit, but),
            (_, Some(_)) => false,
            (_, None) => self.meet(probe, limit).is_some_and(|crossing| crossing.t + crossing.slack < limit),
        }
    }

    /// What a ray that leaves the shape meets of it again: from inside of a solid its exit, on a mesh anything. Flat shapes, and
    /// convex ones from outside, are not met again.
    #[inline]
    pub(super) fn again(&self, leaving: &Leaving, limit: f32) -> Option<Crossing> {
        let &Leaving { ray, side, .. } = leaving;
        match (self, side) {
            (Shape::Sphere(s), Side::Inside) => Some(s.exit(ray.origin, ray.direction)),
            (Shape::Convex(s), Side::Inside) => Some(s.exit(ray.origin, ray.direction)),
            (Shape::Mesh(s), _) => s.again(leaving, limit),
            _ => None,
        }
    }

    /// Whether a shape is surely in the way of a ray that leaves it; of a mesh the facet `but` is not asked.
    #[inline]
    pub(super) fn hides_again(&self, leaving: &Leaving, limit: f32, but: Option<u32>) -> bool {
        match (self, but) {
            (Shape::Mesh(s), _) => s.hides_again(leaving, limit, but),
            (_, Some(_)) => false,
            (_, None) => self.again(leaving, limit).is_some_and(|crossing| crossing.t + crossing.slack < limit),
        }
    }

    /// Point and normals where a ray arrives.
    #[inline]
    pub(super) fn surface(&self, near: Vec3, met: &Met) -> Surface {
        match self {
            Shape::Sphere(s) => s.surface(near),
            Shape::Rectangle(s) => s.surface(near),
            Shape::Disk(s) => s.surface(near),
            Shape::Convex(s) => s.surface(near, met.facet),
            Shape::Mesh(s) => s.surface(near, met),
        }
    }

    /// Whether its points have texture coordinates.
    pub fn has_uv(&self) -> bool {
        match self {
            Shape::Sphere(_) | Shape::Rectangle(_) | Shape::Disk(_) => true,
            Shape::Convex(_) => false,
            Shape::Mesh(s) => s.mesh().has_uv(),
        }
    }

    /// Texture coordinates, v upwards: of a sphere azimuth and height by angle, each over its range; of flat shapes the square
    /// around them.
    pub(super) fn uv(&self, point: Vec3, facet: u32) -> Option<Vec2> {
        match self {
            Shape::Sphere(s) => Some(s.uv(point)),
            Shape::Rectangle(s) => Some(s.flat.uv(point)),
            Shape::Disk(s) => Some(s.flat.uv(point)),
            Shape::Convex(_) => None,
            Shape::Mesh(s) => s.uv(point, facet),
        }
    }

    /// Largest distance of its points from its centre: what the rounding of a point on it is measured against.
    #[inline]
    pub(super) fn extent(&self) -> f32 {
        match self {
            Shape::Sphere(s) => s.radius(),
            Shape::Rectangle(s) => s.flat.u.length() + s.flat.v.length(),
            Shape::Disk(s) => s.flat.u.length() + s.flat.v.length(),
            Shape::Convex(s) => s.radius(),
            Shape::Mesh(s) => s.extent(),
        }
    }
}

impl From<Sphere> for Shape {
    fn from(sphere: Sphere) -> Self {
        Shape::Sphere(sphere)
    }
}

impl From<Rectangle> for Shape {
    fn from(rectangle: Rectangle) -> Self {
        Shape::Rectangle(rectangle)
    }
}

impl From<Disk> for Shape {
    fn from(disk: Disk) -> Self {
        Shape::Disk(disk)
    }
}

impl From<Convex> for Shape {
    fn from(convex: Convex) -> Self {
        Shape::Convex(Box::new(convex))
    }
}

impl From<Placed> for Shape {
    fn from(placed: Placed) -> Self {
        Shape::Mesh(placed)
    }
}
