//! `spectrel fresnel curve`: the numbers against the equations, the figures as files, and what is refused.

use crate::common::command::{folder, refused, run};
use spectrel::fresnel::exact::reflect;
use spectrel::spectrum::Library;
use std::collections::BTreeSet;
use std::path::Path;

const HEADER: &str = "material,model,lane,cos_theta,theta_deg,Rs,Rp,R";

/// What the command says.
fn said(args: &[&str]) -> String {
    let folder = folder(&[]);
    let output = run(folder.path(), &[&["fresnel", "curve"], args].concat());
    String::from_utf8(output.stdout).expect("text")
}

fn rows(args: &[&str]) -> Vec<Vec<String>> {
    let text = said(args);
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some(HEADER));
    lines.map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn number(text: &str) -> f64 {
    text.parse().expect("a number")
}

/// n and k of the library at a wavelength.
fn index(data: &str, nm: f64) -> (f64, f64) {
    Library::default().ior(data, Path::new("")).expect("built in").at(nm)
}

/// Unpolarised reflectance by the textbook: Fresnel's amplitudes in complex numbers, which the library never forms.
fn textbook(n1: f64, n: f64, k: f64, cos: f64) -> [f64; 3] {
    let (sin2, n_squared) = (n1 * n1 * (1.0 - cos * cos), (n * n - k * k, 2.0 * n * k));
    // w = N cos θ_t = √(N² − n1² sin²θ).
    let (re, im) = (n_squared.0 - sin2, n_squared.1);
    let size = re.hypot(im);
    let w = (((size + re) / 2.0).max(0.0).sqrt(), ((size - re) / 2.0).max(0.0).sqrt());
    let ratio = |a: (f64, f64), b: (f64, f64)| (a.0 * a.0 + a.1 * a.1) / (b.0 * b.0 + b.1 * b.1);
    let c = n1 * cos;
    let rs = ratio((c - w.0, -w.1), (c + w.0, w.1));
    // N² cos θ ∓ n1 w.
    let (a, b) = ((n_squared.0 * cos, n_squared.1 * cos), (n1 * w.0, n1 * w.1));
    let rp = ratio((a.0 - b.0, a.1 - b.1), (a.0 + b.0, a.1 + b.1));
    [rs, rp, (rs + rp) / 2.0]
}

#[test]
fn exact_curves_are_what_the_textbook_says() {
    for (material, data, n1) in [("gold", "Au/olmon-2012-evaporated", None), ("diamond", "C/peter-1923", Some("water"))]
    {
        let mut args = vec![material, "--wavelengths", "420-700:70", "--angles", "0-90:7.5"];
        args.extend(n1.iter().flat_map(|medium| ["--outside", medium]));
        let rows = rows(&args);
        assert_eq!(rows.len(), 5 * 13);
        for row in &rows {
            assert_eq!((row[0].as_str(), row[1].as_str()), (material, "exact"));
            let nm = number(&row[2]);
            let (n, k) = index(data, nm);
            let outside = n1.map_or(1.0, |_| {
                spectrel::scene::optics("water", None, &Library::default()).expect("water").ior.at(nm).0
            });
            let (cos, theta) = (number(&row[3]), number(&row[4]));
            assert!((cos - theta.to_radians().cos()).abs() < 1e-15 && (theta == 90.0) == (cos == 0.0));
            for (field, expected) in row[5..].iter().zip(textbook(outside, n, k, cos)) {
                assert!((number(field) - expected).abs() < 1e-13, "{row:?}: {expected}");
            }
        }
    }
}

#[test]
fn numbers_read_back_to_the_last_digit() {
    for row in rows(&["gold", "--wavelengths", "550", "--cosines", "0-1:0.01"]) {
        let (n, k) = index("Au/olmon-2012-evaporated", 550.0);
        let exact = reflect(1.0, n, k, number(&row[3]));
        assert_eq!([number(&row[5]), number(&row[6]), number(&row[7])], [exact.rs, exact.rp, exact.r]);
        assert!(row[3].len() <= 4, "cosines are as asked: {}", row[3]);
    }
}

#[test]
fn colours_run_from_f0_to_white() {
    let rows = rows(&["gold", "--space", "srgb", "--angles", "0,90", "--models", "exact,schlick-rgb"]);
    let lanes: Vec<_> = rows.iter().map(|row| (row[1].as_str(), row[2].as_str(), row[4].as_str())).collect();
    assert_eq!(lanes[..3], [("exact", "r", "0"), ("exact", "r", "90"), ("exact", "g", "0")]);
    // Gold after Olmon 2012, worked out apart from this program.
    for model in ["exact", "schlick-rgb"] {
        for (lane, f0) in [("r", 1.0428), ("g", 0.7738), ("b", 0.3347)] {
            let of = |theta: &str| {
                rows.iter().find(|row| row[1] == model && row[2] == lane && row[4] == theta).expect("a row")
            };
            assert!((number(&of("0")[7]) - f0).abs() < 1e-4 && (number(&of("90")[7]) - 1.0).abs() < 1e-6);
            assert_eq!(of("0")[5].is_empty(), model != "exact", "only the exact model knows polarisation");
        }
    }
}

/// From the denser side the two forms of Schlick part, and nothing is lost beyond the critical angle.
#[test]
fn light_from_the_inside() {
    let args = ["diamond", "--from", "inside", "--wavelengths", "550", "--angles", "0-90:0.5"];
    let models = "exact,schlick,schlick-incident,schlick-transmitted,cook-torrance";
    let rows = rows(&[&args[..], &["--models", models]].concat());
    let n = index("C/peter-1923", 550.0).0;
    let critical = (1.0 / n).asin().to_degrees();
    let mut largest = std::collections::BTreeMap::new();
    for row in &rows {
        let theta = number(&row[4]);
        let exact = reflect(n, 1.0, 0.0, number(&row[3])).r;
        if theta > critical {
            assert!((number(&row[7]) - 1.0).abs() < 1e-12, "{row:?}");
        } else {
            let error: &mut f64 = largest.entry(row[1].as_str()).or_default();
            *error = error.max((number(&row[7]) - exact).abs());
        }
    }
    println!("largest error short of {critical:.2}°: {largest:?}");
    assert!(largest["exact"] == 0.0 && largest["cook-torrance"] < 1e-4);
    assert_eq!(largest["schlick"], largest["schlick-transmitted"]);
    assert!(largest["schlick-incident"] > 3.0 * largest["schlick-transmitted"]);
}

#[test]
fn over_wavelength_one_curve_is_one_angle() {
    let rows = rows(&["silver", "--over", "wavelength", "--angles", "0,60"]);
    assert_eq!(rows.len(), 2 * 81);
    assert!(rows[..81].iter().all(|row| row[4] == "0") && rows[81..].iter().all(|row| row[4] == "60"));
    assert_eq!((rows[0][2].as_str(), rows[80][2].as_str()), ("380", "780"));
}

#[test]
fn all_is_what_applies() {
    let models = |args: &[&str]| {
        let output =
            run(folder(&[]).path(), &[&["fresnel", "curve", "--models", "all", "--angles", "0"], args].concat());
        let text = String::from_utf8(output.stdout).expect("text");
        let names: BTreeSet<_> =
            text.lines().skip(1).map(|line| line.split(',').nth(1).expect("a model").to_owned()).collect();
        (names, String::from_utf8(output.stderr).expect("text"))
    };
    let (at_wavelengths, note) = models(&["gold"]);
    assert_eq!(at_wavelengths, ["constant", "exact", "f82-spectral", "schlick"].map(str::to_owned).into());
    assert!(note.contains("left out for gold") && note.contains("cook-torrance") && note.contains("--space srgb"));
    let (colours, note) = models(&["gold", "--space", "srgb"]);
    assert!(colours.len() == 13 && note.contains("cook-torrance") && !note.contains("gulbrandsen"));
    let (clear, note) = models(&["diamond", "--space", "srgb"]);
    assert!(clear.len() == 16 && note.is_empty());
    let (inside, note) = models(&["diamond", "--space", "srgb", "--from", "inside"]);
    assert!(inside.len() == 7 && note.contains("gulbrandsen"));
}

#[test]
fn other_data_sets_are_other_curves() {
    let f0 = |args: &[&str]| number(&rows(&[&["--wavelengths", "500", "--angles", "0"], args].concat())[0][7]);
    let other = f0(&["gold", "--ior", "gold=Au/johnson-christy-1972"]);
    assert_eq!(other, f0(&["Au/johnson-christy-1972"]));
    assert!((other - f0(&["gold"])).abs() > 1e-3);
}

/// A material is asked once, whatever it is called, and a curve's points stand in order in a figure.
#[test]
fn names_and_orders_that_people_mix_up() {
    assert_eq!(rows(&["gold", "Au", "--angles", "0"]).len(), 3);
    let replaced = rows(&["gold", "--ior", "gold=Au/johnson-christy-1972", "--angles", "0"]);
    assert_eq!(rows(&["gold", "Au", "--ior", "Au=Au/johnson-christy-1972", "--angles", "0"]), replaced);
    let figure = |angles: &str| said(&["gold", "--wavelengths", "550", "--angles", angles, "--format", "svg"]);
    assert_eq!(figure("60,0,80,30"), figure("0,30,60,80"));
}

#[test]
fn json_says_what_csv_says() {
    let args = ["gold", "--models", "exact,schlick", "--wavelengths", "550", "--angles", "0,60"];
    let json: serde_json::Value =
        serde_json::from_str(&said(&[&args[..], &["--format", "json"]].concat())).expect("JSON");
    let rows = rows(&args);
    let objects = json.as_array().expect("an array");
    assert_eq!(objects.len(), rows.len());
    for (object, row) in objects.iter().zip(&rows) {
        assert_eq!(
            (object["material"].as_str(), object["model"].as_str()),
            (Some(row[0].as_str()), Some(row[1].as_str()))
        );
        for (key, field) in HEADER.split(',').zip(row).skip(2) {
            match field.is_empty() {
                true => assert!(object[key].is_null()),
                false => assert_eq!(object[key].as_f64(), Some(number(field)), "{key}"),
            }
        }
    }
}

#[test]
fn a_table_for_people_is_short() {
    let text = said(&["gold", "--wavelengths", "550", "--format", "md"]);
    assert_eq!(text.lines().count(), 2 + 10);
    // Cells are padded to columns.
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.starts_with("| Material | Model | Lane | θ (°) | Rs | Rp | R | | ---"), "{text}");
    assert!(text.contains("| gold | exact | 550 nm | 60 | 0.9198 | 0.7546 | 0.8372 |"), "{text}");
}

/// The file's name says the format; the figure is well-formed and has what it should.
#[test]
fn figures_have_their_curves_and_names() {
    let folder = folder(&[]);
    let figure = |args: &[&str]| {
        run(folder.path(), &[&["fresnel", "curve", "-o", "a.svg"], args].concat());
        std::fs::read_to_string(folder.path().join("a.svg")).expect("a file")
    };
    let one = figure(&["gold"]);
    assert!(one.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""));
    for text in
        ["Angle of incidence θ (°)", "Reflectance R (%)", "450 nm", "s-polarised", "p-polarised", ">90<", ">100<"]
    {
        assert!(one.contains(text), "{text}");
    }
    assert_eq!(one.matches("<polyline").count(), 3 * 3 + 6, "curves and legend");
    let compared = figure(&["gold", "aluminium", "--space", "srgb", "--models", "exact,schlick-rgb,f82"]);
    assert_eq!(compared.matches("<polyline").count(), 2 * 3 * 3 + 3);
    assert!(compared.contains("aluminium, blue") && compared.contains("schlick-rgb"));
    let spectra = figure(&["gold", "--over", "wavelength"]);
    assert!(spectra.contains("Wavelength λ (nm)") && spectra.contains("gold, 0°"));
    assert_eq!(spectra.matches("<polyline").count(), 1);
}

#[test]
fn what_cannot_be_drawn_or_asked_is_told() {
    let folder = folder(&[]);
    for (args, says) in [
        (&["gould"][..], &["`gould`", "did you mean `gold`?"][..]),
        (&["gold", "--models", "exact,schlik"], &["`schlik`", "did you mean `schlick`?", "gulbrandsen"]),
        (&["gold", "--models", "exact,cook-torrance"], &["`cook-torrance`", "`gold`", "dielectrics"]),
        (&["gold", "--models", "f82"], &["`f82`", "no wavelengths", "--space srgb"]),
        (&["diamond", "--models", "f82", "--space", "srgb", "--from", "inside"], &["`f82`", "`diamond`", "denser"]),
        (&["gold", "--from", "inside"], &["`gold`", "conductor"]),
        (&["gold", "--outside", "silver"], &["--outside silver", "conductor"]),
        (&["gold", "--outside", "watr"], &["did you mean `water`?"]),
        (&["gold", "--ior", "gold=Au/jonson"], &["did you mean `Au/johnson-christy-1972`?"]),
        (&["gold", "--ior", "silver=Ag/yang-2015"], &["`silver`", "not among", "gold"]),
        (&["gold", "--ior", "gold"], &["MATERIAL=DATASET"]),
        (&["gold", "--ior", "gold=Au/rakic-1998-bb", "--ior", "Au=Au/rakic-1998-ld"], &["`gold` twice"]),
        (&["gold", "-o", "a.png"], &["no `.png` file", ".svg"]),
        (&["gold", "--wavelengths", "380-780"], &["needs a step"]),
        (&["gold", "--angles", "0-100:10"], &["100 is not within 0 … 90"]),
        (&["gold", "--space", "srgb", "--over", "wavelength"], &["--space srgb"]),
        (&["gold", "--wavelengths", "400-700:5", "--models", "exact,schlick", "--format", "svg"], &["61 panels"]),
        (&["colorchecker-red"], &["no index of refraction"]),
        (&["gold", "-o", "none/a.svg"], &["none"]),
    ] {
        let stderr = refused(folder.path(), &[&["fresnel", "curve"], args].concat());
        assert!(says.iter().all(|words| stderr.contains(words)), "{args:?}: {stderr}");
    }
    assert!(std::fs::read_dir(folder.path()).expect("readable").next().is_none(), "nothing is left behind");
}

#[test]
fn beyond_the_data_there_is_a_warning() {
    let output = run(folder(&[]).path(), &["fresnel", "curve", "gold", "--wavelengths", "250,550", "--angles", "0"]);
    let stderr = String::from_utf8(output.stderr).expect("text");
    assert!(stderr.contains("Au/olmon-2012-evaporated") && stderr.contains("covers 300–"), "{stderr}");
}
