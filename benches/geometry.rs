//! Rays: the way out of a gem, one and eight at once, the nearest of few and of many shapes, and meshes.

#[path = "../tests/common/meshes.rs"]
#[allow(dead_code, reason = "a bench uses a part")]
mod meshes;
#[path = "../tests/common/random.rs"]
#[allow(dead_code, reason = "a bench uses a part")]
mod random;

use std::hint::black_box;
use std::sync::Arc;

use divan::Bencher;
use divan::counter::ItemsCount;
use glam::{Affine3A, Vec3};
use random::Random;
use spectrel::geometry::{
    Brilliant, Convex, Disk, Mesh, Placed, Ray, Rectangle, Shape, ShapeId, Sphere, StepCut, Triangles, World,
};
use spectrel::math::Vectors;

fn main() {
    divan::main();
}

const RAYS: usize = 1024;

/// From facets of the solid to points inside.
fn inner_rays(solid: &Convex) -> Vec<(Vec3, Vec3)> {
    let mut random = Random(1);
    (0..RAYS)
        .map(|_| {
            let toward = solid.center() + random.vector() * (0.3 * solid.radius());
            let exit =
                solid.exit_lanes(&Vectors::<1>::splat(solid.center()), &Vectors::splat(random.vector().normalize()));
            let origin = solid.project(solid.center() + random.vector() * 0.1, exit.facet[0]);
            (origin, (toward - origin).normalize())
        })
        .collect()
}

fn brilliant(girdle_facets: u32) -> Convex {
    Brilliant { girdle_facets, ..Brilliant::default() }.solid().expect("a good cut")
}

/// Time for a thousand rays.
fn exits<const N: usize>(bencher: Bencher, girdle_facets: u32) {
    let solid = brilliant(girdle_facets);
    let rays = inner_rays(&solid);
    let packets: Vec<(Vectors<N>, Vectors<N>)> =
        rays.chunks_exact(N).map(|c| (Vectors::from_fn(|i| c[i].0), Vectors::from_fn(|i| c[i].1))).collect();
    bencher.counter(ItemsCount::new(RAYS)).bench(|| {
        let mut sum = 0;
        for (o, d) in black_box(&packets) {
            sum += solid.exit_lanes(o, d).facet.iter().sum::<u32>();
        }
        sum
    });
}

#[divan::bench(args = [32, 64])]
fn brilliant_exit_1_lane(bencher: Bencher, girdle_facets: u32) {
    exits::<1>(bencher, girdle_facets);
}

#[divan::bench(args = [32, 64])]
fn brilliant_exit_4_lanes(bencher: Bencher, girdle_facets: u32) {
    exits::<4>(bencher, girdle_facets);
}

#[divan::bench(args = [32, 64])]
fn brilliant_exit_8_lanes(bencher: Bencher, girdle_facets: u32) {
    exits::<8>(bencher, girdle_facets);
}

#[divan::bench(args = [32, 64])]
fn brilliant_exit_by_world(bencher: Bencher, girdle_facets: u32) {
    let solid = brilliant(girdle_facets);
    let rays = inner_rays(&solid);
    let world = World::new(vec![solid.into()]).expect("one shape");
    let departs = spectrel::geometry::Departure::Surface {
        shape: ShapeId(0),
        facet: 0,
        side: spectrel::geometry::Side::Inside,
        place: 0,
    };
    bencher.counter(ItemsCount::new(RAYS)).bench(|| {
        let mut sum = 0;
        for &(origin, direction) in black_box(&rays) {
            sum += world.closest(&Ray { origin, direction, departs }, f32::INFINITY).map_or(0, |h| h.facet);
        }
        sum
    });
}

/// A table, walls, lamps, balls and two stones.
fn small(count: usize) -> World {
    let mut shapes: Vec<Shape> = vec![
        Rectangle::new(Vec3::ZERO, Vec3::X * 10.0, Vec3::Y * 10.0).expect("table").into(),
        Rectangle::new(Vec3::Z * 5.0, Vec3::X, -Vec3::Y).expect("lamp").into(),
        brilliant(64).into(),
        Sphere::new(Vec3::new(1.0, 0.3, 0.4), 0.4).expect("ball").into(),
        Disk::facing(Vec3::new(-3.0, 0.0, 3.0), Vec3::new(1.0, 0.0, -1.0), 0.5).expect("lamp").into(),
        Sphere::new(Vec3::new(-1.0, 0.3, 0.3), 0.3).expect("ball").into(),
        Convex::cuboid(Vec3::new(0.2, 1.5, 0.4), Vec3::splat(0.4)).expect("box").into(),
        StepCut::default().solid().expect("cut").into(),
        Rectangle::new(Vec3::X * 5.0, Vec3::Y * 10.0, Vec3::Z * 10.0).expect("wall").into(),
        Rectangle::new(Vec3::Y * 5.0, Vec3::Z * 10.0, Vec3::X * 10.0).expect("wall").into(),
        Rectangle::new(Vec3::X * -5.0, Vec3::Z * 10.0, Vec3::Y * 10.0).expect("wall").into(),
        Rectangle::new(Vec3::Y * -5.0, Vec3::X * 10.0, Vec3::Z * 10.0).expect("wall").into(),
    ];
    shapes.truncate(count);
    World::new(shapes).expect("few shapes")
}

fn many() -> World {
    let mut random = Random(3);
    let shapes = (0..1000).map(|i| {
        let center = random.vector() * 2.0;
        match i % 3 {
            0 => Sphere::new(center, 0.05 + 0.1 * random.unit()).map(Shape::from),
            1 => Rectangle::new(center, random.vector() * 0.3, random.vector() * 0.3).map(Shape::from),
            _ => Convex::cuboid(center, Vec3::splat(0.05 + 0.1 * random.unit())).map(Shape::from),
        }
    });
    World::new(shapes.filter_map(Result::ok).collect()).expect("a thousand shapes")
}

fn outer_rays() -> Vec<Ray> {
    let mut random = Random(2);
    (0..RAYS)
        .map(|_| {
            let origin = random.vector() * 2.0 + Vec3::Z * 2.0;
            Ray::free(origin, (random.vector() * 1.5 - origin).normalize())
        })
        .collect()
}

fn closest(bencher: Bencher, world: &World) {
    let rays = outer_rays();
    bencher.counter(ItemsCount::new(RAYS)).bench(|| {
        let mut sum = 0.0;
        for ray in black_box(&rays) {
            sum += world.closest(ray, f32::INFINITY).map_or(0.0, |h| h.t);
        }
        sum
    });
}

#[divan::bench(args = [2, 4, 6, 8, 12])]
fn closest_of_few(bencher: Bencher, count: usize) {
    closest(bencher, &small(count));
}

#[divan::bench]
fn closest_of_a_thousand(bencher: Bencher) {
    closest(bencher, &many());
}

#[divan::bench]
fn occluded_of_a_thousand(bencher: Bencher) {
    let (world, rays) = (many(), outer_rays());
    bencher.counter(ItemsCount::new(RAYS)).bench(|| {
        let mut sum = 0;
        for ray in black_box(&rays) {
            sum += world.occluded(ray, 4.0, None) as u32;
        }
        sum
    });
}

#[divan::bench(args = ["sphere", "rectangle", "disk", "brilliant"])]
fn sample_toward(bencher: Bencher, name: &str) {
    let shape: Shape = match name {
        "sphere" => Sphere::new(Vec3::ZERO, 0.5).expect("ball").into(),
        "rectangle" => Rectangle::new(Vec3::ZERO, Vec3::X, Vec3::Y).expect("lamp").into(),
        "disk" => Disk::facing(Vec3::ZERO, Vec3::Z, 0.5).expect("lamp").into(),
        _ => brilliant(64).into(),
    };
    let mut random = Random(4);
    let points: Vec<Vec3> = (0..RAYS).map(|_| random.vector() + Vec3::Z * 2.0).collect();
    bencher.counter(ItemsCount::new(RAYS)).bench_local(|| {
        let mut sum = 0.0;
        for &point in black_box(&points) {
            sum += shape.sample_toward(point, [random.unit(), random.unit()]).map_or(0.0, |t| t.pdf);
        }
        sum
    });
}

/// A bumpy ball of 327,680 triangles.
fn blob() -> Triangles {
    meshes::blob(7, 0.05)
}

#[divan::bench]
fn mesh_build(bencher: Bencher) {
    let triangles = blob();
    let count = triangles.indices.len();
    bencher
        .counter(ItemsCount::new(count))
        .with_inputs(|| triangles.clone())
        .bench_values(|t| Mesh::new(t).expect("a mesh"));
}

/// Rays that come from outside, as a camera's do, and rays that set off inwards from where those arrive, as in glass.
#[divan::bench(args = ["from outside", "within", "copy, from outside", "occluded"])]
fn mesh_rays(bencher: Bencher, kind: &str) {
    let mut placed = Placed::new(Arc::new(Mesh::new(blob()).expect("a mesh")));
    if kind.starts_with("copy") {
        placed = placed.transformed(&Affine3A::from_rotation_x(0.3)).expect("turned");
    }
    let world = World::new(vec![placed.into()]).expect("one shape");
    let mut rays = outer_rays();
    if kind == "within" {
        let mut random = Random(5);
        let hits = rays.iter().filter_map(|ray| world.closest(ray, f32::INFINITY));
        rays = hits
            .map(|hit| {
                let d = random.vector().normalize_or(Vec3::X);
                Ray::leaving(&hit, spectrel::geometry::Side::Inside, if d.dot(hit.normal) < 0.0 { d } else { -d })
            })
            .collect();
    }
    bencher.counter(ItemsCount::new(rays.len())).bench(|| {
        let mut sum = 0.0;
        for ray in black_box(&rays) {
            sum += match kind {
                "occluded" => f32::from(world.occluded(ray, f32::INFINITY, None)),
                _ => world.closest(ray, f32::INFINITY).map_or(0.0, |hit| hit.t),
            };
        }
        sum
    });
}
