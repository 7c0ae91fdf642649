//! Rays that know where they come from, and what they meet.

use glam::Vec3;

/// A shape of a [`World`](super::World), by its position in the list the world was made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ShapeId(pub u32);

/// A side of a surface.
///
/// Outside is where the normal points: the outside of a solid, the front of a flat shape. Inside is the solid's inside, or
/// the back of a flat shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    Outside,
    Inside,
}

impl Side {
    /// The other side.
    pub fn opposite(self) -> Self {
        match self {
            Side::Outside => Side::Inside,
            Side::Inside => Side::Outside,
        }
    }
}

/// Where a ray begins.
///
/// This takes the place of the usual epsilon: a flat shape, and the outside of a convex solid, cannot be met again by a ray
/// that leaves them, and a ray that sets off into a solid can only meet its exit. No distance has to be guessed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Departure {
    /// In the middle of nowhere: a camera.
    Free,
    /// On the surface of `shape`, into its `side`: `Outside` for a reflection off a solid and for light that leaves it,
    /// `Inside` for light that enters it and for a reflection within. `facet` and `place` as in [`Hit`].
    Surface { shape: ShapeId, facet: u32, side: Side, place: u32 },
}

/// A point on a light that a shadow ray goes to: a facet of a shape, as in [`Hit::facet`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Target {
    pub shape: ShapeId,
    pub facet: u32,
}

/// A ray; `direction` is a unit vector, distances along it are scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    pub origin: Vec3,
    pub direction: Vec3,
    pub departs: Departure,
}

impl Ray {
    /// A ray from a point that lies on no surface.
    pub fn free(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, departs: Departure::Free }
    }

    /// A ray that leaves the point of a hit, into the given side of the surface.
    pub fn leaving(hit: &Hit, side: Side, direction: Vec3) -> Self {
        Self { origin: hit.point, direction, departs: hit.departure(side) }
    }
}

/// What a ray meets first: what is known before the surface is looked at (a preliminary intersection).
/// [`World::surface`](super::World::surface) makes a [`Hit`] of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// As in [`Hit`], and so all others.
    pub t: f32,
    pub shape: ShapeId,
    pub side: Side,
    pub facet: u32,
    /// Where a mesh keeps the triangle for rays; not a hint here.
    pub(super) place: u32,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, ≥ 0.
    pub t: f32,
    pub shape: ShapeId,
    /// The side on which the ray arrives: `Inside` if it was within the solid, or comes to the back of a flat shape.
    pub side: Side,
    /// Facet of a convex solid, in the order of [`Convex::facets`](super::Convex::facets), or triangle of a mesh; 0 for
    /// other shapes.
    pub facet: u32,
    /// Where a mesh keeps that triangle for rays, which saves a search in memory when a ray leaves it. A hint: a wrong one costs
    /// time, and 0 will do.
    pub place: u32,
    /// The point, put back onto the surface: good to a few roundings of its coordinates however far the ray came.
    pub point: Vec3,
    /// Geometric unit normal: out of a solid, to the front of a flat shape, whichever side the ray arrives on.
    pub normal: Vec3,
    /// Unit normal of the smooth surface that a mesh stands for, on the same side as `normal`; `normal` itself elsewhere.
    pub shading: Vec3,
}

impl Hit {
    /// A ray's departure from here, into the given side of the surface.
    #[inline]
    pub fn departure(&self, side: Side) -> Departure {
        let &Self { shape, facet, place, .. } = self;
        Departure::Surface { shape, facet, side, place }
    }

    /// The geometric normal on the side on which the ray arrived.
    #[inline]
    pub fn outward(&self) -> Vec3 {
        if self.side == Side::Outside { self.normal } else { -self.normal }
    }

    /// Whether a direction leaves into a side of the triangle, as it does into that side of the smooth surface.
    #[inline]
    pub fn admits(&self, side: Side, direction: Vec3) -> bool {
        self.shading == self.normal || (self.normal.dot(direction) > 0.0) == (side == Side::Outside)
    }

    /// The normal to scatter by, on the side of `wo`, the direction back along the ray.
    ///
    /// A smooth normal may look away from `wo`, or throw its mirror image below the triangle. Then it is turned as little as
    /// puts the image back above (A. Keller et al., "The Iray Light Transport Simulation and Rendering System", 2017, A.3).
    #[inline]
    pub fn facing(&self, wo: Vec3) -> Vec3 {
        let normal = self.outward();
        if self.shading == self.normal {
            return normal;
        }
        let shading = if self.side == Side::Outside { self.shading } else { -self.shading };
        let mirrored = shading * (2.0 * shading.dot(wo)) - wo;
        let least = (0.9 * normal.dot(wo)).clamp(0.0, 0.01);
        let height = normal.dot(mirrored);
        if height >= least {
            return shading;
        }
        let lifted = (mirrored + normal * (least - height)).normalize_or(normal);
        (wo + lifted).normalize_or(normal)
    }
}

/// What a shape tells of a point on it, as in [`Hit`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    pub point: Vec3,
    pub normal: Vec3,
    pub shading: Vec3,
}

impl Surface {
    /// A point of a shape that is as smooth as it says.
    pub fn plain(point: Vec3, normal: Vec3) -> Self {
        Self { point, normal, shading: normal }
    }
}

/// A ray with what the shapes need to know about how exact its origin is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Probe<'a> {
    pub ray: &'a Ray,
    /// Bound on the distance between the origin and the point it stands for.
    pub origin_error: f32,
    /// The ray leaves the outside of a solid, hence moves towards whatever touches the solid there.
    pub leaves_solid: bool,
}

/// What a shape answers to a probe; [`Hit`] is worked out for the nearest one only.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    pub t: f32,
    /// Bound on the rounding error of `t`; infinite where a mesh is met but for the inside of one that the ray leaves, since nobody asks
    /// for it.
    pub slack: f32,
    pub side: Side,
    pub facet: u32,
    /// As in [`Hit`]; 0 for shapes that are no meshes.
    pub place: u32,
}

/// |x| + |y| + |z|, the natural measure of the rounding error of a sum of products.
#[inline]
pub(super) fn sum_abs(v: Vec3) -> f32 {
    v.x.abs() + v.y.abs() + v.z.abs()
}
