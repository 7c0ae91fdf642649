//! Rays that leave a convex solid together, and which of them surely meet nothing any more.
//!
//! Wavelengths leave a gem as one ray each, most of them into the open. Whether rays miss a box is asked of all of them at once, which takes a
//! few instructions a ray; the search for what is met takes more than a hundred even where that is nothing. Boxes are widened as those of
//! trees are: what a flat shape counts as met beyond its own edge, by rounding, may be missed.

use super::ray::{ShapeId, sum_abs};
use super::{Bounds, World};
use crate::math::Vectors;

/// In worlds of more shapes each ray goes its own way from the start.
const FEW: usize = 8;

/// Shapes by their boxes.
#[derive(Clone, Debug)]
pub(super) struct Few(Vec<Bounds>);

impl Few {
    pub fn new(boxes: &[Bounds]) -> Option<Self> {
        (boxes.len() <= FEW).then(|| Self(boxes.iter().map(Bounds::padded).collect()))
    }
}

/// What all box tests want to know of rays.
struct Rays<'a, const N: usize> {
    origins: &'a Vectors<N>,
    inverse: Vectors<N>,
    /// How far the origins may be off.
    error: [f32; N],
}

impl World {
    /// Which rays, whose origins are on a convex solid that they leave outwards, meet no other shape. A ray of which that is not sure
    /// is none of them; nor is one that is no number.
    #[inline]
    pub fn escape<const N: usize>(&self, origins: &Vectors<N>, directions: &Vectors<N>, left: ShapeId) -> [bool; N] {
        let Some(Few(boxes)) = &self.few else { return [false; N] };
        let finite = |lane: usize| sum_abs(origins.get(lane)) + sum_abs(directions.get(lane)) < f32::INFINITY;
        let mut escape = std::array::from_fn(finite);
        if boxes.len() > 1 {
            let inverse = Vectors {
                x: directions.x.map(|d| 1.0 / d),
                y: directions.y.map(|d| 1.0 / d),
                z: directions.z.map(|d| 1.0 / d),
            };
            let error = std::array::from_fn(|lane| self.origin_error(origins.get(lane), left));
            let rays = Rays { origins, inverse, error };
            for (_, b) in (0..).zip(boxes).filter(|&(shape, _)| shape != left.0) {
                rays.miss(b, &mut escape);
            }
        }
        escape
    }
}

impl<const N: usize> Rays<'_, N> {
    /// Keeps the rays that miss a box, widened by what origins and distances may be off. (0 · ∞ = NaN is of a ray along the widened box's
    /// outside.)
    #[inline]
    fn miss(&self, b: &Bounds, escape: &mut [bool; N]) {
        let (o, i) = (self.origins, &self.inverse);
        let (mut near, mut far) = ([0.0f32; N], [f32::INFINITY; N]);
        for (o, inverse, min, max) in
            [(&o.x, &i.x, b.min.x, b.max.x), (&o.y, &i.y, b.min.y, b.max.y), (&o.z, &i.z, b.min.z, b.max.z)]
        {
            for lane in 0..N {
                let to_min = (min - self.error[lane] - o[lane]) * inverse[lane];
                let to_max = (max + self.error[lane] - o[lane]) * inverse[lane];
                let (least, most) = if to_min < to_max { (to_min, to_max) } else { (to_max, to_min) };
                let (least, most) = (least * (1.0 - 8.0 * f32::EPSILON), most * (1.0 + 8.0 * f32::EPSILON));
                near[lane] = if least > near[lane] { least } else { near[lane] };
                far[lane] = if most < far[lane] { most } else { far[lane] };
            }
        }
        for lane in 0..N {
            escape[lane] &= near[lane] > far[lane];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Convex, Departure, Ray, Rectangle, Shape, Side, Sphere};
    use super::*;
    use glam::Vec3;

    /// A cube about the origin, a lamp above it and balls around it.
    fn world(balls: usize) -> World {
        let half = Vec3::splat(0.5);
        let mut shapes: Vec<Shape> = vec![Convex::cuboid(Vec3::ZERO, half).expect("a cube").into()];
        shapes.push(Rectangle::new(3.0 * Vec3::Z, 4.0 * Vec3::X, 4.0 * Vec3::Y).expect("a lamp").into());
        for ball in 0..balls {
            let (sin, cos) = (ball as f32).sin_cos();
            shapes.push(Sphere::new(Vec3::new(2.0 * cos, 2.0 * sin, -0.3), 0.4).expect("a ball").into());
        }
        World::new(shapes).expect("a world")
    }

    /// Eight rays a number, from the cube's sides outwards; every other bundle runs along the axes.
    fn rays(number: u32) -> (Vectors<8>, Vectors<8>) {
        let random = |lane: usize, of: u32| {
            let mixed = (number * 64 + lane as u32 * 8 + of).wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            ((mixed ^ mixed >> 15).wrapping_mul(277_803_737) >> 8) as f32 / 16_777_216.0 - 0.5
        };
        let side = |lane: usize| (number as usize + lane) % 3;
        let sign = |lane: usize| if (number / 3).is_multiple_of(2) && lane < 5 { 1.0 } else { -1.0 };
        let origins = Vectors::from_fn(|lane| {
            let mut origin = Vec3::from_array([0, 1, 2].map(|of| random(lane, of)));
            origin[side(lane)] = 0.5 * sign(lane);
            origin
        });
        let directions = Vectors::from_fn(|lane| {
            let mut direction =
                Vec3::from_array([3, 4, 5].map(|of| if number.is_multiple_of(2) { random(lane, of) } else { 0.0 }));
            direction[side(lane)] = (direction[side(lane)].abs() + 0.1) * sign(lane);
            direction.normalize()
        });
        (origins, directions)
    }

    #[test]
    fn what_escapes_meets_nothing_and_most_that_meets_nothing_escapes() {
        for balls in [0, 3, 6] {
            let world = world(balls);
            let (mut alone, mut claimed) = (0, 0);
            for (origins, directions) in (0..3000).map(rays) {
                let escape = world.escape(&origins, &directions, ShapeId(0));
                for (lane, escapes) in escape.into_iter().enumerate() {
                    let departs = Departure::Surface { shape: ShapeId(0), facet: 0, side: Side::Outside, place: 0 };
                    let ray = Ray { origin: origins.get(lane), direction: directions.get(lane), departs };
                    let meets = world.first(&ray, &[], f32::INFINITY).is_some();
                    assert!(!(escapes && meets), "{balls} balls: {ray:?}");
                    alone += u32::from(!meets);
                    claimed += u32::from(escapes);
                }
            }
            assert!(
                alone > 10_000 && f64::from(claimed) > 0.9 * f64::from(alone),
                "{balls} balls: {claimed} of {alone}"
            );
        }
    }

    #[test]
    fn rays_that_are_no_numbers_and_rays_among_many_shapes_do_not_escape() {
        let (mut origins, mut directions) = rays(0);
        origins.set(1, Vec3::NAN);
        directions.set(2, Vec3::new(0.0, f32::NAN, 1.0));
        directions.set(3, Vec3::splat(f32::INFINITY));
        for world in [world(0), World::new(vec![world(0).shapes()[0].clone()]).expect("a world")] {
            assert_eq!(world.escape(&origins, &directions, ShapeId(0))[1..4], [false; 3]);
        }
        assert_eq!(world(7).escape(&origins, &directions, ShapeId(0)), [false; 8]);
    }
}
