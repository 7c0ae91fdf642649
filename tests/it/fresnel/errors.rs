//! Every approximation against errors worked out apart from this program (`tests/data/approximation_errors.csv`: double precision, 1 nm, linear
//! sRGB under D65, cosines in steps of 0.01; its head says how each is defined), through the library and through `spectrel fresnel errors`.

use crate::common::command::{folder, refused, run};
use serde_json::Value;
use spectrel::fresnel::{FresnelModel, Specimen, Tabulated, Target};
use spectrel::spectrum::{Adaptation, Colorimeter, Library, Observer, RgbSpace, ciede2000, lab_from_xyz};
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

/// The rows of the table: symbol, model, and max_abs, rms, mean and largest ΔE.
fn expected() -> Vec<(String, &'static str, [f64; 4])> {
    let file = std::fs::read("tests/data/approximation_errors.csv").expect("committed");
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(&file[..]);
    let row = |record: csv::StringRecord| {
        let (_, name) = NAMES.iter().find(|(theirs, _)| *theirs == &record[1]).expect("a known approximation");
        let values = [2, 4, 5, 6].map(|column| record[column].parse().expect("a number"));
        (record[0].to_owned(), *name, values)
    };
    let rows: Vec<_> = reader.records().map(|record| row(record.expect("a row"))).collect();
    assert_eq!(rows.len(), 72);
    rows
}

/// What is wrong with max_abs, rms, mean and largest ΔE, if anything.
fn wrong(what: &str, model: &str, found: [f64; 4], expected: [f64; 4]) -> Option<String> {
    let fitted = ["lazanyi", "gulbrandsen"].contains(&model);
    let color = [false, false, true, true];
    let fine = (0..4).all(|i| agrees(found[i], expected[i], fitted, color[i]));
    (!fine).then(|| format!("{what} {model}: {found:?} where {expected:?} is expected"))
}

#[test]
fn every_approximation_is_as_far_off_as_it_should_be() {
    let library = Library::default();
    let meter = d65(&library);
    let mut bad = Vec::new();
    for (symbol, material) in SETS {
        let optics = spectrel::scene::optics(material, None, &library).expect("built in");
        let target = Target::new(Specimen::in_vacuum(&optics.ior), &meter);
        for (_, name, expected) in expected().into_iter().filter(|row| row.0 == symbol) {
            let found = errors(name.parse().expect("a model"), &target);
            println!("{symbol} {name}: {found:?}");
            bad.extend(wrong(symbol, name, [found.max_abs, found.rms, found.de_mean, found.de_max], expected));
        }
    }
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}

/// What the command says, as JSON.
fn said(args: &[&str]) -> Vec<Value> {
    let output = run(folder(&[]).path(), &[&["fresnel", "errors", "--format", "json"], args].concat());
    let json: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    json.as_array().expect("an array").clone()
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// ΔE of an object under a light after some bounces.
fn color(row: &Value, light: &str, bounces: i64, key: &str) -> f64 {
    let colors = row["colors"].as_array().expect("an array");
    let found = colors.iter().find(|color| color["light"] == light && color["bounces"] == bounces);
    number(&found.expect("light and bounces")[key])
}

#[test]
fn the_command_says_the_same() {
    let rows = said(&[]);
    assert_eq!(rows.len(), 5 * 13 + 16, "models that apply to five metals and a dielectric");
    let mut bad = Vec::new();
    for (symbol, name, expected) in expected() {
        let (_, material) = SETS.iter().find(|(theirs, _)| *theirs == symbol).expect("one of the six");
        let row = rows.iter().find(|row| row["material"] == *material && row["model"] == name).expect("a row");
        let found = ["max_abs", "rms", "de_mean", "de_max"].map(|key| number(&row[key]));
        bad.extend(wrong(material, name, found, expected));
    }
    assert!(bad.is_empty(), "{}", bad.join("\n"));
    for row in &rows {
        assert!(number(&row["ns"]) > 0.0);
        assert_eq!(row["colors"].as_array().map(Vec::len), Some(12), "three lights, four counts of bounces");
        assert_eq!(color(row, "D65", 1, "de_mean"), number(&row["de_mean"]));
        if row["model"] == "exact" {
            assert!(
                ["max_abs", "rms", "de_max", "f_avg_max_abs", "f_avg_de"].iter().all(|key| number(&row[key]) == 0.0)
            );
        }
    }
}

#[test]
fn fitted_parameters_are_reported() {
    let rows = said(&["gold", "--models", "lazanyi,gulbrandsen,schlick"]);
    let fitted = |row: usize, key: &str| -> Vec<f64> {
        rows[row]["fitted"][key].as_array().expect("r, g and b").iter().map(number).collect()
    };
    assert!(fitted(0, "alpha").iter().all(|alpha| *alpha > 0.0) && fitted(0, "a").len() == 3);
    assert!(fitted(1, "g").iter().all(|g| (0.0..=1.0).contains(g)));
    assert!(rows[2].get("fitted").is_none());
}

/// Spectral and RGB Schlick are both linear in F0: one bounce under the light of the fit cannot tell them apart, more bounces and other
/// lights can.
#[test]
fn spectra_show_after_two_bounces_and_under_other_lights() {
    let library = Library::default();
    let meter = d65(&library);
    for (_, material) in SETS {
        let optics = spectrel::scene::optics(material, None, &library).expect("built in");
        let target = Target::new(Specimen::in_vacuum(&optics.ior), &meter);
        let [spectral, rgb] =
            ["schlick", "schlick-rgb"].map(|name| Tabulated::new(name.parse().expect("a model"), &target));
        let apart = |cos: f64, bounces: i32| {
            let [a, b] = [&spectral, &rgb].map(|model| meter.lab(model.color(cos, bounces, &meter)));
            ciede2000(a, b)
        };
        let once = Target::cosines().map(|cos| apart(cos, 1)).fold(0.0, f64::max);
        println!("{material}: {once:.1e} after one bounce, {:.3} after two at normal incidence", apart(1.0, 2));
        assert!(once < 1e-4, "{material}: {once}");
        assert!(apart(1.0, 2) > 20.0 * once);
    }
    let rows = said(&["gold", "--models", "schlick,schlick-rgb"]);
    // Of gold's F0 after 2, 3 and 5 bounces: ΔE 3, 7 and 15.
    for (bounces, expected) in [(2, 2.9), (3, 6.9), (5, 15.1)] {
        assert!(color(&rows[0], "D65", bounces, "de_normal") < 1e-3);
        assert!((color(&rows[1], "D65", bounces, "de_normal") - expected).abs() < 0.1, "{bounces}");
    }
    for light in ["A", "FL2"] {
        assert!(
            color(&rows[0], light, 1, "de_normal") < 1e-3 && color(&rows[1], light, 1, "de_normal") > 0.9,
            "{light}"
        );
    }
}

/// What the head of `report::fresnel::errors` quotes: gold's F0 under A in an engine that multiplies with the light's RGB and adapts nothing,
/// seen by an eye adapted to A.
#[test]
fn without_adaptation_rgb_is_further_off() {
    let library = Library::default();
    let light = library.illuminant("A", Path::new("")).expect("built in");
    let observer = library.observer(Observer::Cie1931).expect("built in");
    let meter = Colorimeter::new(&light.spectrum, &observer, RgbSpace::Srgb, Adaptation::None).expect("A has light");
    let optics = spectrel::scene::optics("gold", None, &library).expect("built in");
    let specimen = Specimen::in_vacuum(&optics.ior);
    let white = meter.rgb(|_| 1.0);
    let engine = d65(&library).rgb(|nm| specimen.reflect(nm, 1.0).r);
    let engine = std::array::from_fn(|i| engine[i] * white[i]);
    let lab = |rgb| {
        let xyz = RgbSpace::Srgb.xyz_from_rgb();
        lab_from_xyz(xyz.apply(rgb), xyz.apply(white))
    };
    let unadapted = ciede2000(lab(engine), lab(meter.rgb(|nm| specimen.reflect(nm, 1.0).r)));
    let adapted = color(&said(&["gold", "--models", "schlick-rgb"])[0], "A", 1, "de_normal");
    println!("ΔE {adapted:.3} adapted, {unadapted:.3} not");
    assert!((unadapted - 6.92).abs() < 0.05 && (adapted - 1.0).abs() < 0.05);
}

/// The average over the hemisphere against an integration of its own: adaptive, of the exact curve and of Schlick's closed form.
#[test]
fn averages_are_those_of_an_integration() {
    let library = Library::default();
    let meter = d65(&library);
    let optics = spectrel::scene::optics("gold", None, &library).expect("built in");
    let target = Target::new(Specimen::in_vacuum(&optics.ior), &meter);
    let f0 = target.f0();
    let exact: [f64; 3] = std::array::from_fn(|i| {
        meter.rgb(|nm| spectrel::fresnel::average(|cos| target.specimen.reflect(nm, cos).r))[i]
    });
    let schlick = f0.map(|f0| f0 + (1.0 - f0) / 21.0);
    let largest = (0..3).map(|i| (exact[i] - schlick[i]).abs()).fold(0.0, f64::max);
    let de = ciede2000(meter.lab(exact), meter.lab(schlick));
    let row = &said(&["gold", "--models", "schlick-rgb"])[0];
    let found = [number(&row["f_avg_max_abs"]), number(&row["f_avg_de"])];
    println!("{largest:.6} and ΔE {de:.4}; the command says {found:?}");
    assert!((found[0] - largest).abs() < 5e-6 && (found[1] - de).abs() < 1e-3);
}

#[test]
fn every_metal_has_its_errors() {
    let rows = said(&["--metals", "--models", "schlick,f82"]);
    let metals: std::collections::BTreeSet<_> = rows.iter().map(|row| row["material"].to_string()).collect();
    assert!(metals.len() >= 35 && rows.len() == 2 * metals.len(), "{}", metals.len());
    assert!(metals.contains("\"tungsten\"") && !metals.contains("\"diamond\""));
}

#[test]
fn tables_hold_what_the_json_holds() {
    let text = |format: &str| {
        let output = run(folder(&[]).path(), &["fresnel", "errors", "gold", "diamond", "--format", format]);
        String::from_utf8(output.stdout).expect("text")
    };
    let table = text("table");
    assert!(table.lines().all(|line| line.chars().count() <= 110), "{table}");
    let line = table.lines().find(|line| line.starts_with("schlick-rgb")).expect("a line");
    let cells: Vec<_> = line.split_whitespace().collect();
    assert_eq!(cells[1..8], ["0.0344", "77°", "0.0133", "0.0096", "0.87", "2.40", "84°"]);
    let markdown = text("md");
    assert!(
        markdown.starts_with("### gold (`Au/olmon-2012-evaporated`)\n\n| Model ") && markdown.contains("### diamond")
    );
    let csv = text("csv");
    let head: Vec<_> = csv.lines().next().expect("a head").split(',').collect();
    assert_eq!(
        head[..9],
        ["material", "ior", "model", "max_abs", "cos_at_max", "rms", "de_mean", "de_max", "cos_at_de_max"]
    );
    assert!(head.contains(&"de_mean_fl2_x5") && csv.lines().all(|line| line.split(',').count() == head.len()));
}

#[test]
fn slips_are_told_with_what_is_near() {
    let folder = folder(&[]);
    for (args, says) in [
        (&["gould"][..], &["`gould`", "did you mean `gold`?"][..]),
        (&["gold", "--models", "gulbransen"], &["`gulbransen`", "did you mean `gulbrandsen`?"]),
        (&["gold", "--models", "cook-torrance"], &["`cook-torrance`", "`gold`", "dielectrics"]),
        (&["gold", "--metals"], &["--metals"]),
    ] {
        let stderr = refused(folder.path(), &[&["fresnel", "errors"], args].concat());
        assert!(says.iter().all(|words| stderr.contains(words)), "{args:?}: {stderr}");
    }
}
