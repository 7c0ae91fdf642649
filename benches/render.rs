//! Whole renders against each other, in one run: what exact Fresnel and eight wavelengths cost, what the default scene takes,
//! and how long it is from start to the first sample. `cargo bench --bench render`
//!
//! Variants take turns and each keeps its fastest time, so that what else the machine does falls on all of them alike; read the
//! ratios, not the seconds.

use spectrel::film::{Layers, Wanted, Window};
use spectrel::fresnel::{FresnelModel, SpectralModel};
use spectrel::render::{Kernel, Recorder, Samples, render};
use spectrel::scene::{Needs, Overrides, Scene, Text, resolve};
use spectrel::spectrum::Library;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

const METALS: &str = include_str!("../scenes/metals.toml");
const TRAY: &str = include_str!("../scenes/tray.toml");
const TURNS: usize = 9;

fn scene(text: &str, overrides: &Overrides) -> Scene {
    let library = Library::new(Vec::new());
    resolve(Text::new("scene.toml", text), &library, overrides).unwrap_or_else(|error| panic!("{error}"))
}

fn time(scene: &Scene) -> Duration {
    let needs = Needs::of(scene);
    let kernel = Kernel::new(scene, &needs);
    let size = [scene.settings.width, scene.settings.height];
    let mut layers = Layers::new(size, Window::full(size[0], size[1]), Wanted::default()).expect("memory");
    let samples = Samples::Same(0..u64::from(scene.settings.samples));
    let started = Instant::now();
    render(&Recorder::new(&kernel, None, None), &mut layers, samples, &(), &AtomicBool::new(false));
    started.elapsed()
}

/// The fastest of some turns of each scene.
fn fastest(scenes: &[Scene]) -> Vec<f64> {
    let mut best = vec![f64::INFINITY; scenes.len()];
    for _ in 0..TURNS {
        for (best, scene) in best.iter_mut().zip(scenes) {
            *best = best.min(time(scene).as_secs_f64());
        }
    }
    best
}

fn compare(title: &str, names: &[&str], scenes: &[Scene]) {
    println!("{title}");
    let times = fastest(scenes);
    for (name, seconds) in names.iter().zip(&times) {
        let settings = &scenes[0].settings;
        let samples = f64::from(settings.width) * f64::from(settings.height) * f64::from(settings.samples);
        println!("  {name:<24} {:>7.1} ns a sample  {:>6.3} ×", seconds / samples * 1e9, seconds / times[0]);
    }
}

fn small(overrides: Overrides) -> Overrides {
    Overrides { width: Some(300), samples: Some(32), ..overrides }
}

fn main() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    pool.install(|| {
        let by_model = |model| scene(METALS, &small(Overrides { fresnel: Some(model), ..Overrides::default() }));
        compare(
            "twelve metals, by Fresnel model, one thread",
            &["schlick", "exact"],
            &[by_model(FresnelModel::Spectral(SpectralModel::Schlick)), by_model(FresnelModel::EXACT)],
        );
        let by_lanes = |lanes| scene(METALS, &small(Overrides { lanes: Some(lanes), ..Overrides::default() }));
        compare("twelve metals, by wavelengths a path, one thread", &["1", "4", "8"], &[1, 4, 8].map(by_lanes));
        let tray = |lanes| scene(TRAY, &small(Overrides { lanes: Some(lanes), ..Overrides::default() }));
        compare("jeweller's tray, by wavelengths a path, one thread", &["1", "4", "8"], &[1, 4, 8].map(tray));
    });
    first_sample();
    let tray = scene(TRAY, &Overrides::default());
    let seconds = time(&tray).as_secs_f64();
    let threads = rayon::current_num_threads();
    println!(
        "jeweller's tray, {} × {}, {} samples, {threads} threads",
        tray.settings.width, tray.settings.height, tray.settings.samples
    );
    println!("  {seconds:.1} s");
}

/// Reading the default scene, tabulating its spectra and rendering one sample of one pixel.
fn first_sample() {
    let one = Overrides { crop: Some([0, 0, 1, 1]), samples: Some(1), ..Overrides::default() };
    let started = Instant::now();
    let scene = scene(TRAY, &one);
    let needs = Needs::of(&scene);
    let kernel = Kernel::new(&scene, &needs);
    let size = [scene.settings.width, scene.settings.height];
    let window = Window { x0: 0, y0: 0, width: 1, height: 1 };
    let mut layers = Layers::new(size, window, Wanted::default()).expect("memory");
    let recorder = Recorder::new(&kernel, None, None);
    render(&recorder, &mut layers, Samples::Same(0..1), &(), &AtomicBool::new(false));
    println!("from the scene's text to the first sample\n  {:.3} s", started.elapsed().as_secs_f64());
}
