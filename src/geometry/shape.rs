//! The shapes there are, and what all of them answer.

use glam::{Affine3A, Vec2, Vec3};

use super::ray::{Crossing, Probe};
use super::{Bounds, Convex, Disk, GeometryError, Rectangle, Sphere};

/// A shape in world space. A box is a [`Convex`] of six half-spaces.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    Sphere(Sphere),
    Rectangle(Rectangle),
    Disk(Disk),
    Convex(Box<Convex>),
}

macro_rules! each {
    ($shape:expr, $s:ident => $e:expr) => {
        match $shape {
            Shape::Sphere($s) => $e,
            Shape::Rectangle($s) => $e,
            Shape::Disk($s) => $e,
            Shape::Convex($s) => $e,
        }
    };
}

impl Shape {
    /// Whether it encloses a volume.
    pub fn is_solid(&self) -> bool {
        matches!(self, Shape::Sphere(_) | Shape::Convex(_))
    }

    pub fn bounds(&self) -> Bounds {
        each!(self, s => s.bounds())
    }

    /// Scene units squared; of a flat shape, one side.
    pub fn area(&self) -> f32 {
        each!(self, s => s.area())
    }

    /// The shape under an affine map of world space. Fronts and outsides stay so under mirrors.
    pub fn transformed(&self, affine: &Affine3A) -> Result<Self, GeometryError> {
        Ok(match self {
            Shape::Sphere(s) => s.transformed(affine)?.into(),
            Shape::Rectangle(s) => s.transformed(affine)?.into(),
            Shape::Disk(s) => s.transformed(affine)?.into(),
            Shape::Convex(s) => s.transformed(affine)?.into(),
        })
    }

    /// Strictly inside a solid; never for flat shapes.
    pub fn contains(&self, point: Vec3) -> bool {
        match self {
            Shape::Sphere(s) => s.contains(point),
            Shape::Convex(s) => s.contains(point),
            Shape::Rectangle(_) | Shape::Disk(_) => false,
        }
    }

    /// A ray that comes from elsewhere.
    #[inline]
    pub(super) fn meet(&self, probe: &Probe) -> Option<Crossing> {
        each!(self, s => s.meet(probe))
    }

    /// The exit of a ray that sets off from the surface into the inside; flat shapes have none.
    #[inline]
    pub(super) fn exit(&self, origin: Vec3, direction: Vec3) -> Option<Crossing> {
        match self {
            Shape::Sphere(s) => Some(s.exit(origin, direction)),
            Shape::Convex(s) => Some(s.exit(origin, direction)),
            Shape::Rectangle(_) | Shape::Disk(_) => None,
        }
    }

    /// Point, normal and coordinates where a ray arrives.
    pub(super) fn surface(&self, near: Vec3, facet: u32) -> (Vec3, Vec3) {
        match self {
            Shape::Sphere(s) => s.surface(near),
            Shape::Rectangle(s) => s.surface(near),
            Shape::Disk(s) => s.surface(near),
            Shape::Convex(s) => s.surface(near, facet),
        }
    }

    /// Whether its points have texture coordinates.
    pub fn has_uv(&self) -> bool {
        match self {
            Shape::Sphere(_) | Shape::Rectangle(_) | Shape::Disk(_) => true,
            Shape::Convex(_) => false,
        }
    }

    /// Texture coordinates, v upwards: of a sphere azimuth and height by angle, each over its range; of flat shapes the square
    /// around them.
    pub(super) fn uv(&self, point: Vec3, _facet: u32) -> Option<Vec2> {
        match self {
            Shape::Sphere(s) => Some(s.uv(point)),
            Shape::Rectangle(s) => Some(s.flat.uv(point)),
            Shape::Disk(s) => Some(s.flat.uv(point)),
            Shape::Convex(_) => None,
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
