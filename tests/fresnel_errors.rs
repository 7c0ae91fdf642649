//! Every approximation against errors worked out apart from this program (`tests/data/approximation_errors.csv`: double precision, 1 nm, linear
//! sRGB under D65, cosines in steps of 0.01; its head says how each is defined).

use spectrel::fresnel::{FresnelModel, Specimen, Tabulated, Target};
use spectrel::spectrum::{Adaptation, Colorimeter, Library, Observer, RgbSpace, ciede2000};
use std::path::Path;

/// The primary data of the six materials.
const SETS: [(&str, &str); 6] =
    [("Ag", "silver"), ("Au", "gold"), ("Cu", "copper"), ("Al", "aluminium"), ("Fe", "iron"), ("diamond", "diamond")];

const NAMES: [(&str, &str); 12] = [
    ("schlick_rgb", "schlick-rgb"),
    ("schlick_spectral", "schlick"),
    ("schlick_sg_rgb", "schlick-gaussian"),
    ("lsk_fit_rgb", "lazanyi"),
    ("hoffman_f82_rgb", "f82"),
    ("adobe_f82tint_clamped", "f82-tint"),
    ("f82_spectral", "f82-spectral"),
    ("gulbrandsen_fit_g", "gulbrandsen"),
    ("rgb_nk_projected", "rgb-exact"),
    ("rgb_nk_sampled_611_549_464", "rgb-exact-611-549-464"),
    ("rgb_nk_sampled_650_550_450", "rgb-exact-650-550-450"),
    ("constant_F0", "constant"),
];

#[derive(Debug, Default)]
struct Errors {
    max_abs: f64,
    rms: f64,
    de_mean: f64,
    de_max: f64,
}

fn d65(library: &Library) -> Colorimeter {
    let light = library.illuminant("D65", Path::new("")).expect("built in");
    let observer = library.observer(Observer::Cie1931).expect("built in");
    Colorimeter::new(&light.spectrum, &observer, RgbSpace::Srgb, Adaptation::Bradford).expect("D65 has light")
}

fn errors(model: FresnelModel, target: &Target) -> Errors {
    let tabulated = Tabulated::new(model, target);
    let mut errors = Errors::default();
    let mut squares = 0.0;
    for (cos, &exact) in Target::cosines().zip(target.curve()) {
        let color = tabulated.color(cos, 1, target.meter);
        let off: [f64; 3] = std::array::from_fn(|i| (color[i] - exact[i]).abs());
        errors.max_abs = off.into_iter().fold(errors.max_abs, f64::max);
        squares += off.iter().map(|off| off * off).sum::<f64>();
        let de = ciede2000(target.meter.lab(color), target.meter.lab(exact));
        errors.de_mean += de / 101.0;
        errors.de_max = errors.de_max.max(de);
    }
    errors.rms = (squares / 303.0).sqrt();
    errors
}

/// Of one value: within 2 %, or 2e-4 of a reflectance or 0.01 of ΔE; of fits within 10 % or 0.05 of ΔE.
fn agrees(found: f64, expected: f64, fitted: bool, color: bool) -> bool {
    let share = if fitted { 0.1 } else { 0.02 };
    let least = match (color, fitted) {
        (false, _) => 2e-4,
        (true, false) => 0.01,
        (true, true) => 0.05,
    };
    (found - expected).abs() <= least || (found / expected - 1.0).abs() <= share
}

#[test]
fn every_approximation_is_as_far_off_as_it_should_be() {
    let library = Library::default();
    let meter = d65(&library);
    let file = std::fs::read("tests/data/approximation_errors.csv").expect("committed");
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(&file[..]);
    let mut rows = 0;
    let mut wrong = Vec::new();
    let records: Vec<csv::StringRecord> = reader.records().map(|record| record.expect("a row")).collect();
    for (symbol, material) in SETS {
        let optics = spectrel::scene::optics(material, None, &library).expect("built in");
        let target = Target::new(Specimen::in_vacuum(&optics.ior), &meter);
        for row in records.iter().filter(|row| &row[0] == symbol) {
            let (_, name) = NAMES.iter().find(|(theirs, _)| *theirs == &row[1]).expect("a known approximation");
            let found = errors(name.parse().expect("a model"), &target);
            let expected = |column: usize| row[column].parse::<f64>().expect("a number");
            let fitted = ["lazanyi", "gulbrandsen"].contains(name);
            println!("{symbol} {name}: {found:?}");
            let pairs = [
                (found.max_abs, expected(2), false),
                (found.rms, expected(4), false),
                (found.de_mean, expected(5), true),
                (found.de_max, expected(6), true),
            ];
            for (found, expected, color) in pairs {
                if !agrees(found, expected, fitted, color) {
                    wrong.push(format!("{symbol} {name}: {found} where {expected} is expected"));
                }
            }
            rows += 1;
        }
    }
    assert_eq!(rows, 72);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
