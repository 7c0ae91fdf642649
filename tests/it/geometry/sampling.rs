//! Points toward a reference: directions are distributed as the densities say, and both know the solid angle.

use glam::{DVec3, Vec3};
use spectrel::geometry::{Brilliant, Convex, Disk, Ray, Rectangle, Shape, ShapeId, Sphere, Target, World};

/// Shapes and references: near, far, edge-on, inside.
fn cases() -> Vec<(&'static str, Shape, Vec3)> {
    let rectangle: Shape = Rectangle::new(Vec3::new(0.2, 0.1, 0.0), Vec3::X * 1.2, Vec3::Y * 0.7).unwrap().into();
    let sheared: Shape = Rectangle::new(Vec3::ZERO, Vec3::X, Vec3::new(0.4, 0.8, 0.0)).unwrap().into();
    let disk: Shape = Disk::facing(Vec3::ZERO, Vec3::new(0.3, -0.2, 1.0), 0.6).unwrap().into();
    let ellipse: Shape = Disk::new(Vec3::ZERO, Vec3::X * 0.8, Vec3::new(0.3, 0.3, 0.1)).unwrap().into();
    let sphere: Shape = Sphere::new(Vec3::new(0.1, 0.0, -0.2), 0.5).unwrap().into();
    let cuboid: Shape = Convex::cuboid(Vec3::ZERO, Vec3::new(0.3, 0.5, 0.2)).unwrap().into();
    let gem: Shape = Brilliant::default().solid().unwrap().into();
    vec![
        ("rectangle", rectangle.clone(), Vec3::new(0.5, -0.3, 0.8)),
        ("rectangle from behind", rectangle.clone(), Vec3::new(-0.5, 0.9, -0.4)),
        ("rectangle from very near", rectangle.clone(), Vec3::new(0.3, 0.2, 0.01)),
        ("rectangle edge-on", rectangle.clone(), Vec3::new(2.0, 0.3, 0.02)),
        ("rectangle from afar", rectangle, Vec3::new(30.0, -20.0, 40.0)),
        ("parallelogram", sheared, Vec3::new(0.5, -0.3, 0.8)),
        ("disk", disk, Vec3::new(0.5, -0.3, 0.8)),
        ("ellipse", ellipse, Vec3::new(0.5, -0.3, 0.8)),
        ("sphere", sphere.clone(), Vec3::new(1.0, 0.4, 0.3)),
        ("sphere from near", sphere.clone(), Vec3::new(0.6001, 0.0, -0.2)),
        ("sphere from inside", sphere.clone(), Vec3::new(0.3, 0.1, -0.1)),
        ("sphere from afar", sphere, Vec3::new(300.0, 100.0, 200.0)),
        ("cuboid", cuboid.clone(), Vec3::new(1.0, 0.4, 0.7)),
        ("cuboid, one face", cuboid.clone(), Vec3::new(0.1, 0.1, 0.7)),
        ("cuboid from inside", cuboid, Vec3::new(0.1, 0.1, 0.05)),
        ("brilliant", gem.clone(), Vec3::new(0.4, 0.5, 1.2)),
        ("brilliant from below", gem, Vec3::new(0.1, 0.9, -0.4)),
    ]
}

/// Points of a lattice in the unit square (R2 sequence), fixed and even.
fn lattice(i: u32) -> [f32; 2] {
    let part = |a: u32| (i.wrapping_mul(a) >> 8) as f32 / (1 << 24) as f32;
    [part(3242174889), part(2447445414)]
}

/// Solid angle of a shape by an even grid over the cone of directions around it, each asked by a ray.
fn solid_angle(world: &World, reference: Vec3, steps: u32) -> f64 {
    let (axis, cos_min) = cone(world, reference);
    let (x, y) = frame(axis);
    let mut hits = 0u64;
    for i in 0..steps * steps {
        let [a, b] = lattice(i);
        let direction = in_cone(axis, x, y, cos_min, a as f64, b as f64);
        hits += world.closest(&Ray::free(reference, direction), f32::INFINITY).is_some() as u64;
    }
    hits as f64 / (steps * steps) as f64 * std::f64::consts::TAU * (1.0 - cos_min)
}

/// A cone of directions that holds the bounding box: axis and cosine.
fn cone(world: &World, reference: Vec3) -> (DVec3, f64) {
    let b = world.bounds();
    let r = 0.5 * b.size().as_dvec3().length();
    let w = b.center().as_dvec3() - reference.as_dvec3();
    let d = w.length();
    if d <= r { (DVec3::Z, -1.0) } else { (w / d, (1.0 - (r / d).powi(2)).sqrt()) }
}

fn frame(n: DVec3) -> (DVec3, DVec3) {
    let x = n.any_orthonormal_vector();
    (x, n.cross(x))
}

fn in_cone(axis: DVec3, x: DVec3, y: DVec3, cos_min: f64, a: f64, b: f64) -> Vec3 {
    let cos = 1.0 - a * (1.0 - cos_min);
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let phi = std::f64::consts::TAU * b;
    (x * (sin * phi.cos()) + y * (sin * phi.sin()) + axis * cos).as_vec3().normalize()
}

#[test]
fn inverse_density_averages_to_the_solid_angle() {
    for (name, shape, reference) in cases() {
        let world = World::new(vec![shape.clone()]).unwrap();
        let expected = solid_angle(&world, reference, 700);
        let n = 50_000;
        let mut sum = 0.0;
        for i in 0..n {
            if let Some(toward) = shape.sample_toward(reference, lattice(i)) {
                sum += 1.0 / toward.pdf as f64;
            }
        }
        let mean = sum / n as f64;
        assert!((mean / expected - 1.0).abs() < 4e-3, "{name}: {mean} is not {expected}");
    }
}

/// Rectangles near enough to be sampled by solid angle, against the formula of A. Van Oosterom and J. Strackee (IEEE Trans. Biomed. Eng. 30, 1983).
#[test]
fn rectangles_know_their_solid_angle() {
    let rectangle = Rectangle::new(Vec3::new(0.2, 0.1, 0.0), Vec3::X * 1.2, Vec3::Y * 0.7).unwrap();
    for (x, y, z) in
        [(0.5, -0.1, 0.5), (0.3, 0.2, 0.01), (1.0, 0.3, 0.02), (0.9, 0.6, 1e-3), (-0.3, 0.4, -0.3), (0.1, 0.2, -1e-4)]
    {
        let reference = Vec3::new(x, y, z);
        let triangle = |i: usize, j: usize| {
            let [a, b, c] = [0, i, j].map(|k| (rectangle.corners()[k] - reference).as_dvec3());
            let (la, lb, lc) = (a.length(), b.length(), c.length());
            2.0 * a.dot(b.cross(c)).abs().atan2(la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb)
        };
        let exact = triangle(1, 2) + triangle(2, 3);
        let toward = Shape::from(rectangle).sample_toward(reference, [0.3, 0.6]).unwrap();
        assert!((1.0 / toward.pdf as f64 / exact - 1.0).abs() < 2e-6, "{reference}: {} {exact}", 1.0 / toward.pdf);
    }
}

#[test]
fn samples_agree_with_densities_and_rays() {
    for (name, shape, reference) in cases() {
        let world = World::new(vec![shape.clone()]).unwrap();
        let (mut missed, mut odd) = (0, 0);
        for i in 0..20_000 {
            let Some(toward) = shape.sample_toward(reference, lattice(i)) else { continue };
            assert!((toward.direction.length() - 1.0).abs() < 1e-6, "{name}");
            let end = reference + toward.direction * toward.distance;
            let error = 1e-6 * (toward.distance + reference.length() + 1.0);
            assert!(end.distance(toward.point) < 3.0 * error, "{name}: {end} {}", toward.point);
            // The ray finds the point, but for those that rounding puts beyond the rim.
            let Some(hit) = world.closest(&Ray::free(reference, toward.direction), f32::INFINITY) else {
                missed += 1;
                continue;
            };
            let pdf = shape.pdf_toward(reference, toward.direction, &hit);
            let cos = toward.normal.dot(toward.direction).abs();
            if hit.facet != toward.facet || (pdf / toward.pdf - 1.0).abs() > 1e-5 + 2e-6 * toward.distance / cos {
                odd += 1;
            }
            // No shadow on itself, and none without it.
            let shadow = Ray::free(reference, toward.direction);
            assert!(
                !world.occluded(&shadow, toward.distance, Some(Target { shape: ShapeId(0), facet: toward.facet })),
                "{name}"
            );
        }
        assert!(missed < 40 && odd < 40, "{name}: {missed} missed, {odd} differ");
    }
}

/// χ²: directions in bins over the cone against the density integrated over the bins by rays.
#[test]
fn directions_are_distributed_as_the_density_says() {
    const BINS: [usize; 2] = [12, 16];
    for (name, shape, reference) in cases() {
        let world = World::new(vec![shape.clone()]).unwrap();
        let (axis, cos_min) = cone(&world, reference);
        let (x, y) = frame(axis);
        let bin = |d: DVec3| {
            // 1 − cos from the sine: single-precision directions are not unit to the accuracy that a narrow cone needs.
            let (sin2, cos) = (d.dot(x).powi(2) + d.dot(y).powi(2), d.dot(axis));
            let down = if cos > 0.0 { sin2 / (1.0 + (1.0 - sin2).max(0.0).sqrt()) } else { 1.0 - cos };
            let a = (down / (1.0 - cos_min)).clamp(0.0, 0.999_999);
            let b = (d.dot(y).atan2(d.dot(x)) / std::f64::consts::TAU).rem_euclid(1.0).min(0.999_999);
            (a * BINS[0] as f64) as usize * BINS[1] + (b * BINS[1] as f64) as usize
        };
        let mut expected = vec![0.0; BINS[0] * BINS[1]];
        let mut rays = expected.clone();
        let grid = 800_000;
        for i in 0..grid {
            let [a, b] = lattice(i);
            let direction = in_cone(axis, x, y, cos_min, a as f64, b as f64);
            if let Some(hit) = world.closest(&Ray::free(reference, direction), f32::INFINITY) {
                expected[bin(direction.as_dvec3())] += shape.pdf_toward(reference, direction, &hit) as f64;
                rays[bin(direction.as_dvec3())] += 1.0;
            }
        }
        let cell = std::f64::consts::TAU * (1.0 - cos_min) / grid as f64;
        let n = 20_000u32;
        let mut found = vec![0.0; BINS[0] * BINS[1]];
        // Independent numbers here, or χ² means nothing.
        let mut state = 0x9e3779b97f4a7c15u64;
        let mut unit = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let z = (state ^ (state >> 29)).wrapping_mul(0xbf58476d1ce4e5b9);
            (z >> 40) as f32 / (1u64 << 24) as f32
        };
        for _ in 0..n {
            if let Some(toward) = shape.sample_toward(reference, [unit(), unit()]) {
                found[bin(toward.direction.as_dvec3())] += 1.0;
            }
        }
        let (mut chi2, mut freedom) = (0.0, 0.0);
        for ((f, e), rays) in found.iter().zip(&expected).zip(&rays) {
            let e = e * cell * n as f64;
            if e > 8.0 {
                // The integral has noise of its own where a bin holds few rays.
                chi2 += (f - e) * (f - e) / (e + e * e / rays);
                freedom += 1.0;
            }
        }
        // Wilson and Hilferty: a normal deviate from χ². Four and a half sigma, over 17 cases.
        let z = ((chi2 / freedom).cbrt() - (1.0 - 2.0 / (9.0 * freedom))) / (2.0 / (9.0 * freedom)).sqrt();
        assert!(freedom >= 4.0 && z < 4.5, "{name}: chi² {chi2} of {freedom}, {z} sigma");
    }
}

#[test]
fn a_far_sphere_keeps_its_cone() {
    let sphere: Shape = Sphere::new(Vec3::new(1e5, 2e4, -3e4), 1.0).unwrap().into();
    let distance2 = 1e10 + 4e8 + 9e8f64;
    let exact = std::f64::consts::TAU * (1.0 - (1.0 - 1.0 / distance2).sqrt());
    let mut mean = DVec3::ZERO;
    for i in 0..10_000 {
        let toward = sphere.sample_toward(Vec3::ZERO, lattice(i)).unwrap();
        assert!((1.0 / toward.pdf as f64 / exact - 1.0).abs() < 1e-5);
        assert!((toward.distance as f64 / distance2.sqrt() - 1.0).abs() < 2e-5);
        assert!(toward.normal.dot(toward.direction) <= 1e-6);
        mean += toward.normal.as_dvec3() / 10_000.0;
    }
    // The half that is seen, evenly in projection: mean normal 2/3 toward the reference.
    let back = -DVec3::new(1e5, 2e4, -3e4).normalize();
    assert!((mean - back * (2.0 / 3.0)).length() < 1e-3, "{mean}");
}

#[test]
fn ends_of_the_unit_square_are_safe() {
    for (name, shape, reference) in cases() {
        for u in [0.0, 0.5, 1.0 - f32::EPSILON / 2.0, 1.0] {
            for v in [0.0, 0.5, 1.0 - f32::EPSILON / 2.0, 1.0] {
                if let Some(t) = shape.sample_toward(reference, [u, v]) {
                    assert!(t.point.is_finite() && t.direction.is_finite() && t.distance.is_finite(), "{name} {u} {v}");
                    assert!(t.pdf > 0.0 && t.pdf.is_finite());
                }
            }
        }
    }
    let flat: Shape = Rectangle::new(Vec3::ZERO, Vec3::X, Vec3::Y).unwrap().into();
    assert!(flat.sample_toward(Vec3::new(3.0, 0.0, 0.0), [0.3, 0.6]).is_none(), "in its own plane nothing is seen");
}
