//! `spectrel f0` in every format, with its options and what it refuses.

use crate::common::command::{folder, refused, run};
use serde_json::Value;

fn said(args: &[&str]) -> String {
    let output = run(folder(&[]).path(), &[&["f0"], args].concat());
    String::from_utf8(output.stdout).expect("text")
}

fn json(args: &[&str]) -> Value {
    serde_json::from_str(&said(&[args, &["--format", "json"]].concat())).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

#[test]
fn json_has_the_keys_that_programs_read() {
    let table = json(&["gold", "diamond"]);
    for (key, value) in [("illuminant", "D65"), ("observer", "1931-2"), ("space", "srgb"), ("adapt", "bradford")] {
        assert_eq!(table[key], value);
    }
    let [gold, diamond] = [&table["materials"][0], &table["materials"][1]];
    assert_eq!((&gold["name"], &gold["ior"]), (&"gold".into(), &"Au/olmon-2012-evaporated".into()));
    assert_eq!((&gold["class"], &diamond["class"]), (&"conductor".into(), &"dielectric".into()));
    for color in ["f0", "f82", "f_mu17", "f_avg"] {
        for row in [gold, diamond] {
            assert!(row[color]["hex"].as_str().is_some_and(|hex| hex.len() == 7 && hex.starts_with('#')));
            assert!(row[color]["in_gamut"].is_boolean());
            assert!(["linear", "encoded"].iter().all(|kind| row[color][kind].as_array().is_some_and(|c| c.len() == 3)));
        }
    }
    assert_eq!(gold["source"]["doi"], "10.1103/PhysRevB.86.235147");
    assert_eq!(gold["source"]["year"], 2012);
    assert!(gold["source"]["title"].as_str().is_some_and(|title| title.contains("gold")));
    assert!(gold["luminance"].is_number() && gold["n_d"].is_number() && gold["k_d"].is_number());
}

#[test]
fn engines_get_what_they_define() {
    let table = json(&["gold", "diamond", "water"]);
    let [gold, diamond, water] = [0, 1, 2].map(|i| &table["materials"][i]);
    let f0 = &gold["f0"]["linear"];
    let engines = &gold["engines"];
    assert_eq!(engines["gltf"]["baseColorFactor"], serde_json::json!([1.0, f0[1], f0[2], 1.0]));
    assert_eq!(engines["unreal"]["BaseColor"], serde_json::json!([1.0, f0[1], f0[2]]));
    assert_eq!(engines["filament"]["baseColor"], engines["disney"]["baseColor"]);
    assert_eq!(number(&engines["openpbr"]["base_metalness"]), 1.0);
    // Schlick with the tint at c = 1/7 gives the colour there, where nothing was clipped.
    let (base, tint) = (number(&f0[2]), number(&engines["openpbr"]["specular_color"][2]));
    let schlick = base + (1.0 - base) * (6.0_f64 / 7.0).powi(5);
    assert!((tint * schlick - number(&gold["f_mu17"]["linear"][2])).abs() < 1e-9);
    assert!(engines["unreal"]["Specular"].is_null() && diamond["engines"]["unreal"]["BaseColor"].is_null());
    let y = number(&water["luminance"]);
    assert!((number(&water["engines"]["unreal"]["Specular"]) - y / 0.08).abs() < 1e-12);
    assert!((number(&water["engines"]["filament"]["reflectance"]) - (y / 0.16).sqrt()).abs() < 1e-12);
    assert_eq!(water["engines"]["openpbr"]["specular_ior"], water["n_d"]);
    // Beyond what the engines take: said without the limit, clipped with it.
    assert!(number(&diamond["specular"]["level"]) > 2.0 && number(&diamond["specular"]["reflectance"]) > 1.0);
    assert_eq!(number(&diamond["engines"]["unreal"]["Specular"]), 1.0);
    assert_eq!(number(&diamond["engines"]["filament"]["reflectance"]), 1.0);
}

#[test]
fn gltf_is_rec709_in_every_space() {
    let [srgb, acescg] = [json(&["copper"]), json(&["copper", "--space", "acescg"])];
    let factor = |table: &Value, i: usize| number(&table["materials"][0]["engines"]["gltf"]["baseColorFactor"][i]);
    assert!((0..4).all(|i| (factor(&srgb, i) - factor(&acescg, i)).abs() < 1e-9));
    let copper = &acescg["materials"][0]["f0"];
    assert!(copper["hex"].is_null() && copper["linear"] == copper["encoded"]);
    let rec2020 = json(&["iron", "--space", "rec2020"]);
    let iron = &rec2020["materials"][0]["f0"];
    // ITU-R BT.2020, table 4, 12 bits.
    let expected = 1.0993 * number(&iron["linear"][0]).powf(0.45) - 0.0993;
    assert!((number(&iron["encoded"][0]) - expected).abs() < 1e-12 && iron["hex"].is_null());
}

#[test]
fn all_data_sets_are_rows_with_their_spread() {
    let table = json(&["copper", "--all-data-sets"]);
    let sets: Vec<_> = table["materials"].as_array().expect("rows").iter().map(|row| &row["ior"]).collect();
    assert!(sets.len() >= 7 && sets[0] == "Cu/mcpeak-2015" && sets.iter().any(|set| *set == "Cu/johnson-christy-1972"));
    let spread = &table["spread"][0];
    let distances = spread["sets"].as_array().expect("sets");
    assert_eq!(distances.len() + 1, sets.len());
    let largest = distances.iter().map(|set| number(&set["delta_e"])).fold(0.0, f64::max);
    assert!(number(&spread["widest"]["delta_e"]) >= largest);
    let mean = distances.iter().map(|set| number(&set["delta_e"])).sum::<f64>() / distances.len() as f64;
    assert!((number(&spread["mean_to_primary"]) - mean).abs() < 1e-12);
    // The choice of set moves copper by up to ΔE 12 or so.
    assert!((8.0..20.0).contains(&number(&spread["widest"]["delta_e"])), "{spread}");
    let yag = json(&["yag", "--all-data-sets"]);
    // A set that begins at 400 nm is told, and not counted.
    assert_eq!(yag["materials"][1]["source"]["range_nm"][0], 400.0);
    assert_eq!(
        (&yag["spread"][0]["sets"][0]["counted"], &yag["spread"][0]["mean_to_primary"]),
        (&false.into(), &Value::Null)
    );
    assert!(
        said(&["yag", "--all-data-sets"]).contains("not counted, as it ends inside the visible: Y3Al5O12/zelmon-1998")
    );
}

#[test]
fn another_data_set_takes_its_place() {
    let replaced = json(&["Au", "--ior", "gold=Au/johnson-christy-1972"]);
    let row = &replaced["materials"][0];
    assert_eq!((&row["name"], &row["ior"]), (&"gold".into(), &"Au/johnson-christy-1972".into()));
    let own = json(&["Au/johnson-christy-1972"]);
    assert_eq!(own["materials"][0]["f0"], row["f0"]);
    let refusal = refused(folder(&[]).path(), &["f0", "iron", "--ior", "gold=Au/johnson-christy-1972"]);
    assert!(refusal.contains("`gold` is not among the materials (iron)"), "{refusal}");
}

#[test]
fn a_folder_of_ones_own_counts() {
    let files = [
        ("lib/materials/odd.toml", "description = \"odd\"\n[conductor]\nior = \"Odd/nobody-2026\"\n"),
        (
            "lib/spectra/ior/Odd/nobody-2026.toml",
            "quantity = \"ior\"\n[source]\ntitle = 'A <b>, \"quoted\" | title'\nauthors = \"N. O'Body & Co\"\nyear = 2026\n\
             licence = \"x\"\norigin = \"x\"\n[sample]\ndescription = \"x\"\nconfidence = \"low\"\n\
             [table]\nwavelength_nm = [400.0, 700.0]\nn = [1.0, 1.0]\nk = [2.0, 2.0]\n",
        ),
    ];
    let folder = folder(&files);
    let say = |format: &str| {
        let output = run(folder.path(), &["f0", "odd", "--library", "lib", "--format", format]);
        String::from_utf8(output.stdout).expect("text")
    };
    let table: Value = serde_json::from_str(&say("json")).expect("JSON");
    // n = 1, k = 2: F0 = k²/(4 + k²) = 1/2 at every wavelength.
    assert!((number(&table["materials"][0]["f0"]["linear"][1]) - 0.5).abs() < 1e-12);
    assert_eq!(table["materials"][0]["source"]["covers_visible"], false);
    assert!(say("table").contains("Odd/nobody-2026 † ‡"));
    let html = say("html");
    assert!(html.contains("A &lt;b&gt;, &quot;quoted&quot; | title") && html.contains("N. O&#39;Body &amp; Co"));
    assert!(!html.contains("<b>") && !html.contains("src=") && !html.contains("@import"));
    assert!(html.contains("covers 400–700 nm only"));
    let mut csv = csv::Reader::from_reader(say("csv").into_bytes().leak() as &[u8]);
    let place = csv.headers().expect("a head").iter().position(|name| name == "source_title").expect("the title");
    assert_eq!(&csv.records().next().expect("a row").expect("a row")[place], "A <b>, \"quoted\" | title");
    let toml: toml::Table = say("toml").parse().expect("TOML");
    assert_eq!(toml["materials"][0]["source"]["authors"].as_str(), Some("N. O'Body & Co"));
    assert!(say("md").contains("| odd "));
}

#[test]
fn csv_and_toml_say_what_json_says() {
    let table = json(&["--all"]);
    let text = said(&["--all", "--format", "csv"]);
    let mut csv = csv::Reader::from_reader(text.as_bytes());
    let headers = csv.headers().expect("a head").clone();
    let rows: Vec<_> = csv.records().map(|row| row.expect("a row")).collect();
    let materials = table["materials"].as_array().expect("rows");
    assert_eq!(rows.len(), materials.len());
    let cell = |row: &csv::StringRecord, name: &str| -> String {
        row[headers.iter().position(|header| header == name).expect("the column")].to_owned()
    };
    for (row, material) in rows.iter().zip(materials) {
        assert_eq!(cell(row, "name"), material["name"].as_str().expect("a name"));
        for (i, channel) in ["r", "g", "b"].iter().enumerate() {
            for color in ["f0", "f82", "f_mu17", "f_avg"] {
                let value: f64 = cell(row, &format!("{color}_{channel}")).parse().expect("a number");
                assert!((value - number(&material[color]["linear"][i])).abs() < 1e-8);
            }
        }
        assert_eq!(cell(row, "f0_in_gamut"), material["f0"]["in_gamut"].to_string());
    }
    let toml: toml::Table = said(&["--all", "--format", "toml"]).parse().expect("TOML");
    let toml = toml["materials"].as_array().expect("rows");
    assert_eq!(toml.len(), materials.len());
    for (a, b) in toml.iter().zip(materials) {
        let [a, b] = [a["f0"]["linear"][0].as_float(), b["f0"]["linear"][0].as_f64()].map(|x| x.expect("a number"));
        assert!((a - b).abs() < 1e-12);
    }
    let cells = rows.iter().flat_map(csv::StringRecord::iter);
    assert!(cells.filter_map(|cell| cell.parse::<f64>().ok()).all(f64::is_finite));
}

#[test]
fn names_and_options_that_are_none_are_refused_with_what_is_near() {
    let refusal = |args: &[&str]| refused(folder(&[]).path(), &[&["f0"], args].concat());
    assert!(refusal(&["gould"]).contains("did you mean `gold`"));
    assert!(refusal(&["--illuminant", "D66"]).contains("did you mean `d65`"));
    assert!(refusal(&["--observer", "1931"]).contains("did you mean `1931-2`"));
    assert!(refusal(&["--space", "adobe"]).contains("srgb, display-p3, rec2020, acescg"));
    assert!(refusal(&["--adapt", "bradfrod"]).contains("did you mean `bradford`"));
    assert!(refusal(&["--ior", "gold"]).contains("MATERIAL=DATASET"));
    assert!(refusal(&["gold", "--ior", "gold=Au/jonson-christy-1972"]).contains("Au/johnson-christy-1972"));
    assert!(refusal(&["gold", "--all"]).contains("cannot be used with"));
    assert!(refusal(&["--match", "#ffd891", "--all"]).contains("cannot be used with"));
    assert!(refusal(&["colorchecker-red"]).contains("no index of refraction"));
}

#[test]
fn the_choice_of_a_data_set_has_its_reason() {
    let why = "thick evaporated film, 10 nm steps with error bars";
    let sets = json(&["gold", "--all-data-sets"]);
    for row in sets["materials"].as_array().expect("rows") {
        let reason = row["source"]["why"].as_str();
        assert_eq!(
            reason.is_some_and(|reason| reason.starts_with(why)),
            row["ior"] == "Au/olmon-2012-evaporated",
            "{row}"
        );
    }
    assert!(said(&["gold"]).contains(&format!("gold: why Au/olmon-2012-evaporated: {why}")));
    assert!(said(&["gold", "--format", "html"]).contains(&format!("Chosen because: {why}")));
}

#[test]
fn materials_are_written_as_files_to_load() {
    let engines = |name: &str| json(&[name])["materials"][0]["engines"].clone();
    let (gold, water) = (engines("gold"), engines("water"));
    let text = said(&["gold", "water", "--format", "gltf"]);
    let asset: Value = serde_json::from_str(&text).expect("JSON");
    let [metal, clear] = [&asset["materials"][0], &asset["materials"][1]];
    assert_eq!(metal["pbrMetallicRoughness"]["baseColorFactor"], gold["gltf"]["baseColorFactor"]);
    assert_eq!(metal["pbrMetallicRoughness"]["metallicFactor"], 1.0);
    assert_eq!(clear["extensions"]["KHR_materials_ior"]["ior"], water["gltf"]["ior"]);
    assert_eq!(asset["nodes"][1]["name"], "water");
    // Whatever reads glTF finds two closed spheres: our own reader does.
    let scene = "meters_per_unit = 1\n[camera]\nposition = [1, -9, 3]\nlook_at = [1, 0, 0]\nfov = 40\n\
        [environment.constant]\nspectrum = \"D65\"\nluminance = 100\n\
        [[objects]]\nmaterial = \"gold\"\nshape.mesh = { file = \"two.gltf\" }\n";
    let folder = folder(&[("two.gltf", &text), ("scene.toml", scene)]);
    let inspected = String::from_utf8(run(folder.path(), &["inspect", "scene.toml"]).stdout).expect("text");
    assert_eq!(inspected.matches("closed mesh of 2208 triangles").count(), 2, "{inspected}");

    let document = said(&["gold", "water", "--format", "mtlx"]);
    let xml = roxmltree::Document::parse(&document).expect("XML");
    assert_eq!(xml.root_element().attribute("colorspace"), Some("lin_rec709"));
    let input = |surface: &str, name: &str| {
        let node = xml.descendants().find(|node| node.attribute("name") == Some(surface)).expect("a surface");
        assert_eq!(node.tag_name().name(), "open_pbr_surface");
        let input = node.children().find(|input| input.attribute("name") == Some(name)).expect("an input");
        let value = input.attribute("value").expect("a value");
        value.split(", ").map(|number| number.parse().expect("a number")).collect::<Vec<f64>>()
    };
    for name in ["base_color", "specular_color"] {
        let expected: Vec<f64> = gold["openpbr"][name].as_array().expect("a colour").iter().map(number).collect();
        assert_eq!(input("gold_surface", name), expected);
    }
    assert_eq!(input("water_surface", "specular_ior"), [number(&water["openpbr"]["specular_ior"])]);
    let refusal = refused(folder.path(), &["f0", "--match", "#ffd891", "--format", "mtlx"]);
    assert!(refusal.contains("only tables of materials"), "{refusal}");
}
