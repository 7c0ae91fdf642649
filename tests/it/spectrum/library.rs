//! The built-in library as a whole: every file reads, is sound, and is found by its names.

use std::collections::HashMap;
use std::path::Path;
use std::time::Instant;

use spectrel::spectrum::{About, Confidence, Library, Observer, Quantity, Spectrum, SpectrumError};

fn library() -> Library {
    Library::new(Vec::new())
}

fn here() -> &'static Path {
    Path::new("")
}

/// The tables of a spectrum rise in wavelength and lie within the bounds; formulas do so over the visible range.
fn check(name: &str, spectrum: &Spectrum, low: f64, high: f64) {
    let in_bounds = |value: f64| value.is_finite() && (low..=high).contains(&value);
    match spectrum {
        Spectrum::Table(table) => {
            assert!(table.wavelengths_nm().windows(2).all(|pair| pair[0] < pair[1]), "{name}");
            assert!(table.values().iter().all(|&value| in_bounds(value)), "{name}");
        }
        _ => assert!((360..=830).all(|nm| in_bounds(spectrum.at(f64::from(nm)))), "{name}"),
    }
}

fn check_about(name: &str, about: &About) {
    assert_eq!(about.name, name);
    let source = &about.source;
    for text in [&source.title, &source.authors, &source.licence, &source.origin, &about.sample.description] {
        assert!(!text.trim().is_empty(), "{name}");
    }
    assert_ne!(about.confidence(), Confidence::Unstated, "{name}");
    if let Some(year) = source.year {
        assert!((1800..2030).contains(&year), "{name}");
    }
    if let Some(doi) = &source.doi {
        assert!(doi.starts_with("10."), "{name}: {doi}");
    }
}

#[test]
fn every_index_reads() {
    let library = library();
    let names = library.names(Quantity::Ior);
    assert!(names.len() > 100, "{}", names.len());
    for name in &names {
        let ior = library.ior(name, here()).unwrap_or_else(|error| panic!("{error}"));
        check_about(name, &ior.about);
        check(name, &ior.n, 1e-3, 100.0);
        check(name, &ior.k, 0.0, 200.0);
        let (low, high) = ior.about.range_nm.expect(name);
        assert!(low < high && low < 600.0 && high > 500.0, "{name}: {low}…{high} nm");
    }
}

#[test]
fn every_curve_and_observer_reads() {
    let library = library();
    for name in library.names(Quantity::Reflectance) {
        let data = library.reflectance(&name, here()).unwrap_or_else(|error| panic!("{error}"));
        check_about(&name, &data.about);
        check(&name, &data.spectrum, 0.0, 1.0);
    }
    for name in library.names(Quantity::Absorption) {
        let data = library.absorption(&name, here()).unwrap_or_else(|error| panic!("{error}"));
        check_about(&name, &data.about);
        check(&name, &data.spectrum, 0.0, 1e9);
    }
    for name in library.names(Quantity::Illuminant) {
        let data = library.illuminant(&name, here()).unwrap_or_else(|error| panic!("{error}"));
        check_about(&name, &data.about);
        check(&name, &data.spectrum, 0.0, 1e6);
    }
    assert_eq!(library.names(Quantity::Observer).len(), Observer::ALL.len());
    for observer in Observer::ALL {
        let matching = library.observer(observer).unwrap_or_else(|error| panic!("{error}"));
        check_about(observer.name(), &matching.about);
        let sums = [&matching.x, &matching.y, &matching.z].map(|table| table.values().iter().sum::<f64>());
        // The functions are made so that equal energy is white.
        assert!(sums.iter().all(|sum| (sum / sums[1] - 1.0).abs() < 2e-3), "{observer:?}: {sums:?}");
    }
}

#[test]
fn every_material_refers_to_data_that_exist() {
    let library = library();
    let mut aliases: HashMap<String, String> = HashMap::new();
    for name in library.material_names() {
        let material = library.material(&name).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(material.name, name);
        let table: toml::Table = toml::from_str(&material.text).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(table.get("description").and_then(toml::Value::as_str).is_some_and(|text| !text.is_empty()), "{name}");
        let own = table.get("aliases").and_then(toml::Value::as_array).cloned().unwrap_or_default();
        let names = own.iter().filter_map(|alias| alias.as_str()).chain([name.as_str()]);
        for alias in names {
            let other = aliases.insert(alias.to_lowercase(), name.clone());
            assert!(other.is_none_or(|other| other == name), "`{alias}` names two materials, one is {name}");
        }
        references(&library, &name, &table);
    }
    assert!(library.material_names().len() > 90);
}

fn references(library: &Library, material: &str, table: &toml::Table) {
    for (key, value) in table {
        let found = match (key.as_str(), value) {
            (_, toml::Value::Table(inner)) => {
                references(library, material, inner);
                Ok(())
            }
            ("ior", toml::Value::String(name)) => library.ior(name, here()).map(drop),
            ("absorption", toml::Value::String(name)) => library.absorption(name, here()).map(drop),
            ("reflectance", toml::Value::String(name)) => library.reflectance(name, here()).map(drop),
            _ => Ok(()),
        };
        found.unwrap_or_else(|error| panic!("{material}: {error}"));
    }
}

#[test]
fn the_selected_materials_are_there() {
    let library = library();
    let text = include_str!("../../data/ior_selection.csv");
    let names: Vec<_> = text.lines().skip(2).filter_map(|line| line.split(',').next()).collect();
    assert_eq!(names.len(), 91);
    for name in names {
        library.material(name).unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn names_do_not_mind_case_and_suggest_the_nearest() {
    let library = library();
    let d65 = library.illuminant("D65", here()).unwrap();
    assert!(std::sync::Arc::ptr_eq(&library.illuminant("D65", here()).unwrap(), &d65));
    assert_eq!(library.illuminant("d65", here()).unwrap().about.name, "d65");
    assert_eq!(library.ior("au/Olmon-2012-Evaporated", here()).unwrap().about.name, "Au/olmon-2012-evaporated");
    assert_eq!(library.material("Gold").unwrap().name, "gold");
    assert_eq!(library.material("au").unwrap().name, "gold");

    let error = library.ior("Au/olmon-2012-evaporatd", here()).unwrap_err();
    assert!(error.to_string().ends_with("did you mean `Au/olmon-2012-evaporated`?"), "{error}");
    let error = library.material("sliver").unwrap_err();
    assert!(matches!(&error, SpectrumError::UnknownMaterial { .. }));
    assert!(error.to_string().contains("did you mean `silver`?"), "{error}");
    let error = library.illuminant("nothing like it at all", here()).unwrap_err();
    assert_eq!(error.to_string(), "no illuminant data set is called `nothing like it at all`");
}

#[test]
fn published_indices_come_out() {
    let library = library();
    let n = |name: &str, nm: f64| library.ior(name, here()).unwrap().n.at(nm);
    assert!((n("SCHOTT/n-bk7", 587.5618) - 1.5168).abs() < 1e-5);
    assert!((n("C/peter-1923", 587.5618) - 2.4175).abs() < 2e-4);
    // Malitson 1962, ordinary ray at the sodium line.
    assert!((n("Al2O3/malitson-dodge-1972-o", 589.29) - 1.7682).abs() < 1e-3);
}

#[test]
fn users_come_first_and_files_are_beside_the_scene() {
    let dir = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = dir.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    write(
        "spectra/illuminant/d65.toml",
        "quantity = \"illuminant\"\n[source]\ntitle = \"t\"\nauthors = \"a\"\nlicence = \"l\"\norigin = \"o\"\n[sample]\ndescription = \"d\"\nconfidence = \"low\"\n[table]\nwavelength_nm = [500, 600]\nvalue = [1, 3]\n[[lines]]\nnm = 546.074\npower = 2\n",
    );
    write("materials/mine.toml", "description = \"mine\"\naliases = [\"my own\"]\n");
    write("materials/gold.toml", "description = \"other gold\"\n");
    write("gold.csv", "wavelength_nm,n,k\n400,1,2\n700,0.2,4\n");
    let library = Library::new(vec![dir.path().to_owned()]);
    let d65 = library.illuminant("D65", here()).unwrap();
    assert_eq!((d65.spectrum.at(550.0), d65.spectrum.lines().len()), (2.0, 1));
    assert_eq!(library.material("MY OWN").unwrap().name, "mine");
    let gold = library.material("gold").unwrap();
    assert!(gold.text.contains("other gold") && gold.base == dir.path().join("materials"));
    assert!(library.material_names().contains(&"mine".to_owned()));
    assert_eq!(library.ior("gold.csv", dir.path()).unwrap().at(400.0), (1.0, 2.0));
    assert!(matches!(library.ior("none.csv", dir.path()), Err(SpectrumError::Read { .. })));
}

#[test]
fn opening_reads_nothing() {
    let start = Instant::now();
    for _ in 0..1000 {
        std::hint::black_box(library());
    }
    assert!(start.elapsed().as_millis() < 100, "1000 openings took {:?}", start.elapsed());
}
