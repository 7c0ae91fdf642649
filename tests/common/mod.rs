//! What the tests of whole renders share: scenes from text, means of pictures, statistics of independent renders.

#![allow(dead_code, reason = "each test binary uses a part")]

pub mod command;
pub mod compare;
pub mod facets;
pub mod files;
pub mod lanes;
pub mod meshes;
pub mod paper;
pub mod pictures;
pub mod plates;
pub mod prism;
pub mod random;

use spectrel::film::{Film, Layers, Wanted, Window};
use spectrel::render::{Kernel, Recorder, Samples, render};
use spectrel::scene::{Needs, Overrides, Scene, Text, resolve};
use spectrel::spectrum::Library;
use std::ops::Range;
use std::sync::atomic::AtomicBool;

pub fn library() -> Library {
    Library::new(Vec::new())
}

pub fn scene(text: &str, overrides: &Overrides) -> Scene {
    resolve(Text::new("tests/scene.toml", text), &library(), overrides).unwrap_or_else(|error| panic!("{error}"))
}

/// All samples of a scene's crop window.
pub fn film(scene: &Scene) -> Film {
    let needs = Needs::of(scene);
    film_by(&Kernel::new(scene, &needs), scene)
}

/// The same by a kernel of the scene.
pub fn film_by(kernel: &Kernel, scene: &Scene) -> Film {
    let [x0, y0, x1, y1] = scene.settings.crop;
    let window = Window { x0, y0, width: x1 - x0, height: y1 - y0 };
    part(kernel, [scene.settings.width, scene.settings.height], window, 0..u64::from(scene.settings.samples))
}

/// Some samples of a window of an image of so many pixels.
pub fn part(kernel: &Kernel, image: [u32; 2], window: Window, samples: Range<u64>) -> Film {
    let mut layers = Layers::new(image, window, Wanted::default()).expect("a small film");
    let recorder = Recorder::new(kernel, None, None);
    render(&recorder, &mut layers, Samples::Same(samples), &(), &AtomicBool::new(false));
    layers.into_film()
}

/// Mean XYZ of a film, cd/m².
pub fn mean(film: &Film) -> [f64; 3] {
    let pixels = film.pixels();
    let sum = pixels.iter().fold([0.0; 3], |sum, pixel| std::array::from_fn(|i| sum[i] + pixel.mean()[i]));
    sum.map(|value| value / pixels.len() as f64)
}

/// Mean XYZ of a picture rendered with `count` seeds of its own, from `first` on.
pub fn replicates(text: &str, overrides: &Overrides, first: u64, count: u64) -> Vec<[f64; 3]> {
    let render = |seed| mean(&film(&scene(text, &Overrides { seed: Some(seed), ..overrides.clone() })));
    (first..first + count).map(render).collect()
}

/// Mean and standard error of the mean of independent values.
pub fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (n - 1.0);
    (mean, (variance / n).sqrt())
}

/// Largest |t| over X, Y and Z between two sets of renders with equal seeds, by the spread of their differences: what chance
/// does to both falls out, and the pairs are independent of each other.
pub fn t_of_pairs(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let difference = |(a, b): (&[f64; 3], &[f64; 3])| std::array::from_fn(|i| a[i] - b[i]);
    z_against(&a.iter().zip(b).map(difference).collect::<Vec<_>>(), [0.0; 3])
}

/// Largest |z| over X, Y and Z of independent renders against a known value.
pub fn z_against(renders: &[[f64; 3]], expected: [f64; 3]) -> f64 {
    (0..3)
        .map(|i| {
            let (mean, error) = mean_and_error(&renders.iter().map(|xyz| xyz[i]).collect::<Vec<_>>());
            (mean - expected[i]).abs() / error
        })
        .fold(0.0, f64::max)
}
