//! `spectrel f0 --check` and `--match`: what published tables turn out to be.

use crate::common::command::{folder, refused, run};
use serde_json::Value;

/// F0 tables that artists use, as printed.
const PUBLISHED: &str = include_str!("../../data/published_f0.csv");

fn json(table: &str, args: &[&str]) -> Value {
    let folder = folder(&[("table.csv", table)]);
    let output = run(folder.path(), &[&["f0", "--format", "json"], args].concat());
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn verdict(checked: &Value, table: &str, material: &str) -> Value {
    let rows = checked["rows"].as_array().expect("rows");
    let found = rows.iter().find(|row| row["table"] == table && row["material"] == material);
    found.expect("the row").clone()
}

#[test]
fn published_tables_are_seen_through() {
    let checked = json(PUBLISHED, &["--check", "table.csv"]);
    let outcome = |table: &str, material: &str| verdict(&checked, table, material)["outcome"].clone();
    assert_eq!(checked["rows"].as_array().expect("rows").len(), 18);
    // Linear values in a column that says sRGB.
    for metal in ["Silver", "Aluminum"] {
        let row = verdict(&checked, "filament", metal);
        assert_eq!(row["outcome"], "mis-encoded", "{row}");
        let distance = |reading: &str| row[reading]["delta_e"].as_f64().expect("a distance");
        assert!(distance("other_encoding") < 1.0 && distance("as_stated") > 2.0, "{row}");
    }
    let chromium = verdict(&checked, "unreal", "Chromium");
    assert_eq!(chromium["as_stated"]["ior"], "Cr/johnson-christy-1974");
    assert_eq!(chromium["outcome"], "match");
    assert!(
        chromium["as_stated"]["delta_e"].as_f64() < Some(0.1) && chromium["primary"]["delta_e"].as_f64() > Some(3.0)
    );
    for (table, metal) in [("unreal", "Titanium"), ("filament", "Copper"), ("filament", "Brass")] {
        assert_eq!(outcome(table, metal), "nothing", "{table} {metal}");
    }
    // What is in order is not accused.
    for (table, metal) in [("filament", "Iron"), ("filament", "Titanium"), ("filament", "Platinum")] {
        assert_ne!(outcome(table, metal), "mis-encoded", "{table} {metal}");
    }
    for metal in ["Silver", "Aluminum", "Gold", "Copper", "Nickel", "Platinum"] {
        assert_eq!(outcome("unreal", metal), "match", "{metal}");
    }
}

#[test]
fn a_table_made_from_ours_matches_in_either_encoding() {
    let material = json("", &["gold", "silver", "--space", "display-p3"]);
    let row = |i: usize, kind: &str, encoding: &str| {
        let values: Vec<_> = (0..3).map(|c| material["materials"][i]["f0"][kind][c].to_string()).collect();
        format!("{},{},{encoding}\n", ["Au", "SILVER"][i], values.join(","))
    };
    let table = ["Material,R,G,B,Encoding\n".into(), row(0, "linear", "Linear"), row(1, "encoded", "sRGB")].concat();
    let checked = json(&table, &["--check", "table.csv", "--space", "display-p3"]);
    for (row, set) in checked["rows"].as_array().expect("rows").iter().zip(["Au/olmon-2012-evaporated", "Ag/yang-2015"])
    {
        assert_eq!((&row["outcome"], &row["as_stated"]["ior"]), (&"match".into(), &set.into()));
        assert!(row["as_stated"]["delta_e"].as_f64() < Some(1e-6), "{row}");
    }
}

#[test]
fn a_colour_divided_by_its_red_is_recognised() {
    let material = json("", &["copper"]);
    let rgb: Vec<f64> =
        (0..3).filter_map(|channel| material["materials"][0]["f0"]["linear"][channel].as_f64()).collect();
    let table = format!("material,r,g,b,encoding\ncopper,1,{},{},linear\n", rgb[1] / rgb[0], rgb[2] / rgb[0]);
    let checked = json(&table, &["--check", "table.csv"]);
    assert_eq!(checked["rows"][0]["as_stated"]["fit"], "divided");
    assert_eq!(checked["rows"][0]["as_stated"]["ior"], "Cu/mcpeak-2015");
}

#[test]
fn an_unknown_material_is_told_and_the_rest_goes_on() {
    let rows = "Gould,1,0.8,0.3,linear\nGold,1,0.77,0.33,linear\nStainless Steel,0.67,0.64,0.6,linear\n";
    let table = format!("material,r,g,b,encoding\n{rows}");
    let checked = json(&table, &["--check", "table.csv"]);
    assert_eq!(checked["rows"][0]["outcome"], "unknown");
    assert!(checked["rows"][0]["says"].as_str().expect("words").contains("did you mean `gold`"));
    assert_eq!((&checked["rows"][1]["outcome"], &checked["rows"][2]["outcome"]), (&"match".into(), &"match".into()));
}

#[test]
fn an_encoding_that_is_not_stated_is_assumed_and_told() {
    let table = "name,r,g,b\ngold,1,0.7738,0.3347\n";
    let row = json(table, &["--check", "table.csv"])["rows"][0].clone();
    assert_eq!(
        (&row["outcome"], &row["encoding"], &row["encoding_assumed"]),
        (&"match".into(), &"linear".into(), &true.into())
    );
    let folder = folder(&[("table.csv", table)]);
    let output = run(folder.path(), &["f0", "--check", "table.csv"]);
    let says = String::from_utf8(output.stdout).expect("text");
    assert!(says.contains("No encoding is stated: the numbers are taken for linear"), "{says}");
}

#[test]
fn tables_that_are_none_are_refused() {
    let refusal = |table: &str| refused(folder(&[("t.csv", table)]).path(), &["f0", "--check", "t.csv"]);
    let columns = refusal("material,r,g\ngold,1,1\n");
    assert!(columns.contains("t.csv: the table has no column `b`"), "{columns}");
    assert!(refusal("material,r,g,b,encoding\n# x\ngold,1,one,1,linear\n").contains("t.csv:3: `g` is \"one\""));
    assert!(refusal("material,r,g,b,encoding\ngold,255,200,90,sRGB\n").contains("divided by 255"));
    assert!(refused(folder(&[]).path(), &["f0", "--check", "none.csv"]).contains("cannot read none.csv"));
    assert!(refused(folder(&[]).path(), &["f0", "--check", "t.csv", "--all"]).contains("cannot be used with"));
}

#[test]
fn a_colour_finds_its_metal() {
    let names = |args: &[&str]| -> Vec<String> {
        let found = json("", args);
        let metals = found["metals"].as_array().expect("metals").iter();
        metals.map(|metal| metal["name"].as_str().expect("a name").to_owned()).collect()
    };
    // The hex that the table prints for gold, and the linear colour.
    assert_eq!(names(&["--match", "#ffe49c"])[0], "gold");
    assert_eq!(names(&["--match", "1.0428,0.7738,0.3347"])[0], "gold");
    assert_eq!(names(&["--match", "#ffd8c6"])[0], "copper");
    let five = json("", &["--match", "#ffd891"]);
    let distances: Vec<f64> =
        five["metals"].as_array().expect("metals").iter().filter_map(|metal| metal["delta_e"].as_f64()).collect();
    assert!(distances.len() == 5 && distances.is_sorted(), "{five}");
    for metal in five["metals"].as_array().expect("metals").iter().filter(|metal| !metal["nearer"].is_null()) {
        assert!(metal["nearer"]["delta_e"].as_f64() < metal["delta_e"].as_f64(), "{metal}");
    }
    assert!(refused(folder(&[]).path(), &["f0", "--match", "goldish"]).contains("expected #rrggbb"));
}
