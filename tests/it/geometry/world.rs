//! The world against a loop over its shapes, against formulas, and where surfaces touch.

use crate::common::random::Random;
use glam::{Affine3A, DVec3, Quat, Vec3};
use proptest::prelude::*;
use spectrel::geometry::{
    Brilliant, Convex, Departure, Disk, GeometryError, Plane, Ray, Rectangle, Shape, ShapeId, Side, Sphere, Target,
    World,
};
use spectrel::math::Vectors;

fn shape(random: &mut Random, place: f32, size: f32) -> Shape {
    let center = random.vector() * place;
    let (u, v) = (random.direction() * size, random.direction() * size);
    let made: Result<Shape, GeometryError> = match (random.unit() * 4.0) as u32 {
        0 => Sphere::new(center, size).map(Into::into),
        1 => Rectangle::new(center, u, v).map(Into::into),
        2 => Disk::new(center, u, v).map(Into::into),
        _ => Convex::cuboid(Vec3::ZERO, Vec3::new(0.3, 0.7, 1.0) * size).map(Shape::from).and_then(|s| {
            s.transformed(&Affine3A::from_rotation_translation(Quat::from_axis_angle(random.direction(), 1.0), center))
        }),
    };
    made.unwrap()
}

fn ray(random: &mut Random, shapes: usize) -> Ray {
    let departs = match random.unit() {
        x if x < 0.5 => Departure::Free,
        x => Departure::Surface {
            shape: ShapeId((random.unit() * shapes as f32) as u32),
            facet: 0,
            side: if x < 0.9 { Side::Outside } else { Side::Inside },
            place: 0,
        },
    };
    let mut direction = random.direction();
    if random.unit() < 0.2 {
        direction = [Vec3::X, -Vec3::Y, Vec3::Z, Vec3::new(0.6, 0.0, -0.8)][(random.unit() * 4.0) as usize];
    }
    Ray { origin: random.vector() * 1.5, direction, departs }
}

#[test]
fn tree_and_list_agree() {
    let mut random = Random(11);
    for (count, size) in [(1, 0.5), (7, 0.4), (9, 0.3), (50, 0.2), (1000, 0.05), (1000, 0.3)] {
        let shapes: Vec<Shape> = (0..count).map(|_| shape(&mut random, 1.0, size)).collect();
        let world = World::new(shapes.clone()).unwrap();
        // A world of one shape is a list: the nearest of a thousand of them is the truth. Ids differ, so departures from
        // anything but nowhere are left to the departed shape being absent.
        let alone: Vec<World> = shapes.iter().map(|s| World::new(vec![s.clone()]).unwrap()).collect();
        let (mut hits, mut hidden) = (0, 0);
        for _ in 0..2000 {
            let mut ray = ray(&mut random, count);
            ray.departs = Departure::Free;
            let found = world.closest(&ray, f32::INFINITY);
            let mut best: Option<(f32, u32)> = None;
            for (i, w) in alone.iter().enumerate() {
                if let Some(hit) = w.closest(&ray, f32::INFINITY)
                    && best.is_none_or(|b| hit.t < b.0)
                {
                    best = Some((hit.t, i as u32));
                }
            }
            assert_eq!(found.map(|h| (h.t, h.shape.0)), best);
            hits += found.is_some() as u32;
            if let Some(hit) = found {
                assert!(world.occluded(&ray, f32::INFINITY, None));
                assert!(world.occluded(&ray, hit.t * 1.01 + 1e-4, None));
                assert!(!world.occluded(&ray, hit.t * 0.999, None));
                assert!(!world.occluded(&ray, hit.t, None));
                hidden += 1;
            } else {
                assert!(!world.occluded(&ray, f32::INFINITY, None));
            }
        }
        assert!(hits > 0 && hidden > 0, "{count}");
    }
}

#[test]
fn departed_shapes_are_not_met_again() {
    let mut random = Random(13);
    for count in [3, 100] {
        let shapes: Vec<Shape> = (0..count).map(|_| shape(&mut random, 1.0, 0.3)).collect();
        let world = World::new(shapes).unwrap();
        for _ in 0..5000 {
            let mut ray = ray(&mut random, count);
            for _ in 0..10 {
                let Some(hit) = world.closest(&ray, f32::INFINITY) else { break };
                let met = world.shape(hit.shape).unwrap();
                if let Departure::Surface { shape, side, .. } = ray.departs {
                    assert!(hit.shape != shape || (side == Side::Inside && met.is_solid() && hit.side == Side::Inside));
                }
                // On, half through and half back.
                let through = random.unit() < 0.5;
                let side = if through { hit.side.opposite() } else { hit.side };
                let out = if side == Side::Outside { hit.normal } else { -hit.normal };
                let mut direction = random.direction();
                if direction.dot(out) < 0.0 {
                    direction = -direction;
                }
                ray = Ray::leaving(&hit, side, direction);
            }
        }
    }
}

#[test]
fn distances_agree_with_formulas() {
    let mut random = Random(17);
    let sphere = World::new(vec![Sphere::new(Vec3::new(1.0, 2.0, 3.0), 0.75).unwrap().into()]).unwrap();
    let cuboid = Convex::cuboid(Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.5, 1.0, 0.25)).unwrap();
    let cuboid = World::new(vec![cuboid.into()]).unwrap();
    let center = DVec3::new(1.0, 2.0, 3.0);
    for i in 0..100_000 {
        let far = [2.0, 10.0, 1e4][i % 3];
        let origin = random.direction() * far + center.as_vec3();
        let aim = center.as_vec3() + random.vector() * 0.9;
        let direction = (aim - origin).normalize();
        let (o, d) = (origin.as_dvec3() - center, direction.as_dvec3());
        let (a, b, c) = (d.length_squared(), o.dot(d), o.length_squared() - 0.75f64 * 0.75);
        let discriminant = b * b - a * c;
        let hit = sphere.closest(&Ray::free(origin, direction), f32::INFINITY);
        let error = 2e-6 * far as f64;
        if discriminant.abs() > error {
            assert_eq!(hit.is_some(), discriminant > 0.0 && b < 0.0);
        }
        if let Some(hit) = hit
            && discriminant > 0.01
        {
            let t = (-b - discriminant.sqrt()) / a;
            assert!((hit.t as f64 - t).abs() < error, "{} {t}", hit.t);
            assert!(((hit.point.as_dvec3() - center).length() - 0.75).abs() < 1e-6);
            assert!(hit.normal.dot(direction) < 0.0);
        }
        let hit = cuboid.closest(&Ray::free(origin, direction), f32::INFINITY);
        let h = DVec3::new(0.5, 1.0, 0.25);
        let (t0, t1) = ((-h - o) / d, (h - o) / d);
        let (near, far_t) = (t0.min(t1).max_element(), t0.max(t1).min_element());
        if (far_t - near).abs() > 10.0 * error {
            assert_eq!(hit.is_some(), near < far_t && far_t > 0.0);
        }
        if let Some(hit) = hit
            && near + 10.0 * error < far_t
        {
            assert!((hit.t as f64 - near).abs() < 10.0 * error, "{} {near} {far}", hit.t);
        }
    }
}

#[test]
fn a_closed_room_of_rectangles_has_no_cracks() {
    // Six walls of the unit cube, turned, fronts inward, attacked at the edges where walls only just meet.
    let turn = Affine3A::from_rotation_translation(Quat::from_rotation_y(0.4), Vec3::new(3.0, 0.1, -2.0));
    let axes = [(Vec3::X, Vec3::Y, Vec3::Z), (Vec3::Y, Vec3::Z, Vec3::X), (Vec3::Z, Vec3::X, Vec3::Y)];
    let walls: Vec<Shape> = axes
        .iter()
        .flat_map(|&(n, u, v)| [Rectangle::new(n, v * 2.0, u * 2.0), Rectangle::new(-n, u * 2.0, v * 2.0)])
        .map(|wall| Shape::from(wall.unwrap()).transformed(&turn).unwrap())
        .collect();
    let world = World::new(walls).unwrap();
    let mut random = Random(19);
    let mut leaks = 0;
    for _ in 0..100_000 {
        let mut edge = random.vector();
        edge.x = edge.x.signum();
        edge.y = edge.y.signum();
        let mut ray = Ray::free(turn.transform_point3(random.vector() * 0.9), Vec3::Z);
        ray.direction = (turn.transform_point3(edge) - ray.origin).normalize();
        // The second and third ray set off from the very edge.
        for _ in 0..3 {
            let Some(hit) = world.closest(&ray, f32::INFINITY) else {
                leaks += 1;
                break;
            };
            assert_eq!(hit.side, Side::Outside, "behind a wall");
            let mut direction = random.direction();
            if direction.dot(hit.normal) < 0.0 {
                direction = -direction;
            }
            ray = Ray::leaving(&hit, Side::Outside, direction);
        }
    }
    assert_eq!(leaks, 0);
}

#[test]
fn light_under_a_stone_on_a_table_goes_through_both() {
    // Table and stone share a plane that is no round number; rays go down through the stone onto the table and back up.
    let turn = Affine3A::from_rotation_translation(
        Quat::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), 0.7),
        Vec3::new(5.0, 3.0, 1.0),
    );
    let stone = Convex::cuboid(Vec3::new(0.0, 0.0, 0.5), Vec3::splat(0.5)).unwrap();
    let table = Rectangle::new(Vec3::ZERO, Vec3::X * 20.0, Vec3::Y * 20.0).unwrap();
    for order in 0..2 {
        let mut shapes = [Shape::from(stone.clone()), Shape::from(table)];
        shapes.rotate_left(order);
        let (stone_id, table_id) = (ShapeId(order as u32), ShapeId(1 - order as u32));
        let shapes = shapes.iter().map(|s| s.transformed(&turn).unwrap()).collect();
        let world = World::new(shapes).unwrap();
        assert!(world.stands_alone(stone_id));
        let mut random = Random(23);
        for _ in 0..20_000 {
            let local = Vec3::new(random.unit() - 0.5, random.unit() - 0.5, 0.3) * 0.98;
            let down = turn.transform_vector3(Vec3::new(random.unit() - 0.5, random.unit() - 0.5, -2.0)).normalize();
            let start = Ray { origin: turn.transform_point3(local), direction: down, departs: Departure::Free };
            let exit = world.closest(&start, f32::INFINITY).unwrap();
            if exit.shape != stone_id {
                // A free ray does not know that it is in the stone; rounding may put the table first.
                assert!(exit.shape == table_id);
                continue;
            }
            let inside = Ray {
                departs: Departure::Surface { shape: stone_id, facet: 0, side: Side::Inside, place: 0 },
                ..start
            };
            let exit = world.closest(&inside, f32::INFINITY).unwrap();
            assert_eq!((exit.shape, exit.side), (stone_id, Side::Inside));
            let local_exit = turn.inverse().transform_point3(exit.point);
            if local_exit.z.abs() > 1e-5 {
                continue; // Through a side.
            }
            let table_hit = world.closest(&Ray::leaving(&exit, Side::Outside, down), f32::INFINITY).unwrap();
            assert_eq!((table_hit.shape, table_hit.side), (table_id, Side::Outside));
            assert!(table_hit.t < 1e-5);
            let up = -down;
            let back = world.closest(&Ray::leaving(&table_hit, Side::Outside, up), f32::INFINITY).unwrap();
            assert_eq!((back.shape, back.side), (stone_id, Side::Outside), "the stone is entered");
            assert!(back.t < 1e-5);
            let across = world.closest(&Ray::leaving(&back, Side::Inside, up), f32::INFINITY).unwrap();
            assert_eq!((across.shape, across.side), (stone_id, Side::Inside));
            assert!(across.t > 0.29);
            // An inner reflection at the bottom does not see the table it lies on.
            let inner = world.closest(&Ray::leaving(&exit, Side::Inside, up), f32::INFINITY).unwrap();
            assert_eq!((inner.shape, inner.side), (stone_id, Side::Inside));
        }
    }
}

#[test]
fn lamps_that_touch_other_shapes_are_seen() {
    // A lamp in the plane of the ceiling, and a ball of light that lies on it from below; all turned away from the axes.
    let turn = Affine3A::from_rotation_translation(
        Quat::from_axis_angle(Vec3::new(0.0, 0.6, 0.8), 0.9),
        Vec3::new(2.0, 7.0, -1.0),
    );
    let shapes: Vec<Shape> = [
        Rectangle::new(Vec3::Z * 3.0, Vec3::Y * 8.0, Vec3::X * 8.0).unwrap().into(),
        Rectangle::new(Vec3::Z * 3.0, Vec3::Y, Vec3::X).unwrap().into(),
        Shape::from(Sphere::new(Vec3::new(2.0, 1.0, 2.75), 0.25).unwrap()),
        Rectangle::new(Vec3::ZERO, Vec3::X * 8.0, Vec3::Y * 8.0).unwrap().into(),
    ]
    .iter()
    .map(|s: &Shape| s.transformed(&turn).unwrap())
    .collect();
    let world = World::new(shapes).unwrap();
    let mut random = Random(29);
    for _ in 0..50_000 {
        let floor = turn.transform_point3(Vec3::new(random.unit() * 7.0 - 3.5, random.unit() * 7.0 - 3.5, 0.0));
        let up = turn.transform_vector3(Vec3::new(random.unit() - 0.5, random.unit() - 0.5, -1.0));
        let start = Ray::free(floor - up * 0.1, up.normalize());
        let hit = world.closest(&start, f32::INFINITY).unwrap();
        assert_eq!(hit.shape, ShapeId(3));
        for lamp in [ShapeId(1), ShapeId(2)] {
            let toward = world.shape(lamp).unwrap().sample_toward(hit.point, [random.unit(), random.unit()]).unwrap();
            let shadow = Ray::leaving(&hit, Side::Outside, toward.direction);
            let ball_between =
                lamp == ShapeId(1) && world.closest(&shadow, f32::INFINITY).is_some_and(|h| h.shape == ShapeId(2));
            assert_eq!(
                world.occluded(&shadow, toward.distance, Some(Target { shape: lamp, facet: toward.facet })),
                ball_between
            );
        }
    }
}

#[test]
fn odd_worlds_are_searched_too() {
    // All boxes the same, and sizes over thirty orders of magnitude: the tree may be as deep as it likes.
    let same: Vec<Shape> = (0..3000).map(|_| Sphere::new(Vec3::X, 0.5).unwrap().into()).collect();
    let world = World::new(same).unwrap();
    let hit = world.closest(&Ray::free(Vec3::ZERO, Vec3::X), f32::INFINITY).unwrap();
    assert_eq!((hit.t, hit.shape), (0.5, ShapeId(0)), "the first of equals");
    let nested: Vec<Shape> =
        (0..300).map(|i| Sphere::new(Vec3::ZERO, libm::powf(1.2, i as f32 - 150.0)).unwrap().into()).collect();
    let world = World::new(nested).unwrap();
    let far = world.bounds().max.x * 2.0;
    let hit = world.closest(&Ray::free(Vec3::X * far, -Vec3::X), f32::INFINITY).unwrap();
    assert_eq!(hit.shape, ShapeId(299));
    let next = world.closest(&Ray::leaving(&hit, Side::Inside, -Vec3::X), f32::INFINITY).unwrap();
    assert_eq!((next.shape, next.side), (ShapeId(298), Side::Outside));
}

#[test]
fn contact() {
    let cuboid = |c: Vec3, h: f32| Shape::from(Convex::cuboid(c, Vec3::splat(h)).unwrap());
    let ball = |c: Vec3, r: f32| Shape::from(Sphere::new(c, r).unwrap());
    let table = Shape::from(Rectangle::new(Vec3::ZERO, Vec3::X * 10.0, Vec3::Y * 10.0).unwrap());
    let stone = Shape::from(Brilliant::default().solid().unwrap());
    let standing = cuboid(Vec3::new(0.3, 0.2, 0.7), 0.7);
    // (solid, other, may touch inside)
    let cases = [
        (&standing, &table, false),
        (&cuboid(Vec3::new(0.3, 0.2, 0.69), 0.7), &table, true),
        (&stone, &table, false),
        (&ball(Vec3::Z * 0.5, 0.5), &table, false),
        (&ball(Vec3::Z * 0.49, 0.5), &table, true),
        (&table, &stone, false),
        // A prong that bites into the girdle, and one that only leans on a facet's plane.
        (&stone, &ball(Vec3::new(0.5, 0.0, 0.46), 0.05), true),
        (&stone, &ball(Vec3::new(0.7, 0.0, 0.46), 0.05), false),
        // Faces in common.
        (&standing, &cuboid(Vec3::new(0.3, 0.2, 2.1), 0.7), false),
        (&standing, &cuboid(Vec3::new(1.7, 0.2, 0.7), 0.7), false),
        (&standing, &cuboid(Vec3::new(1.69, 0.2, 0.7), 0.7), true),
        // An inclusion, and a room around.
        (&standing, &ball(Vec3::new(0.3, 0.2, 0.7), 0.1), true),
        (&ball(Vec3::new(0.3, 0.2, 0.7), 0.1), &standing, false),
        (&ball(Vec3::ZERO, 1.0), &ball(Vec3::X * 2.0, 1.0), false),
        (&ball(Vec3::ZERO, 1.0), &ball(Vec3::X * 1.99, 1.0), true),
        // Apart, though only an oblique direction shows it.
        (&cuboid(Vec3::ZERO, 1.0), &ball(Vec3::splat(1.6), 1.0), false),
        (&cuboid(Vec3::ZERO, 1.0), &ball(Vec3::splat(1.55), 1.0), true),
    ];
    for (i, (solid, other, touches)) in cases.into_iter().enumerate() {
        assert_eq!(solid.may_touch_inside(other), touches, "case {i}");
        // The same far away, small and turned, where coordinates are not round.
        let turn = Affine3A::from_scale_rotation_translation(
            Vec3::splat(0.013),
            Quat::from_axis_angle(Vec3::new(0.0, 0.6, 0.8), 1.1),
            Vec3::new(0.1, -0.3, 0.2),
        );
        let (solid, other) = (solid.transformed(&turn).unwrap(), other.transformed(&turn).unwrap());
        assert_eq!(solid.may_touch_inside(&other), touches, "turned case {i}");
    }
}

#[test]
fn transforms() {
    let map = Affine3A::from_scale_rotation_translation(Vec3::splat(2.0), Quat::from_rotation_z(0.5), Vec3::X);
    let mirror = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    let shear = Affine3A::from_cols(Vec3::X.into(), Vec3::new(0.5, 1.0, 0.0).into(), Vec3::Z.into(), Vec3::ZERO.into());
    let sphere = Sphere::new(Vec3::Y, 0.5).unwrap();
    assert!((sphere.transformed(&map).unwrap().radius() - 1.0).abs() < 1e-6);
    assert!(sphere.transformed(&mirror).is_ok());
    assert_eq!(sphere.transformed(&shear), Err(GeometryError::Ellipsoid));
    assert_eq!(sphere.transformed(&Affine3A::from_scale(Vec3::new(1.0, 1.0, 1.1))), Err(GeometryError::Ellipsoid));
    assert_eq!(sphere.transformed(&Affine3A::from_scale(Vec3::ZERO)), Err(GeometryError::Singular));
    // A tilted front keeps looking to where its matter went.
    let flat = Rectangle::new(Vec3::ZERO, Vec3::Y, Vec3::Z).unwrap();
    assert_eq!(flat.normal(), Vec3::X);
    assert_eq!(flat.transformed(&mirror).unwrap().normal(), -Vec3::X);
    assert_eq!(Disk::new(Vec3::ZERO, Vec3::Y, Vec3::Z).unwrap().transformed(&mirror).unwrap().normal(), -Vec3::X);
    let flat = Rectangle::new(Vec3::ZERO, Vec3::X, Vec3::Y).unwrap();
    assert!((flat.transformed(&shear).unwrap().area() - 1.0).abs() < 1e-6);
    let solid = Convex::cuboid(Vec3::X, Vec3::ONE).unwrap();
    for (affine, volume) in [(map, 64.0), (mirror, 8.0), (shear, 8.0)] {
        let image = solid.transformed(&affine).unwrap();
        assert_eq!(image.facets().len(), 6);
        assert!((image.volume() - volume).abs() < 1e-4);
        for &v in solid.vertices() {
            let moved = affine.transform_point3(v);
            assert!(image.vertices().iter().any(|w| w.distance(moved) < 1e-5));
        }
    }
    assert_eq!(solid.transformed(&Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0))).err(), Some(GeometryError::Singular));
    let nan = Affine3A::from_translation(Vec3::NAN);
    assert!(matches!(solid.transformed(&nan), Err(GeometryError::NotFinite { .. })));
}

/// Turned, stretched, sheared and mirrored, near and far, and copies of copies: the solid that is cut anew from the moved planes.
#[test]
fn copies_of_a_convex_solid_are_what_cutting_it_anew_makes() {
    let solid = Brilliant::default().solid().unwrap();
    let turn = Quat::from_axis_angle(Vec3::new(0.3, -0.5, 0.8).normalize(), 1.1);
    let shear = Affine3A::from_cols(Vec3::X.into(), Vec3::new(0.5, 1.0, 0.0).into(), Vec3::Z.into(), Vec3::ZERO.into());
    let mirror = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    let maps = [
        Affine3A::from_translation(Vec3::new(3.0, -2.0, 0.5)),
        Affine3A::from_scale_rotation_translation(Vec3::splat(2.5), turn, Vec3::new(1.0, 2.0, -7.0)),
        Affine3A::from_scale_rotation_translation(Vec3::new(1.0, 2.0, 0.7), turn, Vec3::X),
        Affine3A::from_quat(turn) * mirror,
        shear,
    ];
    for map in maps {
        alike(&solid.copied(&map).unwrap(), &solid.transformed(&map).unwrap());
        let twice = solid.copied(&map).unwrap().copied(&maps[3]).unwrap();
        assert!(twice.shares_with(&solid));
        alike(&twice, &solid.transformed(&(maps[3] * map)).unwrap());
        alike(&solid.copied(&map).unwrap().transformed(&maps[1]).unwrap(), &twice_moved(&solid, [maps[1], map]));
    }
    // What is squashed is cut anew, and what is flat is nothing.
    let squash = Affine3A::from_scale(Vec3::new(1.0, 1.0, 1e-4));
    assert_eq!(solid.copied(&squash), solid.transformed(&squash));
    let flat = Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0));
    assert_eq!(solid.copied(&flat).err(), Some(GeometryError::Singular));
    assert!(solid.copied(&Affine3A::from_translation(Vec3::NAN)).is_err());
}

fn twice_moved(solid: &Convex, [second, first]: [Affine3A; 2]) -> Convex {
    solid.transformed(&first).unwrap().transformed(&second).unwrap()
}

/// Facets, outlines and exits are the same to within rounding.
fn alike(a: &Convex, b: &Convex) {
    let near = 1e-6 * b.radius().max(b.center().abs().max_element());
    assert!(a.center().distance(b.center()) <= near && (a.radius() - b.radius()).abs() <= near);
    assert!(a.bounds().min.distance(b.bounds().min) <= near && a.bounds().max.distance(b.bounds().max) <= near);
    assert_eq!((a.facets().len(), a.vertices().len(), a.edges().len()), {
        (b.facets().len(), b.vertices().len(), b.edges().len())
    });
    for (number, (f, g)) in (0..).zip(a.facets().iter().zip(b.facets())) {
        assert!(f.normal.distance(g.normal) < 1e-6 && (f.offset - g.offset).abs() <= near, "{f:?} {g:?}");
        assert!((f.area - g.area).abs() <= 1e-5 * b.area() && a.source(number) == b.source(number));
        let corners = |solid: &Convex| -> Vec<Vec3> {
            solid.corners(number).iter().map(|&corner| solid.vertices()[corner as usize]).collect()
        };
        let (own, its) = (corners(a), corners(b));
        assert_eq!(own.len(), its.len());
        let first = its.iter().position(|corner| corner.distance(own[0]) <= 2.0 * near).expect("the same corner");
        let round = its.iter().cycle().skip(first);
        assert!(own.iter().zip(round).all(|(p, q)| p.distance(*q) <= 2.0 * near), "the same way around");
    }
    let mut random = Random(3);
    for _ in 0..400 {
        let origins = Vectors::<8>::splat(b.center() + random.vector() * (0.1 * b.radius()));
        let directions = Vectors::<8>::from_fn(|_| Vec3::ZERO);
        let mut directions = directions;
        (0..8).for_each(|lane| directions.set(lane, random.direction()));
        let (exits, its) = (a.exit_lanes(&origins, &directions), b.exit_lanes(&origins, &directions));
        for lane in 0..8 {
            // Beside an edge either facet is right: the ray ends in the same place.
            assert!((exits.t[lane] - its.t[lane]).abs() <= 1e-5 * b.radius().max(b.center().abs().max_element()));
        }
    }
}

#[test]
fn ten_thousand_copies_of_a_brilliant_share_it() {
    let solid = Brilliant::default().solid().unwrap();
    let copies: Vec<Convex> = (0..10_000u32)
        .map(|i| {
            let turn = Quat::from_rotation_z(i as f32);
            let mirror = Vec3::new(if i % 2 == 0 { 1.0 } else { -1.0 }, 1.0, 1.0);
            let place = Vec3::new((i % 100) as f32, (i / 100) as f32, 0.0) * 2.0;
            solid.copied(&Affine3A::from_scale_rotation_translation(mirror, turn, place)).unwrap()
        })
        .collect();
    assert!(copies.iter().all(|copy| copy.shares_with(&solid)));
    let bytes: usize = copies.iter().map(Convex::own_bytes).sum();
    assert!(bytes < 75_000_000, "{bytes}");
}

#[test]
fn degenerate_shapes_are_errors() {
    assert_eq!(
        Sphere::new(Vec3::ZERO, -1.0).unwrap_err().to_string(),
        "the radius of the sphere must be above zero, it is -1"
    );
    assert!(Sphere::new(Vec3::ZERO, f32::NAN).is_err());
    assert!(Sphere::new(Vec3::X * 1e30, 1.0).unwrap_err().to_string().contains("another unit"));
    assert!(matches!(Rectangle::new(Vec3::ZERO, Vec3::X, Vec3::X * 2.0), Err(GeometryError::NoArea { .. })));
    assert!(matches!(Disk::new(Vec3::ZERO, Vec3::ZERO, Vec3::X), Err(GeometryError::NoArea { .. })));
    assert!(Disk::facing(Vec3::ZERO, Vec3::ZERO, 1.0).is_err());
    assert!(Convex::cuboid(Vec3::ZERO, Vec3::new(1.0, 0.0, 1.0)).is_err());
    let box_planes = |d: f64| -> Vec<Plane> {
        [DVec3::X, DVec3::Y, DVec3::Z].iter().flat_map(|&n| [Plane::new(n, d), Plane::new(-n, d)]).collect()
    };
    let planes = box_planes(1.0);
    assert_eq!(Convex::from_planes(&planes[..5]).err(), Some(GeometryError::NoVolume), "open");
    assert_eq!(Convex::from_planes(&box_planes(-1.0)).err(), Some(GeometryError::NoVolume), "empty");
    assert_eq!(Convex::from_planes(&[]).err(), Some(GeometryError::NoVolume));
    let mut bad = planes.clone();
    bad[3].offset = f64::NAN;
    assert_eq!(Convex::from_planes(&bad).err(), Some(GeometryError::BadPlane { index: 3 }));
    // Planes that touch nothing, or touch a corner, or come twice, are dropped; long normals are fine.
    let mut more = planes.clone();
    more.push(Plane::new(DVec3::ONE, 3.0));
    more.push(Plane::new(DVec3::ONE, 5.0));
    more.push(Plane::new(DVec3::X * 7.0, 7.0));
    assert_eq!(Convex::from_planes(&more).unwrap().facets().len(), 6);
}

#[test]
fn an_empty_world_has_nothing() {
    let world = World::new(Vec::new()).unwrap();
    assert!(world.closest(&Ray::free(Vec3::ZERO, Vec3::X), f32::INFINITY).is_none());
    assert!(!world.occluded(&Ray::free(Vec3::ZERO, Vec3::X), f32::INFINITY, None));
    assert!(world.bounds().is_empty());
}

fn any_vec3() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(any::<u32>().prop_map(f32::from_bits)).prop_map(Vec3::from)
}

fn mixed_vec3() -> impl Strategy<Value = Vec3> {
    prop_oneof![any_vec3(), prop::array::uniform3(-1e3f32..1e3).prop_map(Vec3::from)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn nothing_panics(
        points in prop::collection::vec((mixed_vec3(), mixed_vec3(), mixed_vec3()), 1..12),
        origin in mixed_vec3(), direction in mixed_vec3(), t_max in any::<u32>().prop_map(f32::from_bits),
        id in 0u32..14, inside in any::<bool>(), u in prop::array::uniform2(any::<u32>().prop_map(f32::from_bits)),
    ) {
        let mut shapes: Vec<Shape> = Vec::new();
        for (a, b, c) in points {
            shapes.extend(Sphere::new(a, b.x).ok().map(Shape::from));
            shapes.extend(Rectangle::new(a, b, c).ok().map(Shape::from));
            shapes.extend(Disk::new(a, b, c).ok().map(Shape::from));
            shapes.extend(Disk::facing(a, b, c.x).ok().map(Shape::from));
            shapes.extend(Convex::cuboid(a, b.abs()).ok().map(Shape::from));
            let planes = [a, b, c, -a, -b, -c].map(|n| Plane::new(n.as_dvec3(), a.x as f64));
            shapes.extend(Convex::from_planes(&planes).ok().map(Shape::from));
            let map = Affine3A::from_cols(a.into(), b.into(), c.into(), a.into());
            let images: Vec<Shape> = shapes.iter().filter_map(|s| s.transformed(&map).ok()).collect();
            shapes.extend(images.into_iter().take(3));
        }
        let pairs = shapes.iter().zip(shapes.iter().skip(1));
        for (a, b) in pairs {
            a.may_touch_inside(b);
        }
        let side = if inside { Side::Inside } else { Side::Outside };
        let world = World::new(shapes).unwrap();
        for departs in [Departure::Free, Departure::Surface { shape: ShapeId(id), facet: 0, side, place: 0 }] {
            for direction in [direction, direction.normalize_or_zero()] {
                let ray = Ray { origin, direction, departs };
                let hit = world.closest(&ray, t_max);
                world.occluded(&ray, t_max, Some(Target { shape: ShapeId(id), facet: 0 }));
                for shape in world.shapes() {
                    if let Some(toward) = shape.sample_toward(origin, u) {
                        prop_assert!(toward.pdf > 0.0 && toward.pdf.is_finite());
                    }
                    if let Some(hit) = &hit {
                        prop_assert!(shape.pdf_toward(origin, direction, hit) >= 0.0);
                        prop_assert!(hit.t >= 0.0);
                    }
                }
            }
        }
    }
}
