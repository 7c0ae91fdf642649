//! The light that the tree finds: by quadrature in f64 over every lamp, and by renders of two lamps at a time, which need no tree.

use super::lamps::{Kind, direction, room, vector};
use crate::common::compare::{cells, renders};
use crate::common::{mean_and_error, scene};
use crate::statistics::Random;
use glam::{DVec3, Vec3};
use spectrel::geometry::Shape;
use spectrel::light::{FEW, Receiver, Source};
use spectrel::scene::{Needs, Overrides};
use std::fmt::Write;
use std::ops::Range;

/// Irradiance from a lamp of radiance 1, by 48 × 48 points of a square or on paper for a ball above the horizon.
fn irradiance(shape: &Shape, point: DVec3, normal: DVec3) -> f64 {
    match shape {
        Shape::Sphere(sphere) => {
            let toward = sphere.center().as_dvec3() - point;
            let sine2 = f64::from(sphere.radius()).powi(2) / toward.length_squared();
            std::f64::consts::PI * sine2 * normal.dot(toward.normalize())
        }
        Shape::Rectangle(rectangle) => {
            let n = 48;
            let at = |i: usize| 2.0 * (i as f64 + 0.5) / n as f64 - 1.0;
            let [u, v] = rectangle.edges().map(Vec3::as_dvec3);
            let (center, facing) = (rectangle.center().as_dvec3(), rectangle.normal().as_dvec3());
            let one = |i: usize, j: usize| {
                let toward = center + u * at(i) + v * at(j) - point;
                let (far, direction) = (toward.length_squared(), toward.normalize());
                (normal.dot(direction).max(0.0) * -facing.dot(direction)).max(0.0) / far
            };
            let sum: f64 = (0..n * n).map(|k| one(k / n, k % n)).sum();
            sum * f64::from(rectangle.area()) / (n * n) as f64
        }
        _ => panic!("no such lamps here"),
    }
}

#[test]
fn sampled_irradiance_is_that_of_all_lamps() {
    let mut random = Random::new(31);
    for (kind, count) in [(Kind::Ceiling, 40), (Kind::Balls, 40), (Kind::Ceiling, 300), (Kind::Balls, 300)] {
        let lamps = room(9, kind, count, false);
        for floor in [true, true, kind == Kind::Balls] {
            let point = vector(&mut random, [-5.0, -5.0, 0.0], [5.0, 5.0, if floor { 0.0 } else { 0.3 }]);
            // What lies partly below a tilted horizon is no ball any more: only squares are lit from there.
            let tilted = (Vec3::Z + 0.8 * direction(&mut random)).normalize();
            let normal = if kind == Kind::Ceiling && random.unit() < 0.5 { tilted } else { Vec3::Z };
            let receiver = Receiver { point, normal: Some(normal) };
            let expected: f64 =
                lamps.world.shapes().iter().map(|shape| irradiance(shape, point.as_dvec3(), normal.as_dvec3())).sum();
            let mut one = || {
                let light = lamps.lights.sample(&lamps.world, &receiver, random.unit(), random.point());
                light.map_or(0.0, |light| f64::from(normal.dot(light.direction).max(0.0) / light.pdf))
            };
            let batches: Vec<f64> = (0..40).map(|_| (0..5000).map(|_| one()).sum::<f64>() / 5000.0).collect();
            let (mean, error) = mean_and_error(&batches);
            let z = (mean - expected).abs() / error;
            assert!(error < 0.002 * expected, "{kind:?} {count}: a per cent would not be seen");
            assert!(z < 4.5, "{kind:?} {count}: {mean} ± {error} for {expected}");
        }
    }
}

const HEAD: &str = "
[render]
width = 12
height = 8
samples = 16
max_depth = 4
[camera]
position = [0, -7, 3]
look_at = [0, 0, 0.6]
fov = 40
[materials.grey.diffuse]
reflectance = 0.5
[materials.satin.conductor]
ior = \"Cu/mcpeak-2015\"
roughness = 0.4
[materials.frosted.dielectric]
ior = 1.5
roughness = 0.4
[[objects]]
material = \"grey\"
shape.rectangle = { size = [14, 14] }
[[objects]]
material = \"satin\"
shape.sphere = { center = [-1.2, 0, 0.81], radius = 0.8 }
[[objects]]
material = \"frosted\"
shape.sphere = { center = [1, 0.4, 0.81], radius = 0.8 }
";

/// Lamps of different colours, sizes, strengths and orientations above a floor, out of the camera's sight; only some are lit.
fn lamps(count: usize, lit: Range<usize>) -> String {
    let mut random = Random::new(77);
    let mut lamp = |index: usize| {
        let [x, y, z] = vector(&mut random, [-6.0, -6.0, 3.5], [6.0, 6.0, 5.0]).to_array();
        let [nx, ny, nz] = (direction(&mut random) - 0.5 * Vec3::Z).to_array();
        let (size, luminance) = (0.05 + 0.2 * random.unit(), 200.0 * 10f32.powf(random.unit()));
        let shape = match index % 4 {
            0 => format!("sphere = {{ center = [{x}, {y}, {z}], radius = {} }}", 0.5 * size),
            1 => format!("disk = {{ center = [{x}, {y}, {z}], radius = {size}, normal = [{nx}, {ny}, {nz}] }}"),
            2 => format!("box = {{ center = [{x}, {y}, {z}], size = [{size}, {size}, {size}] }}"),
            _ => {
                format!("rectangle = {{ center = [{x}, {y}, {z}], size = [{size}, 0.3], normal = [{nx}, {ny}, {nz}] }}")
            }
        };
        let luminance = if lit.contains(&index) { luminance } else { 0.0 };
        let spectrum = ["{ blackbody = 2000 }", "\"D65\"", "{ daylight = 9000 }"][index % 3];
        let both = if index % 8 == 3 { ", two_sided = true" } else { "" };
        format!("[[objects]]\nshape.{shape}\nemission = {{ spectrum = {spectrum}, luminance = {luminance}{both} }}\n")
    };
    (0..count).map(&mut lamp).collect()
}

#[test]
fn two_hundred_lamps_are_a_hundred_times_two() {
    const SEEDS: u64 = 12;
    const GRID: [u32; 2] = [2, 1];
    const COUNT: usize = 200;
    let lit = |lit: Range<usize>| format!("{HEAD}{}", lamps(COUNT, lit));
    let mut all = scene(&lit(0..COUNT), &Overrides { samples: Some(512), ..Overrides::default() });
    assert_eq!(all.lights.in_tree(), 200);
    let said = Needs::of(&all).decisions;
    assert!(
        said.iter().any(|decision| decision.part == "light tree" && decision.used && decision.reason.contains("200"))
    );
    let tree: Vec<_> = renders(&mut all, 0..SEEDS).iter().map(|film| cells(film, GRID)).collect();
    let mut sums = vec![vec![[0.0; 3]; 2]; SEEDS as usize];
    for first in (0..COUNT).step_by(FEW) {
        // All lamps are there, for they hide each other and the floor.
        let mut few = scene(&lit(first..first + FEW), &Overrides::default());
        assert_eq!(few.lights.in_tree(), 0);
        let seeds = SEEDS * (1 + first as u64)..SEEDS * (2 + first as u64);
        for (sum, film) in sums.iter_mut().zip(renders(&mut few, seeds)) {
            for (sum, cell) in sum.iter_mut().zip(cells(&film, GRID)) {
                *sum = std::array::from_fn(|i| sum[i] + cell[i]);
            }
        }
    }
    let mut report = String::new();
    let mut worst: f64 = 0.0;
    for cell in 0..2 {
        for i in 0..3 {
            let differences: Vec<f64> = tree.iter().zip(&sums).map(|(a, b)| a[cell][i] / b[cell][i] - 1.0).collect();
            let (mean, error) = mean_and_error(&differences);
            worst = worst.max(mean.abs() / error);
            writeln!(report, "cell {cell}, {}: {mean:+.4} ± {error:.4}", ["X", "Y", "Z"][i]).expect("a string");
            assert!(error < 0.006, "four per cent would not be seen\n{report}");
        }
    }
    // Six comparisons with 11 degrees of freedom, one failure in a thousand.
    assert!(worst < 5.7, "t = {worst:.1}\n{report}");
    println!("{report}");
}

/// Lamps near each other at every scale, and in one place: trees of them are grown, and all of them are found.
#[test]
fn lamps_at_all_scales_and_in_one_place_are_all_found() {
    use spectrel::geometry::{ShapeId, Sphere, World};
    use spectrel::light::{Emitter, Environment, Lights};
    use spectrel::spectrum::{Arena, Spectrum};
    let radiance = Arena::default().add(Spectrum::Constant(1.0));
    let balls = |place: &dyn Fn(i32) -> (Vec3, f32), count: i32| {
        let shapes: Vec<Shape> = (0..count)
            .map(|i| {
                let (center, radius) = place(i);
                Sphere::new(center, radius).expect("a ball").into()
            })
            .collect();
        let emitters = (0..count as u32).map(|i| Emitter {
            source: Source::Shape { id: ShapeId(i), two_sided: false },
            radiance,
            power: f64::from(shapes[i as usize].area()),
        });
        let emitters = emitters.collect();
        let world = World::new(shapes).expect("a world");
        Lights::new(emitters, Environment::Dark, &world)
    };
    let spread = balls(&|i| (Vec3::new(2f32.powi(i - 30), 0.0, 0.0), 2f32.powi(i - 40)), 60);
    let heap = balls(&|_| (Vec3::ONE, 0.5), 5000);
    for lights in [spread, heap] {
        for point in [Vec3::ZERO, Vec3::ONE, Vec3::new(1e-7, 1e-8, 0.0), Vec3::splat(1e6)] {
            let receiver = Receiver { point, normal: None };
            let all = (0..lights.emitters().len()).map(|i| f64::from(lights.probability(&receiver, i)));
            let all: Vec<f64> = all.collect();
            assert!(all.iter().all(|p| *p > 0.0));
            assert!((all.iter().sum::<f64>() - 1.0).abs() < 1e-5, "{point}: {}", all.iter().sum::<f64>());
        }
    }
}
