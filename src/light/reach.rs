//! Where a group of lights stands, whereto it shines, and how strongly: what a light tree knows of its branches.
//!
//! A box around the lights; a cone of half-angle θ_o around the axes of all; and θ_e, the angle from its own axis up to which
//! a light sends anything. Groups are joined, and judged by
//!
//! ```text
//! cost = I · M_Ω · s²,   M_Ω = 2π (1 − cos θ_o) + π/2 (2 θ_w sin θ_o − cos(θ_o − 2 θ_w) − 2 θ_o sin θ_o + cos θ_o)
//! ```
//!
//! with θ_w = min(θ_o + θ_e, π), the intensity I and the diagonal s of the box.
//!
//! Source: A. Conty Estevez & C. Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", Proceedings of the
//! ACM on Computer Graphics and Interactive Techniques 1 (2018), section 4; joining cones after M. Pharr, W. Jakob & G. Humphreys,
//! *Physically Based Rendering*, 4th ed. (2023), section 3.8.4. They take the box's surface where s² stands here: it vanishes
//! for lamps in a row, whose distances differ as much as others'.

use super::{Emitter, Source};
use crate::geometry::{Bounds, Shape, World};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// The reach of one light or of many.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    pub bounds: Bounds,
    /// Largest luminous intensity of each light, summed, in the unit of [`Emitter::power`].
    pub intensity: f64,
    pub axis: DVec3,
    /// θ_o: how far the axes of lights are from `axis`, radians.
    pub spread: f64,
    /// θ_e: how far from its axis a light shines, radians.
    pub beyond: f64,
    /// Whether the same goes out backwards.
    pub both: bool,
}

/// Least angle that light is taken to reach beyond a cone, rad: the tree looks in single precision, in which the cosine of less is 1, and a
/// cone with a sharp edge would shine nowhere.
const LEAST_BEYOND: f64 = 2e-3;

impl Reach {
    pub const NOTHING: Self =
        Self { bounds: Bounds::EMPTY, intensity: 0.0, axis: DVec3::Z, spread: 0.0, beyond: 0.0, both: false };

    /// Of an emitter with a place; suns and surroundings have none.
    pub fn of(emitter: &Emitter, world: &World) -> Option<Self> {
        // What shines evenly in all directions shows, of its surface, a quarter in the mean.
        let all_around = |bounds| Self {
            bounds,
            intensity: emitter.power / 4.0,
            axis: DVec3::Z,
            spread: PI,
            beyond: FRAC_PI_2,
            both: false,
        };
        match emitter.source {
            Source::Shape { id, two_sided } => {
                let shape = world.shape(id)?;
                let flat = |normal: glam::Vec3| Self {
                    intensity: emitter.power / if two_sided { 2.0 } else { 1.0 },
                    axis: normal.as_dvec3(),
                    spread: 0.0,
                    both: two_sided,
                    ..all_around(shape.bounds())
                };
                Some(match shape {
                    Shape::Rectangle(rectangle) => flat(rectangle.normal()),
                    Shape::Disk(disk) => flat(disk.normal()),
                    Shape::Sphere(_) | Shape::Convex(_) | Shape::Mesh(_) => all_around(shape.bounds()),
                })
            }
            Source::Point(point) => {
                let everywhere = all_around(Bounds::of([point.position()]));
                Some(match point.cone() {
                    None => everywhere,
                    Some((axis, full, none)) => Self {
                        intensity: emitter.power * PI / point.solid_angle(),
                        axis,
                        spread: full,
                        beyond: (none - full).max(LEAST_BEYOND),
                        ..everywhere
                    },
                })
            }
            Source::Sun(_) | Source::Map => None,
        }
    }

    pub fn union(&self, other: &Self) -> Self {
        let (axis, spread) = joined((self.axis, self.spread), (other.axis, other.spread));
        Self {
            bounds: self.bounds.union(&other.bounds),
            intensity: self.intensity + other.intensity,
            axis,
            spread,
            beyond: self.beyond.max(other.beyond),
            both: self.both || other.both,
        }
    }

    /// Square of half the box's diagonal.
    pub fn square(&self) -> f64 {
        0.25 * self.bounds.size().as_dvec3().length_squared()
    }

    /// How much a choice within the group is likely to matter.
    pub fn cost(&self) -> f64 {
        let (o, w) = (self.spread, (self.spread + self.beyond).min(PI));
        let (sin, cos) = libm::sincos(o);
        let angles =
            2.0 * PI * (1.0 - cos) + FRAC_PI_2 * (2.0 * w * sin - libm::cos(o - 2.0 * w) - 2.0 * o * sin + cos);
        self.intensity * angles * self.square()
    }
}

/// The narrowest cone around two: axes, and half-angles in radians.
fn joined((a, a_spread): (DVec3, f64), (b, b_spread): (DVec3, f64)) -> (DVec3, f64) {
    let apart = 2.0 * libm::atan2((a - b).length(), (a + b).length());
    if (apart + b_spread).min(PI) <= a_spread {
        return (a, a_spread);
    }
    if (apart + a_spread).min(PI) <= b_spread {
        return (b, b_spread);
    }
    let spread = 0.5 * (a_spread + apart + b_spread);
    let toward = (b - a * a.dot(b)).normalize_or_zero();
    if spread >= PI || toward == DVec3::ZERO {
        return (a, PI);
    }
    let (sin, cos) = libm::sincos(spread - a_spread);
    (a * cos + toward * sin, spread)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joined_cone_holds_both_and_touches_them() {
        let axes = [DVec3::X, DVec3::Y, DVec3::new(0.6, -0.8, 0.0), DVec3::new(-0.36, 0.48, 0.8)];
        for (a, b) in axes.iter().flat_map(|a| axes.iter().map(move |b| (*a, *b))) {
            for (p, q) in [(0.0, 0.0), (0.3, 0.1), (1.2, 0.0), (0.2, 2.5)] {
                let (axis, spread) = joined((a, p), (b, q));
                let within = |other: DVec3, more: f64| axis.angle_between(other) + more;
                let needed = within(a, p).max(within(b, q));
                assert!((axis.length() - 1.0).abs() < 1e-12 && needed <= spread + 1e-7, "{a} {p}, {b} {q}");
                assert!(spread == PI || (needed - spread).abs() < 1e-7, "{a} {p}, {b} {q}: {spread} for {needed}");
            }
        }
        assert_eq!(joined((DVec3::X, 0.1), (-DVec3::X, 0.1)).1, PI);
    }

    /// M_Ω is ∫ over the sphere of cos(max(0, θ − θ_o)) up to θ_w.
    #[test]
    fn the_angular_part_of_a_cost_is_its_integral() {
        let bounds = Bounds::of([glam::Vec3::ZERO, glam::Vec3::new(2.0, 0.0, 0.0)]);
        for (spread, beyond) in [(0.0, FRAC_PI_2), (0.5, FRAC_PI_2), (2.5, FRAC_PI_2), (PI, FRAC_PI_2), (0.4, 0.3)] {
            let reach = Reach { bounds, intensity: 1.0, axis: DVec3::Z, spread, beyond, both: false };
            let (n, end) = (20_000, (spread + beyond).min(PI));
            let at = |i: usize| end * (i as f64 + 0.5) / n as f64;
            let value = |theta: f64| (theta - spread).max(0.0).cos() * theta.sin() * 2.0 * PI * end / n as f64;
            let integral: f64 = (0..n).map(|i| value(at(i))).sum();
            assert!((reach.cost() / integral - 1.0).abs() < 1e-6, "{spread} {beyond}: {} {integral}", reach.cost());
        }
    }
}
