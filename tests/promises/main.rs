//! What `--target-error` promises in scenes of all kinds of light: it is true, or nothing is promised.
//!
//! Every scene is rendered with 24 seeds for each of three targets and held against the truth of many more samples. A cell, a target in a
//! scene, is kept where the truth is no more than what was promised; renders that end without a promise say so and count for nothing.
//! Takes minutes: `cargo test --release --test promises -- --ignored --nocapture` prints the table.

#[path = "../common/mod.rs"]
mod common;
mod scenes;

use common::pictures::{write_exr, write_png};
use scenes::Case;
use spectrel::adaptive::noise::Noise;
use spectrel::adaptive::{Goal, Measure, Reached, RenderLoop, Target};
use spectrel::film::Unseen;
use spectrel::film::View;
use spectrel::film::{Develop, Exposure, Gamut, Layers, REPLICATES, Wanted, Window};
use spectrel::fresnel::FresnelModel;
use spectrel::render::{Kernel, Recorder, Samples};
use spectrel::report::Difference;
use spectrel::report::difference::{Image, compare};
use spectrel::scene::describe::ExposureValue;
use spectrel::scene::{Chance, Needs, Overrides, Scene, Text, resolve};
use spectrel::spectrum::{RgbSpace, ciede2000, lab_from_xyz};
use std::sync::LazyLock;
use std::sync::atomic::AtomicBool;

/// Pixels to a side.
const SIZE: u32 = 16;
const PIXELS: usize = (SIZE * SIZE) as usize;

const SEEDS: u64 = 24;

/// Samples a pixel after which a render ends without a promise.
const LIMIT: u64 = 512;

/// Samples a pixel of what is taken for the truth.
const TRUTH: u32 = 1 << 16;

const MEASURES: [(&str, Measure); 3] = [("dE", Measure::MeanDe), ("dE95", Measure::De95), ("rmse", Measure::Rmse)];

/// Scenes in which promises are near the truth: at most three times it in the median.
const FRIENDLY: [&str; 5] = [
    "picture on the floor",
    "matt things under a panel",
    "metals under a sky",
    "sun over matt things and satin",
    "many lamps",
];

/// Linear sRGB of every pixel.
type Picture = Vec<[f64; 3]>;

fn read(case: &Case, overrides: &Overrides) -> Scene {
    static FOLDER: LazyLock<tempfile::TempDir> = LazyLock::new(|| {
        let folder = tempfile::tempdir().expect("a folder");
        let (width, texels) = scenes::sky();
        write_exr(&folder.path().join("sky.exr"), width, &texels);
        let checks = folder.path().join("checks.png");
        write_png(&checks, 8, png::ColorType::Rgb, png::BitDepth::Eight, &scenes::checks());
        folder
    });
    let path = FOLDER.path().join("scene.toml");
    let overrides = Overrides { width: Some(SIZE), height: Some(SIZE), ..overrides.clone() };
    resolve(Text::new(path, &case.text), &common::library(), &overrides)
        .unwrap_or_else(|error| panic!("{}: {error}", case.name))
}

fn develop(scene: &Scene) -> Develop {
    let ExposureValue::Ev(ev) = scene.picture.exposure else { panic!("an exposure") };
    Develop { exposure: Exposure::Ev(ev), white: scene.picture.white, space: RgbSpace::Srgb, gamut: Gamut::Clip }
}

fn ev(develop: &Develop) -> f64 {
    develop.exposure.ev([]).expect("an exposure")
}

fn developed(film: &spectrel::film::Film, scene: &Scene) -> Picture {
    film.develop(&develop(scene)).expect("a picture").rgb.iter().map(|rgb| rgb.map(f64::from)).collect()
}

fn truth(case: &Case) -> Picture {
    let scene = read(case, &Overrides { samples: Some(TRUTH), seed: Some(1 << 40), ..Overrides::default() });
    developed(&common::film(&scene), &scene)
}

/// A render that stops by its error, knowing what it may miss or not.
fn stopped(case: &Case, seed: u64, target: Target, knows: bool) -> (Picture, Reached) {
    rendered(case, seed, |work, layers, develop, needs| {
        let none = Chance::default();
        let chance = if knows { &needs.chance } else { &none };
        work.for_error(layers, &Goal { targets: &[target], time: None, most: LIMIT, chance }, develop, &|_| {})
            .expect("a picture")
    })
}

/// One that looks at all of its own samples after each step, and stops when these tell that its error is small enough; and after how many.
fn selfish(case: &Case, seed: u64, target: Target) -> (Picture, f64) {
    let view = |develop: &Develop| View::new(ev(develop), develop.white);
    let unseen = Unseen { brightest: [0.0; 3], samples: 1.0, pixels: 1.0 };
    let small_enough = |layers: &Layers, develop: &Develop| {
        let noise = Noise::of(layers.replicates(), SIZE as usize, &view(develop));
        target.measure.of(&noise, &view(develop), &unseen).promised <= target.bound
    };
    let render = |work: &RenderLoop, layers: &mut Layers, develop: &Develop, _: &Needs| {
        let mut samples = 16;
        work.evenly(layers, samples);
        while samples < LIMIT && !small_enough(layers, develop) {
            work.add(layers, Samples::Own(&vec![samples..samples + samples / 4; PIXELS]));
            samples += samples / 4;
        }
        samples as f64
    };
    rendered(case, seed, render)
}

fn rendered<T>(
    case: &Case,
    seed: u64,
    render: impl Fn(&RenderLoop, &mut Layers, &Develop, &Needs) -> T,
) -> (Picture, T) {
    let scene = read(case, &Overrides { seed: Some(seed), ..Overrides::default() });
    let needs = Needs::of(&scene);
    let kernel = Kernel::new(&scene, &needs);
    let recorder = Recorder::new(&kernel, None, None);
    let wanted = Wanted { replicates: true, ..Wanted::default() };
    let mut layers = Layers::new([SIZE; 2], Window::full(SIZE, SIZE), wanted).expect("small");
    let cancel = AtomicBool::new(false);
    let work = RenderLoop::new(&recorder, &(), &cancel);
    let told = render(&work, &mut layers, &develop(&scene), &needs);
    (developed(layers.film(), &scene), told)
}

fn error(measure: Measure, picture: &Picture, truth: &Picture) -> f64 {
    let pairs = || picture.iter().zip(truth);
    if measure == Measure::Rmse {
        let squares = pairs().flat_map(|(a, b)| (0..3).map(|c| (a[c] - b[c]) * (a[c] - b[c])));
        return (squares.sum::<f64>() / (3 * PIXELS) as f64).sqrt();
    }
    let space = RgbSpace::Srgb;
    let lab = |rgb: [f64; 3]| lab_from_xyz(space.xyz_from_rgb().apply(rgb), space.white_xyz());
    let mut all: Vec<f64> = pairs().map(|(a, b)| ciede2000(lab(*a), lab(*b))).collect();
    all.sort_by(f64::total_cmp);
    match measure {
        Measure::De95 => all[PIXELS * 95 / 100],
        _ => all.iter().sum::<f64>() / PIXELS as f64,
    }
}

/// What became of a target in a scene.
struct Cell {
    /// Renders that ended with a promise.
    promised: usize,
    kept: usize,
    /// Median of what was promised over what is true.
    over: f64,
    /// Mean samples a pixel.
    samples: f64,
}

fn cell(case: &Case, measure: Measure, bound: f64, truth: &LazyLock<Picture, impl FnOnce() -> Picture>) -> Cell {
    let target = Target { measure, bound };
    let renders: Vec<_> = (0..SEEDS).map(|seed| stopped(case, seed, target, true)).collect();
    let samples = renders.iter().map(|(_, reached)| reached.mean_samples).sum::<f64>() / SEEDS as f64;
    let met = renders.iter().filter(|(_, reached)| reached.met);
    let mut ratios: Vec<f64> =
        met.map(|(picture, reached)| reached.bounds[0].promised / error(measure, picture, truth)).collect();
    ratios.sort_by(f64::total_cmp);
    Cell {
        promised: ratios.len(),
        kept: ratios.iter().filter(|ratio| **ratio >= 1.0).count(),
        over: ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN),
        samples,
    }
}

#[test]
#[ignore = "long: minutes"]
fn promises_are_kept_or_not_made() {
    let (mut broken, mut with_promise) = (Vec::new(), 0);
    println!("{:<32} {:<10} {:>6} {:>6} {:>6} {:>8}", "scene", "target", "made", "kept", "over", "samples");
    for case in &scenes::all() {
        let truth = LazyLock::new(|| truth(case));
        let mut any = false;
        for ((name, measure), bound) in MEASURES.into_iter().zip(case.targets) {
            let Cell { promised, kept, over, samples } = cell(case, measure, bound, &truth);
            let name = format!("{name}={bound}");
            println!("{:<32} {name:<10} {promised:>6} {kept:>6} {over:>6.2} {samples:>8.0}", case.name);
            any |= 2 * promised >= SEEDS as usize;
            if 10 * kept < 9 * promised {
                broken.push(format!("{}, {name}: {kept} of {promised}", case.name));
            }
            if FRIENDLY.contains(&case.name) && (promised == 0 || over > 3.0) {
                broken.push(format!("{}, {name}: promised {over} times the truth", case.name));
            }
        }
        with_promise += usize::from(any);
    }
    assert!(broken.is_empty(), "{broken:#?}");
    assert!(with_promise >= 12, "{with_promise}");
}

/// Luminance of a whole picture.
fn brightness(picture: &Picture) -> f64 {
    let weights = RgbSpace::Srgb.xyz_from_rgb().0[1];
    picture.iter().flat_map(|rgb| (0..3).map(|c| weights[c] * rgb[c])).sum()
}

/// How much brighter renders are that decide when to stop than renders of the same numbers that decide nothing, after as many samples in the
/// mean: in per cent, and in standard errors. What both find or miss by chance falls out.
fn brighter(case: &Case, seeds: u64, deciding: impl Fn(u64) -> (Picture, f64)) -> (f64, f64) {
    let (pictures, samples): (Vec<_>, Vec<_>) = (0..seeds).map(deciding).unzip();
    let each = REPLICATES as f64;
    let samples = each * (samples.iter().sum::<f64>() / seeds as f64 / each).round();
    let evenly = |seed| rendered(case, seed, |work, layers, _, _| work.evenly(layers, samples as u64)).0;
    let even: Vec<f64> = (0..seeds).map(|seed| brightness(&evenly(seed))).collect();
    let differences: Vec<f64> = pictures.iter().zip(&even).map(|(picture, even)| brightness(picture) - even).collect();
    let ((mean, error), (all, _)) = (common::mean_and_error(&differences), common::mean_and_error(&even));
    // No difference at all is none of any size, for however few pairs.
    (100.0 * mean / all, if mean == 0.0 { 0.0 } else { mean / error })
}

/// Where the light that decides is found by one path in many, a picture is as bright in the mean as one that decides nothing: renders that
/// do not know what they may miss stop by luck alone. `SPECTREL_BIAS_SEEDS` sets how many renders tell it.
#[test]
#[ignore = "long: minutes"]
fn deciding_samples_bias_nothing() {
    let seeds = std::env::var("SPECTREL_BIAS_SEEDS").map_or(200, |seeds| seeds.parse().expect("a number"));
    let (cases, mut seen) = (scenes::all(), 0);
    for (name, measure, bound) in [
        ("caustic of a gold ball", Measure::MeanDe, 0.7),
        ("caustic of a gold ball", Measure::Rmse, 0.05),
        ("caustic of a glass ball", Measure::MeanDe, 1.5),
        ("caustic of a glass ball", Measure::Rmse, 0.05),
        ("sun texel over gold and glass", Measure::Rmse, 0.1),
        ("metals and matt things", Measure::MeanDe, 2.0),
    ] {
        let case = cases.iter().find(|case| case.name == name).expect("a scene");
        let target = Target { measure, bound };
        let by_halves = |seed| {
            let (picture, reached) = stopped(case, seed, target, false);
            (picture, reached.mean_samples)
        };
        let deciding = brighter(case, seeds, by_halves);
        let selfish = brighter(case, 60, |seed| selfish(case, seed, target));
        println!(
            "{name}, {}={bound}: {:+.2} %, {:.1} standard errors; by their own {:+.2} %, {:.1}",
            measure, deciding.0, deciding.1, selfish.0, selfish.1
        );
        assert!(deciding.1.abs() < 3.5, "{name} {bound}");
        seen += usize::from(selfish.1 < -5.0);
    }
    assert!(seen >= 3, "a bias must be seen: {seen}");
}

/// Exact Fresnel against Schlick on iron, whose lamp only paths by way of the iron find: intervals hold the truth.
#[test]
#[ignore = "long: minutes"]
fn intervals_of_comparisons_hold_the_truth() {
    let cases = scenes::all();
    for (name, least) in [("iron balls under a small lamp", 0), ("metals under a sky", 90)] {
        let case = cases.iter().find(|case| case.name == name).expect("a scene");
        let image = |model: FresnelModel, seed: u64, samples: u32| -> Image {
            let overrides =
                Overrides { fresnel: Some(model), seed: Some(seed), samples: Some(samples), ..Overrides::default() };
            let film = common::film(&read(case, &overrides));
            film.pixels().iter().map(|pixel| pixel.mean().map(|c| c as f32)).collect()
        };
        let scene = read(case, &Overrides::default());
        let (develop, chance) = (develop(&scene), Needs::of(&scene).chance);
        let view = View::new(ev(&develop), develop.white);
        let models = [FresnelModel::EXACT, "schlick".parse().expect("a model")];
        let compared = |seed: u64, samples: u32| {
            let of = |model: FresnelModel| (0..8).map(|r| image(model, 8 * seed + r, samples / 8)).collect::<Vec<_>>();
            let (samples, pixels) = (f64::from(samples), PIXELS as f64);
            let unseen = Unseen { brightest: view.display_f64(chance.brightest), samples, pixels };
            compare(&view, &of(models[0]), &of(models[1]), &unseen).difference
        };
        let truth = compared(1 << 30, TRUTH);
        for samples in [16, 64, 256] {
            let found: Vec<_> = (0..100).map(|seed| compared(seed, samples)).collect();
            let held = |ends: fn(&Difference) -> [f64; 2], value: f64| {
                found.iter().filter(|found| ends(found)[0] <= value && value <= ends(found)[1]).count()
            };
            let delta_e = held(|found| found.delta_e2000.interval_95, truth.delta_e2000.mean);
            let energy = held(|found| found.energy.interval_95, truth.energy.value);
            let unsure = found.iter().filter(|found| found.may_miss_much()).count();
            println!(
                "{name}, {samples} samples: ΔE {delta_e}, energy {energy} of 100; {unsure} say that they may miss much"
            );
            assert!(delta_e >= 90 && energy >= 90, "{name} {samples}: {delta_e} {energy}");
            assert!(samples < 64 || 100 - unsure >= least, "{name} {samples}: {unsure}");
        }
    }
}
