//! The picture depends on scene and seed alone: not on threads, on how a job is cut, or on the build.

mod common;

use common::{film, scene};
use spectrel::film::fnv1a_64;
use spectrel::film::{Film, Window};
use spectrel::render::Kernel;
use spectrel::scene::{Needs, Overrides};

const SCENE: &str = include_str!("data/reproducible.toml");
const PICTURES: &str = include_str!("data/pictures.toml");

fn in_threads(text: &str, threads: usize) -> Film {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| film(&scene(text, &Overrides::default())))
}

#[test]
fn one_thread_and_two_give_the_same_film() {
    assert!(in_threads(SCENE, 1) == in_threads(SCENE, 2));
    assert!(in_threads(PICTURES, 1) == in_threads(PICTURES, 2));
}

#[test]
fn parts_of_a_job_merge_into_the_same_film() {
    let scene = scene(SCENE, &Overrides::default());
    let needs = Needs::of(&scene);
    let kernel = Kernel::new(&scene, &needs);
    let part = |samples, window| common::part(&kernel, [48, 32], window, samples);
    let mut whole = part(13..20, Window::full(48, 32));
    whole.merge(&part(0..13, Window { x0: 0, y0: 0, width: 48, height: 32 })).expect("the same window");
    assert!(whole == film(&scene), "ranges of samples");
    let mut tiled = Film::new([48, 32], Window::full(48, 32)).expect("a small film");
    for tile in Window::full(48, 32).tiles(20) {
        tiled.merge_tile(&part(0..20, tile)).expect("inside");
    }
    assert!(tiled == film(&scene), "windows");
}

/// Run in debug and in release: both must find the value that stands here.
#[test]
fn every_build_gives_these_bits() {
    let bits = [SCENE, PICTURES].map(|text| {
        let film = in_threads(text, 2);
        let sums: Vec<u8> = film.pixels().iter().flat_map(|pixel| pixel.mean()).flat_map(f64::to_le_bytes).collect();
        format!("{:016x}", fnv1a_64(&sums))
    });
    assert_eq!(bits, ["7cdffdd403c2f493", "c82add52156375bf"]);
}

#[test]
fn another_seed_gives_another_film() {
    let other = Overrides { seed: Some(8), ..Overrides::default() };
    assert!(film(&scene(SCENE, &other)) != film(&scene(SCENE, &Overrides::default())));
}
