use super::*;
use glam::Vec3;

/// A cube of edge 2 around the origin, twelve triangles outwards.
fn cube() -> Triangles {
    let corner = |i: usize| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * 2.0 - 1.0;
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let indices = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Triangles { positions: (0..8).map(corner).collect(), indices, ..Triangles::default() }
}

fn at(mesh: Triangles, place: Vec3, scale: f32) -> Triangles {
    Triangles { positions: mesh.positions.iter().map(|&p| place + p * scale).collect(), ..mesh }
}

fn turned(mut mesh: Triangles, triangles: &[usize]) -> Triangles {
    triangles.iter().for_each(|&triangle| mesh.indices[triangle].swap(1, 2));
    mesh
}

/// Each triangle with three corners of its own.
fn soup(mesh: &Triangles) -> Triangles {
    let positions: Vec<Vec3> = mesh.indices.iter().flatten().map(|&corner| mesh.positions[corner as usize]).collect();
    let indices = (0..positions.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    Triangles { positions, indices, ..Triangles::default() }
}

fn volume(mesh: &Triangles) -> Option<f64> {
    let found = Surroundings::of(mesh);
    found.is_solid().then_some(found.volume)
}

fn only(repeated: usize, turned: usize) -> Mended {
    Mended { repeated, turned, welded: None }
}

#[test]
fn what_is_a_body_stays_as_it_is() {
    let hollow = Triangles::joined([&cube(), &turned(at(cube(), Vec3::ZERO, 0.5), &(0..12).collect::<Vec<_>>())]);
    let inside_out = turned(cube(), &(0..12).collect::<Vec<_>>());
    for mesh in [cube(), soup(&cube()), hollow, inside_out] {
        let (mended, what) = mesh.clone().mended(HAIR);
        assert_eq!((mended, what), (mesh, Mended::default()));
    }
}

/// A stone and its mirror image as large, wound inwards: together they enclose nothing, and yet they are two bodies.
#[test]
fn a_mirror_image_is_turned() {
    let image = turned(at(cube(), Vec3::X * 5.0, 1.0), &(0..12).collect::<Vec<_>>());
    let (mesh, mended) = Triangles::joined([&cube(), &image]).mended(HAIR);
    assert_eq!((volume(&mesh), mended), (Some(16.0), only(0, 12)));
}

/// What no export makes is given up in time: many triangles at one edge, from both sides.
#[test]
fn crowds_of_triangles_are_left_as_they_are() {
    let mut crowd = Triangles { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], ..Triangles::default() };
    crowd.indices = (0..40_000).map(|i| if i % 2 == 0 { [0, 1, 2] } else { [0, 2, 1] }).collect();
    assert_eq!(volume(&crowd.mended(HAIR).0), None);
}

#[test]
fn faces_that_are_there_twice_go() {
    let back = turned(cube(), &(0..12).collect::<Vec<_>>());
    let (mesh, mended) = Triangles::joined([&cube(), &back]).mended(HAIR);
    assert_eq!((mesh.indices.len(), volume(&mesh), mended), (12, Some(8.0), only(12, 0)));
    // Cut along the other diagonals.
    let quads = back.indices.chunks(2).flat_map(|pair| {
        let ([a, c, b], [_, d, _]) = (pair[0], pair[1]);
        [[d, c, b], [d, b, a]]
    });
    let other = Triangles { indices: quads.collect(), ..back.clone() };
    assert_eq!(volume(&other), Some(-8.0));
    for parts in [[&cube(), &other], [&other, &cube()]] {
        let (mesh, mended) = Triangles::joined(parts).mended(HAIR);
        assert_eq!((volume(&mesh).map(f64::abs), mended), (Some(8.0), only(12, 0)));
    }
    // Some of them only.
    let some = Triangles { indices: back.indices[..5].to_vec(), ..back.clone() };
    let (mesh, mended) = Triangles::joined([&cube(), &some]).mended(HAIR);
    assert_eq!((mesh.indices.len(), volume(&mesh), mended), (12, Some(8.0), only(5, 0)));
    // A pane without thickness is no body whatever is done.
    let pane = |mesh: &Triangles| Triangles { indices: mesh.indices[..2].to_vec(), ..mesh.clone() };
    assert_eq!(volume(&Triangles::joined([&pane(&cube()), &pane(&back)])), None);
}

#[test]
fn windings_are_made_to_agree_by_the_majority() {
    for wrong in [vec![0], vec![0, 1], vec![2, 5, 7, 8]] {
        let (mesh, mended) = turned(soup(&cube()), &wrong).mended(HAIR);
        assert_eq!((volume(&mesh), mended), (Some(8.0), only(0, wrong.len())), "{wrong:?}");
    }
    // Bodies beside each other, one of them inside out; the hollow of the first one stays.
    let all: Vec<usize> = (0..12).collect();
    let [hollow, beside] = [at(cube(), Vec3::ZERO, 0.5), at(cube(), 5.0 * Vec3::X, 0.75)].map(|m| turned(m, &all));
    let (mesh, mended) = Triangles::joined([&cube(), &hollow, &beside]).mended(HAIR);
    assert_eq!((volume(&mesh), mended), (Some(8.0 - 1.0 + 3.375), only(0, 12)));
}

#[test]
fn a_surface_of_one_side_stays_open() {
    // Möbius's band, five triangles.
    let indices = (0..5).map(|i| [i, (i + 1) % 5, (i + 2) % 5]).collect();
    let positions = (0..5).map(|i| Vec3::new(i as f32, (i * i) as f32, (i % 3) as f32)).collect();
    let band = Triangles { positions, indices, ..Triangles::default() };
    let (mesh, mended) = band.clone().mended(HAIR);
    assert_eq!((mesh, mended), (band, Mended::default()));
}

#[test]
fn hairline_gaps_are_closed_and_wider_ones_are_not() {
    let size = 12f64.sqrt();
    let split = |by: f32| {
        let mut mesh = soup(&cube());
        mesh.positions[..6].iter_mut().for_each(|p| p.z += by);
        mesh
    };
    for by in [3e-7, 1e-5, 3e-4] {
        assert_eq!(volume(&split(by)), None);
        let (mesh, mended) = split(by).mended(HAIR);
        let (corners, far) = mended.welded.expect("a weld");
        assert_eq!((corners, mended.turned), (4, 0));
        assert!((far - by).abs() < 1e-6 && (volume(&mesh).expect("a body") - 8.0).abs() < 5.0 * f64::from(by), "{by}");
    }
    let wide = split(1e-3);
    assert_eq!(wide.clone().mended(HAIR), (wide.clone(), Mended::default()));
    assert!(volume(&wide.clone().mended(1.1e-3 / size).0).is_some());
    assert_eq!(split(3e-7).mended(0.0).1, Mended::default());
}

#[test]
fn joined_parts_have_normals_and_coordinates_throughout() {
    let plain = cube();
    let smooth = Triangles {
        normals: plain.positions.clone(),
        uvs: plain.positions.iter().map(|p| p.truncate()).collect(),
        ..plain.clone()
    };
    let mesh = Triangles::joined([&smooth, &plain]);
    assert_eq!((mesh.positions.len(), mesh.normals.len(), mesh.uvs.len()), (44, 44, 44));
    assert_eq!((mesh.normals[8], mesh.indices[12]), (Vec3::NEG_Z, [8, 9, 10]));
    // A turned triangle takes its normals along.
    let normal = |mesh: &Triangles| mesh.indices[0].map(|corner| mesh.normals[corner as usize].z.signum());
    let mut wrong = Triangles::joined([&smooth]);
    turn(&mut wrong, 0);
    assert_eq!((normal(&smooth), normal(&wrong)), ([-1.0; 3], [1.0; 3]));
}

#[test]
fn rims_in_common_tell_which_parts_belong_together() {
    let part = |range: std::ops::Range<usize>| Triangles { indices: cube().indices[range].to_vec(), ..cube() };
    let rims = [part(0..4), at(part(0..2), Vec3::splat(9.0), 1.0), part(4..12), cube()].map(|mesh| Rim::of(&mesh));
    assert_eq!(Rim::sets(&rims.each_ref()), [0, 1, 0, 3]);
}
