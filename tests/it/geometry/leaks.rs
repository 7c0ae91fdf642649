//! Rays inside closed solids always find the way out, above all at edges and vertices, at every scale and far from the origin.
//!
//! Meshes and convex solids get two million rays at each place, meshes a tenth of them where nothing long is asked for. The full ten million, which take half a minute on two cores:
//! `SPECTREL_LEAK_RAYS=10000000 cargo test --release --test it -- hold_rays_at --include-ignored --nocapture`

use crate::common::meshes;
use crate::common::random::Random;
use glam::{Affine3A, DVec3, Quat, Vec3};
use rayon::prelude::*;
use spectrel::geometry::{
    Brilliant, Convex, Departure, Mesh, Placed, Plane, Ray, Shape, ShapeId, Side, Sphere, StepCut, Triangles, World,
};
use spectrel::math::Vectors;
use std::sync::Arc;
use std::time::Instant;

const SCALES: [f32; 3] = [1e-4, 1.0, 1e4];
const ORIGINS: [Vec3; 2] = [Vec3::ZERO, Vec3::new(0.7, -1.3, 0.4)];

fn random_convex() -> Convex {
    let mut random = Random(7);
    let planes: Vec<Plane> =
        (0..60).map(|_| Plane::new(random.direction().as_dvec3(), 0.5 + 0.1 * random.unit() as f64)).collect();
    Convex::from_planes(&planes).unwrap()
}

/// More planes than are kept from the first look at them to the second.
fn many_sides() -> Convex {
    let sides = (0..300).map(|i| {
        let angle = f64::from(i) * 0.37;
        Plane::new(DVec3::new(libm::cos(angle), libm::sin(angle), 0.3 * libm::sin(7.0 * angle)).normalize(), 1.0)
    });
    let ends = [DVec3::Z, -DVec3::Z].map(|normal| Plane::new(normal, 1.0));
    let solid = Convex::from_planes(&sides.chain(ends).collect::<Vec<_>>()).unwrap();
    assert!(solid.facets().len() > 128);
    solid
}

/// A slender pyramid: towards its tip a ray hardly approaches any plane.
fn needle() -> Convex {
    let tip = DVec3::Z * 10.0;
    let sides = (0..3).map(|i| {
        let angle = f64::from(i) * std::f64::consts::TAU / 3.0;
        Plane::through(tip, DVec3::new(libm::cos(angle), libm::sin(angle), 0.02))
    });
    Convex::from_planes(&sides.chain([Plane::new(-DVec3::Z, 0.0)]).collect::<Vec<_>>()).unwrap()
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
    let (mut origins, mut directions) = (Vectors::<8>::splat(Vec3::ZERO), Vectors::<8>::splat(Vec3::Z));
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
        let facet = solid.corners(random.below(solid.facets().len()) as u32);
        let mut corner = || solid.vertices()[facet[random.below(facet.len())] as usize];
        let (a, b, c) = (corner(), corner(), corner());
        let (u, v) = (random.unit(), random.unit());
        let origin = match i % 5 {
            0 => solid.center() + (a - solid.center()) * u,
            1 => random.nudged(a),
            _ => a + (b - a) * u + (c - a) * (v * (1.0 - u)),
        };
        let Some(direction) = (target - origin).try_normalize() else { continue };
        let departs = Departure::Surface { shape: ShapeId(0), facet: 0, side: Side::Inside, place: 0 };
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
        attack(solid.copied(&glam::Affine3A::from_scale(Vec3::new(-scale, scale, 1.3 * scale))).unwrap(), rays / 3);
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
            let departs = Departure::Surface { shape: ShapeId(0), facet: 0, side: Side::Inside, place: 0 };
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
    let mut origins = Vectors::<8>::splat(solid.center());
    let mut directions = Vectors::<8>::from_fn(|i| Vec3::new(i as f32 - 3.3, 1.7, -2.1).normalize());
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

/// Wavelengths that have hardly parted, towards edges and corners that part them: all planes but a few are left out for them.
#[test]
fn rays_beside_each_other_leave_where_each_would_alone() {
    let mut random = Random(11);
    let usual = [Brilliant::default().solid().unwrap(), random_convex(), Convex::cuboid(Vec3::X, Vec3::ONE).unwrap()];
    for solid in usual.into_iter().chain([many_sides(), needle()]) {
        for i in 0..120_000 {
            let spread = 10f32.powf(-8.0 * random.unit());
            let corner = solid.vertices()[random.below(solid.vertices().len())];
            let [a, b] = solid.edges()[random.below(solid.edges().len())].map(|v| solid.vertices()[v as usize]);
            let (from, to) = (a + (b - a) * random.unit(), if i % 2 == 0 { corner } else { a });
            let middle = if i % 3 == 0 { from } else { solid.center() + (from - solid.center()) * random.unit() };
            let (mut origins, mut directions) = (Vectors::<8>::splat(middle), Vectors::<8>::splat(Vec3::Z));
            for lane in 0..8 {
                let moved = middle + (solid.center() - middle) * (spread * random.unit());
                origins.set(lane, if i % 5 == 0 { middle } else { moved });
                let toward = (to - middle).normalize_or(Vec3::X) + random.direction() * (0.3 * spread);
                directions.set(lane, toward.normalize());
            }
            let exits = solid.exit_lanes(&origins, &directions);
            for lane in 0..8 {
                let (origin, direction) =
                    (Vectors::<1>::splat(origins.get(lane)), Vectors::splat(directions.get(lane)));
                let alone = solid.exit_lanes(&origin, &direction);
                assert_eq!((exits.t[lane], exits.facet[lane]), (alone.t[0], alone.facet[0]), "{i} {lane} {spread}");
            }
        }
    }
}

#[test]
fn lanes_that_are_not_numbers_do_not_disturb_others() {
    let solid = Brilliant::default().solid().unwrap();
    let mut directions = Vectors::<8>::splat(Vec3::X);
    directions.set(3, Vec3::NAN);
    directions.set(5, Vec3::ZERO);
    let exits = solid.exit_lanes(&Vectors::splat(solid.center()), &directions);
    assert_eq!((exits.t[3], exits.facet[3], exits.t[5]), (0.0, 0, 0.0));
    let alone = solid.exit_lanes(&Vectors::<1>::splat(solid.center()), &Vectors::splat(Vec3::X));
    assert_eq!((exits.t[4], exits.facet[4]), (alone.t[0], alone.facet[0]));
}

/// What is no number says nothing about how far apart the others are, wherever it stands among them.
#[test]
fn rays_beside_one_that_is_no_number_keep_their_exits() {
    let solid = Brilliant::default().solid().unwrap();
    let origin = solid.center() + Vec3::new(0.1, 0.05, 0.0) * solid.radius();
    for turn in 0..64 {
        let angle = turn as f32 * 0.1;
        let middle = Vec3::new(libm::cosf(angle), libm::sinf(angle), 0.3).normalize();
        for (aside, nan) in (0..8).flat_map(|aside| (0..8).map(move |nan| (aside, nan))) {
            let mut directions = Vectors::<8>::splat(middle);
            directions.set(aside, (middle + Vec3::new(0.1, -0.1, 0.15)).normalize());
            directions.set(nan, Vec3::NAN);
            let exits = solid.exit_lanes(&Vectors::splat(origin), &directions);
            for lane in (0..8).filter(|&lane| lane != nan) {
                let alone = solid.exit_lanes(&Vectors::<1>::splat(origin), &Vectors::splat(directions.get(lane)));
                assert_eq!(
                    (exits.t[lane], exits.facet[lane]),
                    (alone.t[0], alone.facet[0]),
                    "{turn}: {aside} {nan} {lane}"
                );
            }
        }
    }
}

/// Rays at each place.
fn ray_count() -> usize {
    let told = std::env::var("SPECTREL_LEAK_RAYS").ok();
    told.map_or(2_000_000, |count| count.parse().unwrap())
}

/// Scales, and far from the origin.
fn places() -> Vec<(String, Affine3A)> {
    let turn = Quat::from_euler(glam::EulerRot::XYZ, 0.3, -1.1, 2.0);
    let place = |scale: f32, to: Vec3| Affine3A::from_scale_rotation_translation(Vec3::splat(scale), turn, to);
    let near = SCALES.map(|scale| (format!("scale {scale:e}"), place(scale, ORIGINS[1] * scale)));
    let far = ("scale 1, 1e4 away".to_owned(), place(1.0, Vec3::new(1e4, -3e3, 5e3)));
    near.into_iter().chain([far]).collect()
}

/// A closed solid that every line from its middle leaves once.
struct Star {
    world: World,
    middle: Vec3,
    corners: Vec<Vec3>,
    edges: Vec<[u32; 2]>,
}

impl Star {
    fn of_mesh(triangles: Triangles) -> Self {
        let corners = triangles.positions.clone();
        let edges = triangles.indices.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        let world = World::new(vec![Placed::new(Arc::new(Mesh::new(triangles).unwrap())).into()]).unwrap();
        Self { middle: world.bounds().center(), world, corners, edges }
    }

    fn of_convex(solid: Convex) -> Self {
        let (corners, edges, middle) = (solid.vertices().to_vec(), solid.edges().to_vec(), solid.center());
        Self { world: World::new(vec![solid.into()]).unwrap(), middle, corners, edges }
    }

    /// A corner or a point of an edge, or a few roundings beside it.
    fn target(&self, random: &mut Random) -> Vec3 {
        let [a, b] = self.edges[random.below(self.edges.len())].map(|corner| self.corners[corner as usize]);
        let target = if random.below(3) == 0 { a } else { a + (b - a) * random.unit() };
        if random.below(2) == 0 { target } else { random.nudged(target) }
    }

    /// Rays from within, each followed by up to three that go on inwards from where the last one arrived. How many find nothing?
    fn leaks(&self, rays: usize, seed: u64) -> usize {
        let mut random = Random(seed);
        let (mut asked, mut leaks) = (0, 0);
        while asked < rays {
            let corner = self.corners[random.below(self.corners.len())];
            let origin = self.middle + (corner - self.middle) * (0.8 * random.unit());
            let Some(direction) = (self.target(&mut random) - origin).try_normalize() else { continue };
            let mut ray = Ray::free(origin, direction);
            for _ in 0..4 {
                asked += 1;
                let Some(hit) = self.world.closest(&ray, f32::INFINITY) else {
                    leaks += 1;
                    break;
                };
                let Some(direction) = (self.target(&mut random) - hit.point).try_normalize() else { break };
                let inwards = direction - hit.normal * (2.0 * direction.dot(hit.normal).max(0.0));
                ray = Ray::leaving(&hit, Side::Inside, inwards);
            }
        }
        leaks
    }
}

/// Rays at each place, shared by the solids.
fn hold(kind: &str, rays: usize, solids: impl Fn(&Affine3A) -> Vec<Star>) {
    for (place, map) in places() {
        let start = Instant::now();
        let stars = solids(&map);
        let parts: Vec<(&Star, u64)> = stars.iter().flat_map(|star| (1..=100).map(move |seed| (star, seed))).collect();
        let rays = rays.div_ceil(parts.len());
        let leaks: usize = parts.par_iter().map(|(star, seed)| star.leaks(rays, *seed)).sum();
        println!("{kind}, {place}: {leaks} of {} lost, {:.1} s", rays * parts.len(), start.elapsed().as_secs_f64());
        assert_eq!(leaks, 0, "{kind}, {place}");
    }
}

#[test]
fn meshes_hold_some_rays_at_edges_and_corners() {
    meshes_hold(200_000);
}

#[test]
#[ignore = "long: 16,000,000 rays"]
fn meshes_hold_rays_at_edges_and_corners() {
    meshes_hold(ray_count());
}

fn meshes_hold(rays: usize) {
    let brilliant = meshes::of_convex(&Brilliant::default().solid().unwrap());
    let solids = [meshes::blob(5, 0.05), brilliant, meshes::icosphere(4)];
    hold("meshes", rays, |map| {
        let moved = |mesh: &Triangles| Triangles {
            positions: mesh.positions.iter().map(|&p| map.transform_point3(p)).collect(),
            ..mesh.clone()
        };
        solids.iter().map(|mesh| Star::of_mesh(moved(mesh))).collect()
    });
}

#[test]
fn convex_solids_hold_rays_at_edges_and_corners() {
    let solids = [
        Brilliant::default().solid().unwrap(),
        StepCut::default().solid().unwrap(),
        Convex::cuboid(Vec3::ZERO, Vec3::new(0.5, 0.3, 0.8)).unwrap(),
        random_convex(),
    ];
    hold("convex solids", ray_count(), |map| {
        solids.iter().map(|solid| Star::of_convex(solid.transformed(map).unwrap())).collect()
    });
}
