//! Rays inside closed solids always find the way out, above all at edges and vertices, at every scale.

#[path = "common/random.rs"]
#[allow(dead_code, reason = "each test binary uses a part")]
mod random;

use glam::Vec3;
use random::Random;
use spectrel::geometry::{
    Brilliant, Convex, Departure, Plane, Points, Ray, Shape, ShapeId, Side, Sphere, StepCut, World,
};

const SCALES: [f32; 3] = [1e-4, 1.0, 1e4];
const ORIGINS: [Vec3; 2] = [Vec3::ZERO, Vec3::new(0.7, -1.3, 0.4)];

fn random_convex() -> Convex {
    let mut random = Random(7);
    let planes: Vec<Plane> =
        (0..60).map(|_| Plane::new(random.direction().as_dvec3(), 0.5 + 0.1 * random.unit() as f64)).collect();
    Convex::from_planes(&planes).unwrap()
}

/// Worst distance of a point outside of the solid, in units of its size.
fn outside(solid: &Convex, point: Vec3) -> f32 {
    let o = point - solid.center();
    solid.facets().iter().map(|f| f.normal.dot(o) - f.offset).fold(0.0, f32::max) / solid.radius()
}

/// Rays from facet to edges, vertices and their neighbourhoods, both ways of asking, bit for bit the same.
fn attack(solid: Convex, rays: usize) {
    let world = World::new(vec![solid.clone().into()]).unwrap();
    let mut random = Random(1);
    let (mut origins, mut directions) = (Points::<8>::splat(Vec3::ZERO), Points::<8>::splat(Vec3::Z));
    let mut expected = solid.exit_lanes(&origins, &directions);
    let reach = solid.center().abs().max_element() / solid.radius();
    for i in 0..rays {
        let target = match i % 3 {
            0 => solid.vertices()[random.below(solid.vertices().len())],
            _ => {
                let [a, b] = solid.edges()[random.below(solid.edges().len())].map(|v| solid.vertices()[v as usize]);
                a + (b - a) * random.unit()
            }
        };
        let target = if i % 2 == 0 { target } else { random.nudged(target) };
        // From a facet, its edges and vertices included, or from within.
        let facet = &solid.facets()[random.below(solid.facets().len())];
        let mut corner = || solid.vertices()[facet.corners[random.below(facet.corners.len())] as usize];
        let (a, b, c) = (corner(), corner(), corner());
        let (u, v) = (random.unit(), random.unit());
        let origin = match i % 5 {
            0 => solid.center() + (a - solid.center()) * u,
            1 => random.nudged(a),
            _ => a + (b - a) * u + (c - a) * (v * (1.0 - u)),
        };
        let Some(direction) = (target - origin).try_normalize() else { continue };
        let departs = Departure::Surface { shape: ShapeId(0), facet: 0, side: Side::Inside };
        let ray = Ray { origin, direction, departs };
        let hit = world.closest(&ray, f32::INFINITY).expect("a leak");
        assert_eq!(hit.side, Side::Inside);
        assert!(hit.t >= 0.0 && hit.t <= 2.1 * solid.radius());
        let off = outside(&solid, origin + direction * hit.t);
        assert!(off < 2e-6 * (1.0 + reach), "{off}");
        let lane = i % 8;
        origins.set(lane, origin);
        directions.set(lane, direction);
        (expected.t[lane], expected.facet[lane]) = (hit.t, hit.facet);
        if lane == 7 {
            assert_eq!(solid.exit_lanes(&origins, &directions), expected);
        }
        // Without knowing where it departs, a ray from well inside finds its exit too.
        if i % 5 == 0 && u < 0.9 {
            let free = world.closest(&Ray::free(origin, direction), f32::INFINITY).expect("a leak");
            assert_eq!((free.t, free.facet, free.side), (hit.t, hit.facet, Side::Inside));
        }
    }
}

fn everywhere(solid: &Convex, rays: usize) {
    for scale in SCALES {
        for origin in ORIGINS {
            let affine = glam::Affine3A::from_scale_rotation_translation(
                Vec3::splat(scale),
                glam::Quat::from_rotation_x(0.3),
                origin * scale,
            );
            attack(solid.transformed(&affine).unwrap(), rays / 3);
        }
        attack(solid.transformed(&glam::Affine3A::from_scale(Vec3::splat(scale))).unwrap(), rays / 3);
    }
}

#[test]
fn cuboid() {
    everywhere(&Convex::cuboid(Vec3::ZERO, Vec3::new(0.5, 0.3, 0.8)).unwrap(), 1_000_000);
}

#[test]
fn brilliant() {
    everywhere(&Brilliant::default().solid().unwrap(), 1_000_000);
}

#[test]
fn step_cut() {
    everywhere(&StepCut::default().solid().unwrap(), 1_000_000);
}

#[test]
fn random_solid() {
    everywhere(&random_convex(), 1_000_000);
}

#[test]
fn sphere() {
    let mut random = Random(3);
    for scale in SCALES {
        let sphere = Sphere::new(Vec3::new(0.3, 0.2, -0.6) * scale, 0.5 * scale).unwrap();
        let world = World::new(vec![Shape::from(sphere)]).unwrap();
        for i in 0..1_000_000 {
            let out = random.direction();
            let origin = random.nudged(sphere.center() + out * sphere.radius());
            // Every third ray grazes.
            let inward = match i % 3 {
                0 => out.cross(random.direction()).normalize() - out * (random.unit() * 1e-6),
                _ => -out + random.direction() * 0.99,
            };
            let Some(direction) = inward.try_normalize() else { continue };
            let departs = Departure::Surface { shape: ShapeId(0), facet: 0, side: Side::Inside };
            let hit = world.closest(&Ray { origin, direction, departs }, f32::INFINITY).expect("a leak");
            assert!(hit.side == Side::Inside && hit.t >= 0.0);
            let off = ((origin + direction * hit.t) - sphere.center()).length() / sphere.radius() - 1.0;
            assert!(off.abs() < 4e-6, "{off}");
        }
    }
}

#[test]
fn light_that_bounces_for_long_stays_inside() {
    let solid = Brilliant::default().solid().unwrap();
    let mut random = Random(5);
    let mut origins = Points::<8>::splat(solid.center());
    let mut directions = Points::<8>::from_fn(|i| Vec3::new(i as f32 - 3.3, 1.7, -2.1).normalize());
    for _ in 0..20_000 {
        let exits = solid.exit_lanes(&origins, &directions);
        for lane in 0..8 {
            let (o, d) = (origins.get(lane), directions.get(lane));
            let point = solid.project(o + d * exits.t[lane], exits.facet[lane]);
            assert!(outside(&solid, point) < 1e-6);
            let n = solid.normal(exits.facet[lane]);
            let reflected = (d - n * (2.0 * d.dot(n))).normalize();
            // Now and then a new direction, so that lanes do not settle on a cycle.
            let next = if random.below(50) == 0 { (random.direction() - n).normalize() } else { reflected };
            origins.set(lane, point);
            directions.set(lane, if next.dot(n) < 0.0 { next } else { -n });
        }
    }
}

#[test]
fn lanes_that_are_not_numbers_do_not_disturb_others() {
    let solid = Brilliant::default().solid().unwrap();
    let mut directions = Points::<8>::splat(Vec3::X);
    directions.set(3, Vec3::NAN);
    directions.set(5, Vec3::ZERO);
    let exits = solid.exit_lanes(&Points::splat(solid.center()), &directions);
    assert_eq!((exits.t[3], exits.facet[3], exits.t[5]), (0.0, 0, 0.0));
    let alone = solid.exit_lanes(&Points::<1>::splat(solid.center()), &Points::splat(Vec3::X));
    assert_eq!((exits.t[4], exits.facet[4]), (alone.t[0], alone.facet[0]));
}
