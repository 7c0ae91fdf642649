//! Axis-aligned boxes.

use glam::Vec3;

/// An axis-aligned box; empty if `min` exceeds `max` on an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub min: Vec3,
    pub max: Vec3,
}

impl Bounds {
    pub const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// The smallest box around some points.
    pub fn of(points: impl IntoIterator<Item = Vec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| Self { min: b.min.min(p), max: b.max.max(p) })
    }

    pub fn is_empty(&self) -> bool {
        !(self.min.x <= self.max.x && self.min.y <= self.max.y && self.min.z <= self.max.z)
    }

    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Whether two boxes have a point in common.
    pub fn meets(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    pub fn corners(&self) -> [Vec3; 8] {
        std::array::from_fn(|i| {
            let pick = |axis: usize| if i >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] };
            Vec3::new(pick(0), pick(1), pick(2))
        })
    }

    pub fn center(&self) -> Vec3 {
        self.min * 0.5 + self.max * 0.5
    }

    /// Edge lengths; zero for an empty box.
    pub fn size(&self) -> Vec3 {
        if self.is_empty() { Vec3::ZERO } else { self.max - self.min }
    }

    /// How far a point is from the box; 0 inside.
    pub fn distance_to(&self, point: Vec3) -> f32 {
        point.distance(point.clamp(self.min, self.max))
    }

    pub fn contains(&self, point: Vec3) -> bool {
        point.cmpge(self.min).all() && point.cmple(self.max).all()
    }

    /// Widened by a length on all sides.
    pub(super) fn widened(&self, by: f64) -> Self {
        let by = Vec3::splat(by as f32);
        Self { min: self.min - by, max: self.max + by }.padded()
    }

    /// Widened by a few roundings of its coordinates, so that it surely holds what was computed in single precision.
    pub(super) fn padded(&self) -> Self {
        if self.is_empty() {
            return *self;
        }
        let pad = self.min.abs().max(self.max.abs()) * (4.0 * f32::EPSILON) + Vec3::splat(f32::MIN_POSITIVE);
        Self { min: self.min - pad, max: self.max + pad }
    }
}
