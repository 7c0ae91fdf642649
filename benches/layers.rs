//! What the layers of a film cost beside the picture, one thread, twelve metals. `cargo bench --bench layers`
//!
//! Variants take turns and each keeps its fastest time; read the ratios.

use spectrel::film::{Layers, Wanted, Window};
use spectrel::render::{Guides, Kernel, Recorder, Samples, render};
use spectrel::scene::{Needs, Overrides, Text, resolve};
use spectrel::spectrum::{Bins, Library, RgbSpace};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

const METALS: &str = include_str!("../scenes/metals.toml");
const TURNS: usize = 15;

fn main() {
    let overrides = Overrides { width: Some(300), samples: Some(32), ..Overrides::default() };
    let scene = resolve(Text::new("scene.toml", METALS), &Library::new(Vec::new()), &overrides).expect("a scene");
    let (needs, cancel) = (Needs::of(&scene), AtomicBool::new(false));
    let kernel = Kernel::new(&scene, &needs);
    let size = [scene.settings.width, scene.settings.height];
    let window = Window::full(size[0], size[1]);
    let seconds = |wanted: Wanted| {
        let mut layers = Layers::new(size, window, wanted).expect("memory");
        let guides = wanted.features.then(|| Guides::first_hit(&scene, &needs, RgbSpace::Srgb));
        let bins = (wanted.bands > 0).then(Bins::default);
        let recorder = Recorder::new(&kernel, guides, bins.as_ref());
        let started = Instant::now();
        render(&recorder, &mut layers, Samples::Same(0..32), &(), &cancel);
        started.elapsed().as_secs_f64()
    };
    let none = Wanted::default();
    let variants = [
        ("film alone", none),
        ("albedo and normal", Wanted { features: true, ..none }),
        ("variance", Wanted { replicates: true, ..none }),
        ("41 bands", Wanted { bands: 41, ..none }),
    ];
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let mut best = [f64::INFINITY; 4];
    pool.install(|| {
        for _ in 0..TURNS {
            for (best, (_, wanted)) in best.iter_mut().zip(variants) {
                *best = best.min(seconds(wanted));
            }
        }
    });
    let samples = window.pixel_count() as f64 * 32.0;
    for ((name, _), time) in variants.iter().zip(best) {
        println!("  {name:<20} {:>7.1} ns a sample  {:>6.3} ×", time / samples * 1e9, time / best[0]);
    }
}
