//! Meshes: rays never slip through, whatever edge or corner they are aimed at or leave from, at every scale.

use crate::common::meshes;
use crate::common::random::Random;
use glam::{Affine3A, Quat, Vec3};
use spectrel::geometry::{
    Brilliant, Convex, Departure, GeometryError, Hit, Mesh, Placed, Ray, Shape, ShapeId, Side, Sphere, Triangles, World,
};
use std::sync::Arc;

/// Solids of many kinds, about 1 in size.
fn solids() -> Vec<(&'static str, Triangles)> {
    vec![
        ("cube", meshes::of_convex(&Convex::cuboid(Vec3::ZERO, Vec3::new(0.5, 0.3, 0.8)).unwrap())),
        ("brilliant", meshes::of_convex(&Brilliant::default().solid().unwrap())),
        ("coarse ball", meshes::icosphere(1)),
        ("ball", meshes::icosphere(4)),
        ("ring", meshes::torus(60, 24, 0.3)),
        ("bumpy ball", meshes::blob(5, 0.05)),
        ("rough ball", meshes::blob(4, 0.3)),
    ]
}

/// The places of the test: scales, and far from the origin; as copies by transforms and with corners moved.
fn placements() -> Vec<(String, Affine3A)> {
    let turn = Quat::from_euler(glam::EulerRot::XYZ, 0.3, -1.1, 2.0);
    let mut places = vec![("as it is".to_owned(), Affine3A::IDENTITY)];
    for scale in [1e-4f32, 1.0, 1e4] {
        let map =
            Affine3A::from_scale_rotation_translation(Vec3::splat(scale), turn, Vec3::new(0.7, -1.3, 0.4) * scale);
        places.push((format!("scale {scale}"), map));
    }
    let far = Affine3A::from_scale_rotation_translation(Vec3::ONE, turn, Vec3::new(1e4, -3e3, 5e3));
    places.push(("far away".into(), far));
    let odd = Affine3A::from_scale_rotation_translation(Vec3::new(-2.0, 0.5, 1.0), turn, Vec3::new(3.0, 0.0, -1.0));
    places.push(("mirrored and stretched".into(), odd));
    places
}

fn moved(triangles: &Triangles, map: &Affine3A) -> Triangles {
    let positions = triangles.positions.iter().map(|&p| map.transform_point3(p)).collect();
    Triangles { positions, normals: Vec::new(), ..triangles.clone() }
}

fn world(shape: Shape) -> World {
    World::new(vec![shape]).unwrap()
}

/// Each mesh at each place, once as a copy and once with its corners there.
fn everywhere(mut test: impl FnMut(&str, &World, &[Vec3], &[[u32; 3]])) {
    for (name, triangles) in solids() {
        let mesh = Arc::new(Mesh::new(triangles.clone()).unwrap());
        for (place, map) in placements() {
            let there = moved(&triangles, &map);
            let copy = Placed::new(mesh.clone()).transformed(&map).unwrap();
            let baked = Mesh::new(there.clone()).unwrap();
            assert!(baked.is_closed(), "{name}, {place}");
            let indices = baked.triangles().indices.clone();
            test(&format!("{name}, {place}, copy"), &world(copy.into()), &there.positions, &indices);
            test(&format!("{name}, {place}"), &world(Placed::new(Arc::new(baked)).into()), &there.positions, &indices);
        }
    }
}

/// Where a mesh keeps a triangle is told to rays that leave it, and may be told wrongly.
#[test]
fn a_wrong_place_of_the_triangle_left_changes_nothing() {
    let mut random = Random(5);
    everywhere(|name, world, positions, indices| {
        let center = positions.iter().sum::<Vec3>() / positions.len() as f32;
        for _ in 0..30 {
            let [a, b, c] = indices[random.below(indices.len())].map(|corner| positions[corner as usize]);
            let direction = a * 0.5 + b * 0.3 + c * 0.2 - center;
            let Some(hit) = world.closest(&Ray::free(center, direction.normalize()), f32::INFINITY) else { continue };
            for (side, toward) in [(Side::Inside, -random.direction()), (Side::Outside, random.direction())] {
                let found = |place| {
                    let departs = Departure::Surface { shape: hit.shape, facet: hit.facet, side, place };
                    let ray = Ray { origin: hit.point, direction: toward, departs };
                    (world.closest(&ray, f32::INFINITY), world.occluded(&ray, 1e6, None))
                };
                let right = found(hit.place);
                for place in [0, 1, hit.place ^ 1, hit.place.wrapping_add(6), u32::MAX] {
                    assert_eq!(found(place), right, "{name}: {place} for {}", hit.place);
                }
            }
        }
    });
}

/// A point inside, by more than the rounding of a free origin: somewhere below a triangle.
fn within(world: &World, random: &mut Random, positions: &[Vec3], indices: &[[u32; 3]]) -> Option<Vec3> {
    let [a, b, c] = indices[random.below(indices.len())].map(|i| positions[i as usize]);
    let (u, v) = (random.unit(), random.unit());
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    let size = world.bounds().size().max_element();
    let point = a + (b - a) * u + (c - a) * v;
    let inwards = -(b - a).cross(c - a).try_normalize()?;
    let inside = point + inwards * size * 0.2 * random.unit();
    let margin = 1e-5 * (inside.abs().max_element() + size);
    let inside_all_around = [Vec3::X, Vec3::Y, Vec3::Z]
        .iter()
        .all(|&axis| [margin, -margin].iter().all(|&step| world.shapes()[0].contains(inside + axis * step)));
    inside_all_around.then_some(inside)
}

#[test]
fn some_rays_from_inside_find_the_surface() {
    find_the_surface(4_000);
}

#[test]
#[ignore = "long: millions of rays"]
fn rays_from_inside_aimed_at_edges_and_corners_find_the_surface() {
    find_the_surface(40_000);
}

/// Aimed at edges and corners.
fn find_the_surface(rays: u32) {
    everywhere(|name, world, positions, indices| {
        let mut random = Random(3);
        let (mut asked, mut grazing) = (0, 0);
        for i in 0..rays {
            let Some(origin) = within(world, &mut random, positions, indices) else { continue };
            let triangle = indices[random.below(indices.len())];
            let [a, b] = [triangle[0], triangle[1]].map(|corner| positions[corner as usize]);
            let target = if i % 3 == 0 { a } else { a + (b - a) * random.unit() };
            let target = if i % 2 == 0 { target } else { random.nudged(target) };
            let Some(direction) = (target - origin).try_normalize() else { continue };
            let hit = world.closest(&Ray::free(origin, direction), f32::INFINITY);
            let hit = hit.unwrap_or_else(|| panic!("{name}: ray {i} is lost"));
            asked += 1;
            // A line that grazes an edge leaves and enters at once there, and rounding may tell the two the wrong way round;
            // either way it is inside afterwards.
            grazing += u32::from(hit.side == Side::Outside);
        }
        assert!(asked > rays / 8 && grazing < asked / 200, "{name}: {grazing} of {asked}");
    });
}

#[test]
fn what_leaves_the_surface_stays_on_its_side() {
    stays_on_its_side(3_000);
}

#[test]
#[ignore = "long: 7,000,000 rays"]
fn whatever_leaves_the_surface_stays_on_its_side() {
    stays_on_its_side(30_000);
}

/// Light paths that go through the surface, or are thrown back, at random.
fn stays_on_its_side(paths: usize) {
    everywhere(|name, world, positions, indices| {
        let mut random = Random(5);
        let (mut steps, mut grazing) = (0, 0);
        for _ in 0..paths {
            let Some(origin) = within(world, &mut random, positions, indices) else { continue };
            let mut ray = Ray::free(origin, random.direction());
            let mut inside = true;
            for _ in 0..30 {
                steps += 1;
                let Some(hit) = world.closest(&ray, f32::INFINITY) else {
                    assert!(!inside, "{name}: {ray:?} is lost");
                    break;
                };
                grazing += u32::from((hit.side == Side::Inside) != inside);
                inside = random.unit() < 0.6;
                ray = away(&hit, inside, &mut random);
            }
        }
        assert!(steps > paths && grazing <= 3, "{name}: {grazing} of {steps}");
    });
}

/// Any direction into one side, grazing ones above all.
fn away(hit: &Hit, inside: bool, random: &mut Random) -> Ray {
    let out = if inside { -hit.normal } else { hit.normal };
    let mut d = random.direction();
    d -= out * d.dot(out);
    let d = d.normalize_or(Vec3::X);
    let height = random.unit().powi(1 + random.below(8) as i32);
    let direction = (d * (1.0 - height * height).sqrt() + out * height).normalize();
    Ray::leaving(hit, if inside { Side::Inside } else { Side::Outside }, direction)
}

#[test]
fn shells_a_ten_thousandth_apart_are_met_in_turn() {
    let shell = |radius: f32| {
        let mut ball = meshes::icosphere(5);
        ball.positions.iter_mut().for_each(|p| *p *= radius);
        Shape::from(Placed::new(Arc::new(Mesh::new(ball).unwrap())))
    };
    let world = World::new((0..4).map(|i| shell(1.0 + 1e-4 * i as f32)).collect()).unwrap();
    let mut random = Random(11);
    for _ in 0..100_000 {
        let direction = random.direction();
        let mut ray = Ray::free(Vec3::ZERO, direction);
        for shape in 0..4 {
            let hit = world.closest(&ray, f32::INFINITY).unwrap();
            assert_eq!((hit.shape, hit.side), (ShapeId(shape), Side::Inside));
            ray = Ray::leaving(&hit, Side::Outside, direction);
        }
        assert!(world.closest(&ray, f32::INFINITY).is_none());
    }
}

/// Distances against double precision, all triangles one by one.
#[test]
fn hits_are_where_every_triangle_is_asked() {
    let triangles = meshes::blob(3, 0.2);
    let mesh = Placed::new(Arc::new(Mesh::new(triangles.clone()).unwrap()));
    let world = world(mesh.into());
    let mut random = Random(17);
    let mut hits = 0;
    for _ in 0..20_000 {
        let origin = random.direction() * 3.0;
        let direction = (random.direction() * 1.3 - origin).normalize();
        let expected = slowly(&triangles, origin, direction);
        let hit = world.closest(&Ray::free(origin, direction), f32::INFINITY);
        let occluded = world.occluded(&Ray::free(origin, direction), f32::INFINITY, None);
        match (hit, expected) {
            (None, None) => assert!(!occluded),
            (Some(hit), Some((t, triangle))) => {
                hits += 1;
                assert!((f64::from(hit.t) - t).abs() < 1e-5, "{} {t}", hit.t);
                assert!(occluded && (hit.facet == triangle || (f64::from(hit.t) - t).abs() < 1e-6));
                assert!(world.occluded(&Ray::free(origin, direction), hit.t * 1.001, None));
                assert!(!world.occluded(&Ray::free(origin, direction), hit.t * 0.999, None));
            }
            // A silhouette decides.
            (hit, expected) => assert!(grazes(&triangles, origin, direction), "{hit:?} {expected:?}"),
        }
    }
    assert!(hits > 5_000);
}

/// Möller & Trumbore (1997) in double precision.
fn slowly(mesh: &Triangles, origin: Vec3, direction: Vec3) -> Option<(f64, u32)> {
    let (o, d) = (origin.as_dvec3(), direction.as_dvec3());
    let met = (0..).zip(&mesh.indices).filter_map(|(number, triangle)| {
        let [a, b, c] = triangle.map(|i| mesh.positions[i as usize].as_dvec3());
        let (e1, e2) = (b - a, c - a);
        let p = d.cross(e2);
        let s = o - a;
        let det = e1.dot(p);
        let (u, q) = (s.dot(p) / det, s.cross(e1));
        let (v, t) = (d.dot(q) / det, e2.dot(q) / det);
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some((t, number))
    });
    met.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Whether a line passes within a millionth of an edge.
fn grazes(mesh: &Triangles, origin: Vec3, direction: Vec3) -> bool {
    let (o, d) = (origin.as_dvec3(), direction.as_dvec3());
    mesh.indices.iter().any(|triangle| {
        let p = triangle.map(|i| mesh.positions[i as usize].as_dvec3() - o);
        (0..3).any(|k| {
            let (a, b) = (p[k], p[(k + 1) % 3]);
            let across = d.cross(b - a);
            (a.dot(across) / across.length()).abs() < 1e-6
        })
    })
}

#[test]
fn closed_meshes_know_it_and_face_outwards() {
    for (name, triangles) in solids() {
        let mut turned = triangles.clone();
        turned.indices.iter_mut().for_each(|t| t.reverse());
        turned.normals.iter_mut().for_each(|n| *n = -*n);
        let (mesh, back) = (Mesh::new(triangles.clone()).unwrap(), Mesh::new(turned).unwrap());
        assert!(mesh.is_closed() && back.is_closed(), "{name}");
        assert!(mesh.surroundings().volume > 0.0 && back.surroundings().volume > 0.0, "{name}");
        let world = world(Placed::new(Arc::new(back)).into());
        let hit = world.closest(&Ray::free(Vec3::new(3.0, 0.1, 0.2), -Vec3::X), f32::INFINITY).unwrap();
        assert!(hit.side == Side::Outside && hit.normal.x > 0.0 && hit.shading.x > 0.0, "{name}");

        let mut open = triangles.clone();
        open.indices.pop();
        let open = Mesh::new(open).unwrap();
        assert_eq!(open.surroundings().open_edges, 3, "{name}");
        assert!(open.surroundings().opening.is_some());
    }
    let cube = Mesh::new(meshes::of_convex(&Convex::cuboid(Vec3::ONE, Vec3::new(0.5, 1.0, 1.5)).unwrap())).unwrap();
    assert!((cube.surroundings().volume - 6.0).abs() < 1e-6);
}

/// Corners with the same place and different normals are one corner.
#[test]
fn corners_parted_by_normals_close_a_mesh() {
    let cube = meshes::of_convex(&Convex::cuboid(Vec3::ZERO, Vec3::ONE).unwrap());
    let mut parted = Triangles::default();
    for triangle in &cube.indices {
        let first = parted.positions.len() as u32;
        parted.positions.extend(triangle.map(|i| cube.positions[i as usize]));
        parted.indices.push([first, first + 1, first + 2]);
    }
    assert!(Mesh::new(parted).unwrap().is_closed());
}

#[test]
fn impossible_meshes_are_errors() {
    let cube = meshes::of_convex(&Convex::cuboid(Vec3::ZERO, Vec3::ONE).unwrap());
    let empty = Triangles { indices: Vec::new(), ..cube.clone() };
    assert_eq!(Mesh::new(empty).unwrap_err(), GeometryError::NoTriangles);
    let mut beyond = cube.clone();
    beyond.indices[3][1] = 8;
    assert_eq!(Mesh::new(beyond).unwrap_err(), GeometryError::NoSuchCorner { index: 8, count: 8 });
    for value in [f32::NAN, f32::INFINITY, 1e30] {
        let mut odd = cube.clone();
        odd.positions[2].y = value;
        assert!(Mesh::new(odd).is_err());
    }
    let placed = Placed::new(Arc::new(Mesh::new(cube).unwrap()));
    assert_eq!(
        placed.transformed(&Affine3A::from_scale(Vec3::new(1.0, 1.0, 0.0))).unwrap_err(),
        GeometryError::Singular
    );
}

#[test]
fn corners_beyond_all_counts_are_errors_that_cost_nothing() {
    let cube = meshes::of_convex(&Convex::cuboid(Vec3::ZERO, Vec3::ONE).unwrap());
    for index in [8, 1 << 31, u32::MAX - 1, u32::MAX] {
        let mut beyond = cube.clone();
        beyond.indices[5][2] = index;
        assert_eq!(Mesh::new(beyond).unwrap_err(), GeometryError::NoSuchCorner { index, count: 8 });
    }
}

/// Many triangles on one point or one line: all of them alone are an error, among others they are in nobody's way, and no build hangs.
#[test]
fn a_few_points_among_triangles_do_no_harm() {
    points_do_no_harm(20_000);
}

#[test]
#[ignore = "long: 200,000 triangles"]
fn meshes_without_area_are_errors_and_points_among_triangles_do_no_harm() {
    points_do_no_harm(200_000);
}

fn points_do_no_harm(count: usize) {
    let points: Vec<[u32; 3]> = vec![[0, 0, 0]; count];
    let lines: Vec<[u32; 3]> = (0..count as u32).map(|i| [i % 7, (i + 1) % 7, (i + 3) % 7]).collect();
    let positions: Vec<Vec3> = (0..7).map(|i| Vec3::splat(i as f32 - 3.0)).collect();
    for indices in [points, lines] {
        let flat = Triangles { positions: positions.clone(), indices: indices.clone(), ..Triangles::default() };
        assert_eq!(Mesh::new(flat).unwrap_err(), GeometryError::NoTriangleWithArea { count });
        let mut ball = meshes::icosphere(3);
        let real = ball.indices.len() as u32;
        let first = ball.positions.len() as u32;
        ball.positions.extend(&positions);
        ball.indices.extend(indices.iter().map(|triangle| triangle.map(|index| first + index)));
        let world = world(Placed::new(Arc::new(Mesh::new(ball).unwrap())).into());
        let mut random = Random(41);
        for _ in 0..1000 {
            let ray = Ray::free(random.direction() * 0.3, random.direction());
            assert!(world.closest(&ray, f32::INFINITY).is_some_and(|hit| hit.facet < real));
        }
    }
}

/// Equal boxes give a builder nothing to choose by.
#[test]
fn a_crowd_of_equal_triangles_or_shapes_is_built_at_once() {
    for size in [1.0, 1e-14] {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p * size).to_vec();
        let heap = Triangles { positions, indices: vec![[0, 1, 2]; 200_000], ..Triangles::default() };
        let world = world(Placed::new(Arc::new(Mesh::new(heap).unwrap())).into());
        let hit = world.closest(&Ray::free(Vec3::new(0.25, 0.25, 1.0) * size, -Vec3::Z), f32::INFINITY).unwrap();
        assert_eq!((hit.facet, hit.t), (0, size));
    }
    let balls = vec![Sphere::new(Vec3::ZERO, 1.0).unwrap().into(); 100_000];
    let hit = World::new(balls).unwrap().closest(&Ray::free(Vec3::Z * 3.0, -Vec3::Z), f32::INFINITY).unwrap();
    assert_eq!((hit.shape, hit.t), (ShapeId(0), 2.0));
}

/// Whatever a ray is, it ends.
#[test]
fn rays_that_are_no_numbers_end() {
    let world = world(Placed::new(Arc::new(Mesh::new(meshes::blob(4, 0.1)).unwrap())).into());
    let balls = (0..20).map(|i| Sphere::new(Vec3::X * i as f32, 0.4).unwrap().into()).collect();
    let many = World::new(balls).unwrap();
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0] {
        for world in [&world, &many] {
            let _ = world.closest(&Ray::free(Vec3::ZERO, Vec3::splat(value)), f32::INFINITY);
            let _ = world.closest(&Ray::free(Vec3::splat(value), Vec3::splat(value)), f32::INFINITY);
            let _ = world.occluded(&Ray::free(Vec3::splat(value), Vec3::splat(value)), 1.0, None);
        }
        for axis in 0..3 {
            let (mut origin, mut direction) = (Vec3::splat(0.1), Vec3::new(0.6, 0.0, 0.8));
            direction[axis] = value;
            let _ = world.closest(&Ray::free(origin, direction), f32::INFINITY);
            let _ = world.occluded(&Ray::free(origin, direction), 1.0, None);
            origin[axis] = value;
            let _ = world.closest(&Ray::free(origin, Vec3::X), f32::INFINITY);
            let _ = world.occluded(&Ray::free(origin, direction), value, None);
        }
    }
}

/// Triangles without area are never met, and do no harm to their neighbours.
#[test]
fn triangles_without_area_are_not_met() {
    let mut ball = meshes::icosphere(2);
    let [a, b, _] = ball.indices[0];
    ball.indices.extend([[a, b, b], [a, b, a], [a, a, a]]);
    let count = ball.indices.len() as u32 - 3;
    let world = world(Placed::new(Arc::new(Mesh::new(ball.clone()).unwrap())).into());
    let mut random = Random(23);
    for _ in 0..20_000 {
        let target = ball.positions[a as usize].lerp(ball.positions[b as usize], random.unit());
        let origin = random.direction() * 0.5;
        let hit = world.closest(&Ray::free(origin, (target - origin).normalize()), f32::INFINITY).unwrap();
        assert!(hit.facet < count && hit.side == Side::Inside);
    }
}

#[test]
fn smooth_normals_are_those_of_the_ball() {
    let mut ball = meshes::icosphere(3);
    ball.normals = ball.positions.clone();
    let map = Affine3A::from_scale_rotation_translation(Vec3::splat(2.0), Quat::from_rotation_y(0.7), Vec3::splat(5.0));
    let copy = Placed::new(Arc::new(Mesh::new(ball).unwrap())).transformed(&map).unwrap();
    let world = world(copy.into());
    let mut random = Random(29);
    for _ in 0..10_000 {
        let out = random.direction();
        let ray = Ray::free(Vec3::splat(5.0) + out * 4.0, -out);
        let hit = world.closest(&ray, f32::INFINITY).unwrap();
        assert!(hit.shading.dot(out) > 0.9998 && hit.normal.dot(out) > 0.985);
        assert!((hit.shading.length() - 1.0).abs() < 1e-6 && (hit.normal.length() - 1.0).abs() < 1e-6);
    }
}

#[test]
fn a_thousand_copies_cost_less_than_a_megabyte() {
    let mesh = Arc::new(Mesh::new(meshes::icosphere(3)).unwrap());
    let copy = |i: u32| Affine3A::from_translation(Vec3::new(3.0 * (i % 32) as f32, 3.0 * (i / 32) as f32, 0.0));
    let shapes: Vec<Shape> =
        (0..1000).map(|i| Placed::new(mesh.clone()).transformed(&copy(i)).unwrap().into()).collect();
    assert_eq!(Arc::strong_count(&mesh), 1001);
    // A shape and its frame on the heap: two maps of twelve numbers and a norm.
    assert!(1000 * (size_of::<Shape>() + 2 * 12 * size_of::<f64>() + 16) < 1 << 20);
    let world = World::new(shapes).unwrap();
    for i in [0, 500, 999] {
        let above = copy(i).transform_point3(Vec3::new(0.01, 0.02, 4.0));
        let hit = world.closest(&Ray::free(above, -Vec3::Z), f32::INFINITY).unwrap();
        assert_eq!(hit.shape, ShapeId(i));
        assert!((hit.t - 3.0).abs() < 0.02);
    }
}

#[test]
fn texture_coordinates_follow_the_surface() {
    let square = Triangles {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
        uvs: vec![glam::Vec2::ZERO, glam::Vec2::X, glam::Vec2::ONE, glam::Vec2::Y],
        indices: vec![[0, 1, 2], [0, 2, 3]],
        ..Triangles::default()
    };
    let mesh = Placed::new(Arc::new(Mesh::new(square).unwrap()));
    let map = Affine3A::from_scale_rotation_translation(Vec3::splat(3.0), Quat::from_rotation_z(0.5), Vec3::X);
    let world = World::new(vec![
        mesh.transformed(&map).unwrap().into(),
        Sphere::new(Vec3::Z * 50.0, 1.0).unwrap().into(),
        Convex::cuboid(Vec3::Z * -50.0, Vec3::ONE).unwrap().into(),
    ])
    .unwrap();
    let mut random = Random(31);
    for _ in 0..1000 {
        let (u, v) = (random.unit(), random.unit());
        let point = map.transform_point3(Vec3::new(u, v, 0.0));
        let Some(hit) = world.closest(&Ray::free(point + Vec3::Z, -Vec3::Z), f32::INFINITY) else { continue };
        let uv = world.uv(&hit).unwrap();
        assert!((uv - glam::Vec2::new(u, v)).length() < 1e-5);
    }
    let ball = |from: Vec3| world.closest(&Ray::free(Vec3::Z * 50.0 + from * 3.0, -from), f32::INFINITY).unwrap();
    for (from, expected) in [(Vec3::X, [0.0, 0.5]), (Vec3::Y, [0.25, 0.5]), (-Vec3::Y, [0.75, 0.5])] {
        let uv = world.uv(&ball(from)).unwrap().to_array();
        assert!((uv[0] - expected[0]).abs() < 1e-5 && (uv[1] - expected[1]).abs() < 1e-5, "{uv:?}");
    }
    let top = Vec3::new(0.1, 0.0, 1.0).normalize();
    assert!(world.uv(&ball(top)).unwrap().y > 0.96);
    let below = world.closest(&Ray::free(Vec3::Z * -60.0, Vec3::Z), f32::INFINITY).unwrap();
    assert_eq!(world.uv(&below), None);
}

/// Every ray that leaves a triangle says so: a second hit of the same one would be a shadow on itself.
#[test]
fn a_triangle_is_not_met_again() {
    let ball = Mesh::new(meshes::icosphere(2)).unwrap();
    let world = world(Placed::new(Arc::new(ball)).into());
    let mut random = Random(37);
    for _ in 0..50_000 {
        let hit = world.closest(&Ray::free(random.direction() * 3.0, Vec3::ZERO), f32::INFINITY);
        assert!(hit.is_none(), "a ray without direction goes nowhere");
        let out = random.direction();
        let hit = world.closest(&Ray::free(out * 3.0, -out), f32::INFINITY).unwrap();
        assert!(
            matches!(Ray::leaving(&hit, Side::Outside, out).departs, Departure::Surface { facet, .. } if facet == hit.facet)
        );
        assert!(!world.occluded(&away(&hit, false, &mut random), f32::INFINITY, None), "the ball is convex");
        assert!(world.occluded(&away(&hit, true, &mut random), f32::INFINITY, None));
    }
}
