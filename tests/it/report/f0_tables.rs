//! `report::f0` and `spectrel f0` against an independent calculation of every material, and against the adaptive average.

use crate::common::command::{folder, run};
use serde_json::Value;
use spectrel::fresnel::{average, exact};
use spectrel::report::f0::{Conditions, Instrument, Row, Subject};
use spectrel::scene::{Class, optics};
use spectrel::spectrum::{Adaptation, Library, Observer, Quantity, RgbSpace};
use std::collections::BTreeMap;
use std::path::Path;

/// By tools/fixtures/f0_reference.py.
const REFERENCE: &str = include_str!("../../data/f0_reference.csv");
const TOLERANCE: f64 = 2e-5;

/// A row of the reference: the conditions, the material, and n, k, Y, F0, F82, F(1/7), F_avg.
struct Expected {
    conditions: [String; 4],
    name: String,
    numbers: Vec<f64>,
}

fn expected() -> Vec<Expected> {
    let lines = REFERENCE.lines().filter(|line| !line.starts_with('#')).skip(1);
    let rows: Vec<_> = lines
        .map(|line| {
            let fields: Vec<&str> = line.split(',').collect();
            Expected {
                conditions: std::array::from_fn(|i| fields[i].to_owned()),
                name: fields[4].to_owned(),
                numbers: fields[6..].iter().map(|number| number.parse().expect("a number")).collect(),
            }
        })
        .collect();
    assert!(rows.len() > 150 && rows.iter().all(|row| row.numbers.len() == 15));
    rows
}

fn instrument([illuminant, observer, space, adapt]: &[String; 4], library: &Library) -> Instrument {
    let observer = Observer::ALL.into_iter().find(|known| known.name().ends_with(observer.as_str()));
    let adaptation = Adaptation::ALL.into_iter().find(|known| known.name() == adapt);
    let conditions = Conditions {
        illuminant: illuminant.clone(),
        observer: observer.expect("an observer"),
        space: RgbSpace::from_name(space).expect("a space"),
        adaptation: adaptation.expect("an adaptation"),
    };
    Instrument::new(conditions, library).expect("a light")
}

fn row(name: &str, instrument: &Instrument, library: &Library) -> Row {
    let found = optics(name, None, library).expect("a material");
    let subject = Subject { name: found.name, conductor: found.class == Class::Conductor, ior: found.ior, why: None };
    Row::new(&subject, instrument)
}

fn largest_error(values: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(values.len(), expected.len());
    values.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn every_material_is_what_the_reference_says() {
    let library = Library::default();
    let mut worst = 0.0f64;
    let mut names = Vec::new();
    for Expected { conditions, name, numbers } in expected() {
        let row = row(&name, &instrument(&conditions, &library), &library);
        let colors = [&row.f0, &row.f82, &row.f_mu17, &row.f_avg].map(|color| color.linear);
        let values = [&[row.n_d, row.k_d, row.luminance][..], colors.as_flattened()].concat();
        let error = largest_error(&values, &numbers);
        assert!(error < TOLERANCE, "{name} under {conditions:?}: {values:?} against {numbers:?}");
        worst = worst.max(error);
        names.push(name);
    }
    println!("largest error {worst:.1e}");
    let indexed = library.material_names().into_iter().filter(|name| optics(name, None, &library).is_ok());
    assert!(indexed.into_iter().all(|name| names.contains(&name)), "a material is missing in the reference");
}

#[test]
fn the_command_says_the_same() {
    let mut groups: BTreeMap<[String; 4], Vec<Expected>> = BTreeMap::new();
    for row in expected() {
        groups.entry(row.conditions.clone()).or_default().push(row);
    }
    assert_eq!(groups.len(), 9);
    for (conditions, rows) in groups {
        let [illuminant, observer, space, adapt] = &conditions;
        let mut args = vec!["f0", "--format", "json", "--illuminant", illuminant, "--observer", observer];
        args.extend(["--space", space, "--adapt", adapt]);
        match rows.len() > 100 {
            true => args.push("--all"),
            false => args.extend(rows.iter().map(|row| row.name.as_str())),
        }
        let output = run(folder(&[]).path(), &args);
        let table: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        for (key, value) in ["illuminant", "observer", "space", "adapt"].iter().zip(&conditions) {
            assert_eq!(table[key], **value);
        }
        let materials = table["materials"].as_array().expect("a list");
        assert_eq!(materials.len(), rows.len());
        for expected in rows {
            let material = materials.iter().find(|material| material["name"] == *expected.name).expect("the material");
            let error = largest_error(&numbers(material), &expected.numbers);
            assert!(error < TOLERANCE, "{} under {conditions:?}: {material}", expected.name);
        }
    }
}

fn numbers(material: &Value) -> Vec<f64> {
    let scalars = ["n_d", "k_d", "luminance"].map(|key| material[key].clone());
    let colors = ["f0", "f82", "f_mu17", "f_avg"].map(|key| material[key]["linear"].clone());
    let channels = colors.iter().flat_map(|color| color.as_array().expect("three channels").clone());
    scalars.into_iter().chain(channels).map(|number| number.as_f64().expect("a number")).collect()
}

#[test]
fn known_colours_of_metals_and_diamond() {
    let library = Library::default();
    let instrument = Instrument::new(Conditions::default(), &library).expect("D65");
    // Silver's green is 0.983848.
    let known = [
        ("gold", [1.0428, 0.7738, 0.3347]),
        ("silver", [0.9876, 0.98385, 0.9721]),
        ("diamond", [0.1710, 0.1729, 0.1763]),
    ];
    for (name, rgb) in known {
        let row = row(name, &instrument, &library);
        assert!(largest_error(&row.f0.linear, &rgb) < 5e-5, "{name}: {:?}", row.f0);
    }
    let gold = row("gold", &instrument, &library);
    assert!(!gold.f0.in_gamut && gold.f0.hex.as_deref() == Some("#ffe49c") && gold.f0.linear[0] > 1.0);
}

#[test]
fn the_average_over_angles_is_that_of_the_adaptive_rule() {
    let library = Library::default();
    let instrument = Instrument::new(Conditions::default(), &library).expect("D65");
    let mut worst = [0.0f64; 2];
    for set in library.names(Quantity::Ior) {
        let ior = library.ior(&set, Path::new("")).expect("a data set");
        let adaptive = |nm: f64| {
            let (n, k) = ior.at(nm);
            average(|cos| exact::reflect(1.0, n, k, cos).r)
        };
        let expected = instrument.rgb(instrument.wavelengths_nm().map(adaptive));
        let row = Row::new(&Subject { name: set.clone(), conductor: true, ior: ior.clone(), why: None }, &instrument);
        let air = usize::from(set.starts_with("air/"));
        worst[air] = worst[air].max(largest_error(&row.f_avg.linear, &expected));
    }
    println!("largest error {:.1e}, of air {:.1e}", worst[0], worst[1]);
    assert!(worst[0] < 4e-10 && worst[1] < 4e-8, "{worst:?}");
}
