//! Bad input ends with exit code 2, one error in plain words at its line and column, and nothing written.
//!
//! Where an error is expected at a place, the scene holds the mark `§` right before it; it is removed before the run.

use spectrel::scene::{Overrides, Text, resolve};
use spectrel::spectrum::Library;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

const CAMERA: &str = "[camera]\nposition = [0, -10, 0]\nlook_at = [0, 0, 0]\nfov = 40\n";
const LIGHT: &str = "[environment.constant]\nspectrum = \"D50\"\nluminance = 100\n";
const SMALL: &str = "[render]\nwidth = 4\nheight = 3\nsamples = 1\n";
const SPHERE: &str = "[[objects]]\nmaterial = \"gold\"\nshape.sphere = { radius = 1 }\n";

/// A good scene with something more.
fn scene_with(more: &str) -> String {
    [SMALL, CAMERA, LIGHT, more].concat()
}

/// A scene of one gold object of this shape.
fn shape(shape: &str) -> String {
    scene_with(&format!("[[objects]]\nmaterial = \"gold\"\n{shape}\n"))
}

/// A scene that is lit by one sphere alone.
fn light(emission: &str) -> String {
    [SMALL, CAMERA, "[[objects]]\nshape.sphere = { radius = 1 }\n", emission, "\n"].concat()
}

/// A scene of one sphere of this material.
fn material(material: &str) -> String {
    scene_with(&format!("[[objects]]\nmaterial = \"m\"\nshape.sphere = {{ radius = 1 }}\n[materials.m.{material}\n"))
}

struct Outcome {
    code: Option<i32>,
    stderr: String,
    /// Files that the run left beside those that it was given.
    written: BTreeSet<String>,
}

/// Renders `scene.toml` in a folder of its own that also holds `files`.
fn render(scene: impl AsRef<[u8]>, files: &[(&str, &str)], args: &[&str]) -> Outcome {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("scene.toml"), scene).expect("a file");
    for (name, content) in files {
        fs::write(folder.path().join(name), content).expect("a file");
    }
    let before = names(folder.path());
    let outcome = spectrel(folder.path(), &[&["render", "scene.toml"], args].concat());
    Outcome { written: names(folder.path()).difference(&before).cloned().collect(), ..outcome }
}

fn spectrel(folder: &Path, args: &[&str]) -> Outcome {
    let mut command = Command::new(env!("CARGO_BIN_EXE_spectrel"));
    let output = command.current_dir(folder).args(args).output().expect("spectrel runs");
    let stderr = String::from_utf8(output.stderr).expect("text");
    assert!(!stderr.contains("panicked") && !stderr.contains("overflowed its stack"), "{stderr}");
    Outcome { code: output.status.code(), stderr, written: names(folder) }
}

fn names(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("a plain name")).collect()
}

fn assert_refused(outcome: &Outcome, says: &[&str]) {
    let Outcome { code, stderr, written } = outcome;
    assert_eq!(*code, Some(2), "{stderr}");
    assert!(written.is_empty(), "left {written:?}\n{stderr}");
    assert!(stderr.starts_with("error: "), "{stderr}");
    for words in says {
        assert!(stderr.contains(words), "{words:?} is not said in\n{stderr}");
    }
    for jargon in ["newtype", "variant", "f64", "u32", "struct ", "invalid type"] {
        assert!(!stderr.contains(jargon), "jargon {jargon:?} in\n{stderr}");
    }
}

/// The scene is refused at its mark with these words.
fn refused_at_mark(marked: &str, files: &[(&str, &str)], says: &[&str]) {
    let (before, _) = marked.split_once('§').expect("a mark");
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().expect("a line").chars().count() + 1;
    let outcome = render(marked.replace('§', ""), files, &["-q"]);
    assert_refused(&outcome, says);
    let place = format!("error: scene.toml:{line}:{column}: ");
    assert!(outcome.stderr.starts_with(&place), "expected {place}\n{}", outcome.stderr);
}

fn all_refused_at_mark(cases: &[(String, &[&str])]) {
    cases.iter().for_each(|(scene, says)| refused_at_mark(scene, &[], says));
}

#[test]
fn the_good_scene_is_good() {
    let outcome = render(scene_with(SPHERE), &[], &["-q"]);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (Some(0), ""));
    assert_eq!(outcome.written, BTreeSet::from(["scene.exr".into(), "scene.png".into()]));
}

#[test]
fn unknown_keys_and_names_come_with_the_nearest() {
    all_refused_at_mark(&[
        (format!("[render]\n§widht = 4\n{CAMERA}"), &["unknown key `widht`", "did you mean `width`?"]),
        (shape("shape.§shpere = { radius = 1 }"), &["did you mean `sphere`?"]),
        (shape("shape.sphere = { §radus = 1 }"), &["did you mean `radius`?"]),
        (material("§conducter]\nior = 1"), &["did you mean `conductor`?"]),
        (light("emission = { spectrum = { §blackbodi = 5000 } }"), &["did you mean `blackbody`?"]),
        (scene_with("[[objects]]\nmaterial = §\"glod\"\nshape.sphere = { radius = 1 }"), &["did you mean `gold`?"]),
        (material("conductor]\nior = §\"Au/olmon-2012-evaporate\""), &["`Au/olmon-2012-evaporated`"]),
        (material("dielectric]\nior = 1.5\nabsorption = §\"watr\""), &["did you mean `water`?"]),
        (light("emission = { spectrum = §\"led_b1\", luminance = 1 }"), &["did you mean `led-b1`?"]),
        (scene_with("[picture]\nwhite_balance = §\"D655\""), &["did you mean `d65`?"]),
        (scene_with("[picture]\nobserver = §\"cie-1931\""), &["did you mean `cie-1931-2`?"]),
        (scene_with("[picture]\ngamut = §\"clipp\""), &["did you mean `clip`?"]),
        (material("conductor]\nior = 1.5\nfresnel = §\"Schlik\""), &["did you mean `schlick`?"]),
    ]);
}

#[test]
fn a_material_of_the_scene_can_be_the_nearest() {
    let scene = "[[objects]]\nmaterial = §\"suade\"\nshape.sphere = { radius = 1 }\n[materials.suede.diffuse]\nreflectance = 0.1";
    refused_at_mark(&scene_with(scene), &[], &["this scene has a material `suede`"]);
}

#[test]
fn a_key_of_the_top_below_a_table_is_told_where_it_belongs() {
    refused_at_mark(&scene_with("§meters_per_unit = 0.001"), &[], &["top of the file"]);
}

#[test]
fn wrong_types_are_told_in_plain_words() {
    all_refused_at_mark(&[
        (format!("[render]\nwidth = §\"four\"\n{CAMERA}"), &["expected a whole number", "found the text \"four\""]),
        (format!("[render]\nwidth = §4.5\n{CAMERA}"), &["found 4.5"]),
        (format!("[render]\nwidth = §-4\n{CAMERA}"), &["found -4"]),
        (format!("[render]\nwidth = §4294967296\n{CAMERA}"), &["found 4294967296"]),
        (format!("[render]\nseed = §-1\n{CAMERA}"), &["not negative"]),
        (CAMERA.replace("40", "§\"wide\""), &["expected a number, found the text \"wide\""]),
        (CAMERA.replace("[0, 0, 0]", "§[0, 0]"), &["expected 3 numbers, found 2"]),
        (CAMERA.replace("[0, 0, 0]", "§[0, 0, 0, 1]"), &["expected 3 numbers, found 4"]),
        (CAMERA.replace("[0, 0, 0]", "[0, §\"x\", 0]"), &["found the text \"x\""]),
        (CAMERA.replace("[0, 0, 0]", "§0"), &["expected a list of 3 numbers, found 0"]),
        (shape("shape = §\"sphere\""), &["one kind of shape", "found the text \"sphere\""]),
        (shape("shape = §{}"), &["this table is empty"]),
        (
            shape("§shape.box = { size = [1, 1, 1] }\nshape.disk = { radius = 1 }"),
            &["one kind of shape", "beside another one"],
        ),
        (shape("transform = { scale = §\"big\" }\nshape.sphere = { radius = 1 }"), &["expected a factor"]),
        (light("emission = §5"), &["expected a table, found 5"]),
        (light("emission = { spectrum = §5, luminance = 1 }"), &["an illuminant's name or file", "found 5"]),
        (light("emission = { spectrum = §{ blackbody = 5000, daylight = 5000 } }"), &["beside another one"]),
        (
            format!(
                "{SMALL}{CAMERA}[§environment.constant]\nspectrum = \"D50\"\nluminance = 1\n[environment.gradient]\n"
            ),
            &["one kind of environment"],
        ),
        (scene_with("[picture]\nexposure = §\"automatic\""), &["expected \"auto\" or an exposure value"]),
        (scene_with("[picture]\ngamut = §5"), &["expected a text in quotes"]),
        (scene_with("[materials]\nm = §5"), &["expected a table, found 5"]),
        (format!("meters_per_unit = §\"mm\"\n{CAMERA}"), &["expected a number, found the text \"mm\""]),
        (format!("{CAMERA}material = §gold\n"), &["must be quoted"]),
        (format!("{SMALL}{CAMERA}[§render]\n"), &["given twice"]),
    ]);
}

#[test]
fn what_is_missing_is_named_with_its_table() {
    all_refused_at_mark(&[
        (format!("§{SMALL}{LIGHT}"), &["`camera` is missing in this file"]),
        (shape("shape.sphere = §{}"), &["`radius` is missing in `objects.shape.sphere`"]),
        (scene_with("§[[objects]]\nmaterial = \"gold\""), &["`shape` is missing in `objects`"]),
        (light("emission = §{ luminance = 1 }"), &["`spectrum` is missing in `objects.emission`"]),
        (scene_with("§[[objects]]\nshape.sphere = { radius = 1 }"), &["neither a material nor an emission"]),
        (CAMERA.replace("fov = 40\n", "").replace("[camera]", "§[camera]"), &["how wide", "fov"]),
        (
            scene_with(
                "[[objects]]\nmaterial = \"m\"\nshape.sphere = { radius = 1 }\n§[materials.m]\ndescription = \"\"",
            ),
            &["is of no kind", "[conductor]"],
        ),
    ]);
}

#[test]
fn files_that_are_no_scenes() {
    for (content, says) in [
        (b"".to_vec(), "nothing in this file"),
        (b" \n# a remark\n".to_vec(), "nothing in this file"),
        (b"a = 1\nb = \"\xff\"".to_vec(), "scene.toml:2: this is no text: byte 12"),
        ((0..=255).cycle().take(5000).collect(), "no text"),
        (b"a\0b = 1".to_vec(), "scene.toml:1:2: "),
        (b"[camera".to_vec(), "scene.toml:1:8: unclosed table"),
    ] {
        assert_refused(&render(content, &[], &["-q"]), &[says]);
    }
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("folder.toml")).expect("a folder");
    fs::write(folder.path().join("ring.toml"), scene_with(SPHERE)).expect("a file");
    for (name, says) in [
        ("folder.toml", "folder.toml is a folder"),
        ("rings.toml", "did you mean ring.toml?"),
        ("none/ring.toml", "there is no file none/ring.toml"),
        ("rendr", "did you mean the command `render`?"),
    ] {
        for command in ["render", "inspect"] {
            let outcome = spectrel(folder.path(), &[command, name]);
            assert_eq!(outcome.code, Some(2));
            assert!(outcome.stderr.contains(says), "{}", outcome.stderr);
            assert_eq!(outcome.written.len(), 2, "{:?}", outcome.written);
        }
    }
}

#[test]
fn ten_thousand_levels_do_not_overflow_the_stack() {
    let n = 10_000;
    for scene in [
        format!("a = {}", "[".repeat(n)),
        format!("a = {}{}", "[".repeat(n), "]".repeat(n)),
        format!("a = {}1{}", "{a = ".repeat(n), "}".repeat(n)),
        format!("{}b = 1", "a.".repeat(n)),
        format!("[{}b]", "a.".repeat(n)),
        format!("[[{}b]]", "a.".repeat(n)),
        (1..n / 100).map(|i| format!("[{}b]\n", "a.".repeat(i))).collect(),
    ] {
        assert_refused(&render(scene, &[], &["-q"]), &[]);
    }
}

#[test]
fn sizes_must_be_finite_and_above_zero() {
    for bad in ["0", "-1", "nan", "inf", "1e-60", "1e300"] {
        all_refused_at_mark(&[
            (shape(&format!("shape.sphere = {{ radius = §{bad} }}")), &["expected a length"]),
            (shape(&format!("shape.disk = {{ radius = §{bad} }}")), &["expected a length"]),
            (shape(&format!("shape.rectangle = {{ size = [1, §{bad}] }}")), &["expected a length"]),
            (shape(&format!("shape.box = {{ size = [1, §{bad}, 1] }}")), &["expected a length"]),
            (shape(&format!("shape.brilliant.diameter = §{bad}")), &["expected a length"]),
            (shape(&format!("shape.step-cut = {{ width = §{bad}, length = 1 }}")), &["expected a length"]),
        ]);
    }
    all_refused_at_mark(&[
        (shape("§shape.sphere = { radius = 1e30 }"), &["radius of the sphere", "1e30"]),
        (shape("§shape.brilliant = { diameter = 1, crown_angle = 89 }"), &["the crown angle is 89"]),
        (shape("§shape.brilliant = { diameter = 1, girdle_facets = 17 }"), &["multiple of 16"]),
        (shape("§shape.step-cut = { width = 2, length = 1 }"), &["length ratio"]),
        (shape("§shape.rectangle = { size = [1, 1], normal = [0, 0, 0] }"), &["normal"]),
        (shape("shape.disk = { radius = 1, normal = [0, §nan, 0] }"), &["finite"]),
        (shape("shape.sphere = { radius = 1, center = [0, 0, §inf] }"), &["finite"]),
    ]);
}

#[test]
fn transforms_must_not_degenerate() {
    let transformed = |transform: &str| shape(&format!("shape.sphere = {{ radius = 1 }}\ntransform = {transform}"));
    all_refused_at_mark(&[
        (transformed("§{ scale = 0 }"), &["flattens"]),
        (transformed("§{ scale = [1, 0, 1] }"), &["flattens"]),
        (transformed("{ scale = §nan }"), &["finite"]),
        (transformed("{ scale = [1, §nan, 1] }"), &["finite"]),
        (transformed("{ scale = §[1, 2] }"), &["expected 3 numbers, found 2"]),
        (transformed("{ rotate = [0, §nan, 0] }"), &["finite"]),
        (transformed("{ translate = [0, §inf, 0] }"), &["finite"]),
        (transformed("§{ scale = [1, 2, 1] }"), &["ellipsoid"]),
    ]);
}

#[test]
fn planes_must_close_a_volume() {
    all_refused_at_mark(&[
        (shape("§shape.convex.planes = []"), &["close no volume"]),
        (shape("§shape.convex.planes = [[1, 0, 0, 1], [-1, 0, 0, 1]]"), &["close no volume"]),
        (
            shape("§shape.convex.planes = [[1,0,0,-1],[-1,0,0,-1],[0,1,0,1],[0,-1,0,1],[0,0,1,1],[0,0,-1,1]]"),
            &["close no volume"],
        ),
        (shape("shape.convex.planes = [[1,0,0,1],§[0,0,0,1],[-1,0,0,1]]"), &["normal of this plane"]),
        (shape("shape.convex.planes = [[1,0,0,§nan]]"), &["finite"]),
        (shape("shape.convex.planes = [§[1,0,0,1,1]]"), &["expected 4 numbers, found 5"]),
    ]);
}

#[test]
fn optical_constants_must_be_possible() {
    all_refused_at_mark(&[
        (material("conductor]\nior = §{ n = -1, k = 2 }"), &["n is -1"]),
        (material("conductor]\nior = §{ n = 1, k = -1 }"), &["k is -1"]),
        (material("conductor]\nior = §{ n = 1, k = inf }"), &["k is inf"]),
        (material("conductor]\nior = §{ n = 1e200, k = 1 }"), &["n is 1e200"]),
        (material("dielectric]\nior = §0"), &["n is 0"]),
        (material("dielectric]\nior = §nan"), &["n is NaN"]),
        (material("conductor]\nior = { n = 1, k = 1, §q = 1 }"), &["unknown key `q`"]),
        (material("conductor]\nior = 1\nroughness = §2"), &["`roughness` is 2", "between 0 and 1"]),
        (material("conductor]\nior = 1\nroughness = §nan"), &["`roughness` is NaN"]),
        (material("conductor]\nior = 1\nperceptual_roughness = §-0.5"), &["`perceptual_roughness` is -0.5"]),
        (
            material("conductor]\nior = 1\nroughness = 0.1\nperceptual_roughness = §0.3"),
            &["`roughness` and `perceptual_roughness`", "α = r²"],
        ),
        (
            material("conductor]\nior = 1\n[materials.m.diffuse]\nreflectance = 0.5")
                .replace("[materials.m.c", "[materials.§m.c"),
            &["more than one kind"],
        ),
        (material("diffuse]\nreflectance = §1.5"), &["between 0 and 1"]),
        (material("diffuse]\nreflectance = §nan"), &["between 0 and 1"]),
        (material("diffuse]\nreflectance = §{ rgb = [2, 0, 0] }"), &["2, expected 0 to 1"]),
        (material("diffuse]\nreflectance = { rgb = §[0, 0, 0, 1] }"), &["expected 3 numbers, found 4"]),
        (material("dielectric]\nior = 1.5\nabsorption = §-1"), &["not negative"]),
    ]);
}

#[test]
fn absorption_needs_a_scale() {
    let sapphire = "[[objects]]\nmaterial = §\"blue-sapphire\"\nshape.sphere = { radius = 1 }";
    refused_at_mark(&scene_with(sapphire), &[], &["absorbs light", "add `meters_per_unit"]);
    refused_at_mark(&format!("outside = §\"water\"\n{CAMERA}"), &[], &["add `meters_per_unit"]);
    for bad in ["0", "-1", "nan", "inf"] {
        refused_at_mark(&format!("meters_per_unit = §{bad}\n{CAMERA}"), &[], &["`meters_per_unit` is", "above 0"]);
    }
    let huge = format!("meters_per_unit = 1e300\n{}", scene_with(sapphire));
    refused_at_mark(&huge, &[], &["is `meters_per_unit` right?"]);
    refused_at_mark(&format!("outside = §\"gold\"\n{CAMERA}"), &[], &["no dielectric"]);
}

#[test]
fn cameras_must_see() {
    let with = |more: &str| format!("{CAMERA}{more}\n");
    all_refused_at_mark(&[
        (CAMERA.replace("40", "§0"), &["field of view of 0°"]),
        (CAMERA.replace("40", "§-40"), &["field of view of -40°"]),
        (CAMERA.replace("40", "§180"), &["field of view of 180°"]),
        (CAMERA.replace("40", "§nan"), &["field of view of NaN°"]),
        (CAMERA.replace("fov = 40", "focal_length_mm = §0"), &["focal_length_mm is 0"]),
        (CAMERA.replace("fov = 40", "focal_length_mm = 50\nsensor_width_mm = §-1"), &["sensor_width_mm is -1"]),
        (with("focal_length_mm = §50"), &["`fov` and `focal_length_mm`"]),
        (with("sensor_width_mm = §36"), &["goes with `focal_length_mm`"]),
        (with("up = §[0, 1, 0]"), &["`up` is parallel"]),
        (with("up = §[0, 0, 0]"), &["`up` is parallel"]),
        (CAMERA.replace("[0, -10, 0]", "[0, 0, 10]").replace("[camera]", "§[camera]"), &["`up` is parallel"]),
        (CAMERA.replace("look_at = [0, 0, 0]", "look_at = §[0, -10, 0]"), &["same point"]),
        (CAMERA.replace("-10", "§nan"), &["finite"]),
        (CAMERA.replace("-10", "§-1e300"), &["finite"]),
        (format!("{}{SPHERE}", CAMERA.replace("[0, -10, 0]", "§[0, -0.5, 0]")), &["stands inside `object 1`"]),
    ]);
}

#[test]
fn lights_must_have_a_strength_that_can_be() {
    all_refused_at_mark(&[
        (light("emission = { spectrum = §\"D50\" }"), &["how strong", "`luminance` in cd/m²"]),
        (light("emission = { spectrum = \"D50\", luminance = 1, radiance = §2 }"), &["`luminance` and `radiance`"]),
        (light("emission = { spectrum = \"D50\", luminance = §-1 }"), &["`luminance` is -1"]),
        (light("emission = { spectrum = \"D50\", radiance = §nan }"), &["`radiance` is NaN"]),
        (light("emission = { spectrum = \"D50\", scale = §inf }"), &["`scale` is inf"]),
        (light("emission = { spectrum = §\"D50\", luminance = 1e300 }"), &["1.00e300 cd/m²"]),
        (light("emission = { spectrum = { blackbody = §0 } }"), &["`blackbody` is 0"]),
        (light("emission = { spectrum = §{ blackbody = 1e300 } }"), &["cd/m²"]),
        (light("emission = { spectrum = §{ blackbody = 1e-3 }, luminance = 1 }"), &["no light in 360–830 nm"]),
        (light("emission = { spectrum = { daylight = §100 }, luminance = 1 }"), &["4000 to 25000 K"]),
        (light("emission = { spectrum = { lines = [[500, 1], §[200, 1]] }, luminance = 1 }"), &["200 nm", "360–830"]),
        (light("emission = { spectrum = { lines = [§[831, 1]] }, luminance = 1 }"), &["831 nm"]),
        (light("emission = { spectrum = { lines = [§[500, -1]] }, luminance = 1 }"), &["power -1"]),
        (light("emission = { spectrum = §{ lines = [] }, luminance = 1 }"), &["no light"]),
        (
            light(
                "emission = { spectrum = { table = { wavelength_nm = [400, 500, §450], value = [1, 1, 1] } }, luminance = 1 }",
            ),
            &["wavelengths must grow"],
        ),
        (
            light(
                "emission = { spectrum = { table = { wavelength_nm = [400, 500], value = [1, §-1] } }, luminance = 1 }",
            ),
            &["`value` is -1"],
        ),
        (
            light("emission = { spectrum = §{ table = { wavelength_nm = [400], value = [1, 1] } }, luminance = 1 }"),
            &["1 wavelengths and 2 values"],
        ),
        (
            scene_with(
                "[[objects]]\nmaterial = \"m\"\nshape.sphere = { radius = 1 }\n\
                 emission = §{ spectrum = \"D50\", luminance = 1 }\n[materials.m.dielectric]\nior = 1.5",
            ),
            &["object 1 is a dielectric: it cannot shine"],
        ),
        (
            scene_with(
                "[[objects]]\nmaterial = \"m\"\n§shape.disk = { radius = 1 }\n[materials.m.dielectric]\nior = 1.5",
            ),
            &["flat", "`box`"],
        ),
    ]);
}

#[test]
fn no_light_is_a_black_picture_with_a_warning() {
    for dark in [[SMALL, CAMERA, SPHERE].concat(), scene_with(SPHERE).replace("= 100", "= 0")] {
        let outcome = render(dark, &[], &["-q"]);
        assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
        assert!(outcome.stderr.contains("warning: nothing in this scene shines"), "{}", outcome.stderr);
        assert!(outcome.written.contains("scene.png"));
    }
}

#[test]
fn a_spectrum_short_of_the_visible_is_warned_of_with_its_range() {
    let scene = material("conductor]\nior = \"own.csv\"");
    let outcome = render(scene, &[("own.csv", "wavelength_nm,n,k\n450,1,2\n650,1,3\n")], &["-q"]);
    assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
    assert!(outcome.stderr.starts_with("warning: `own.csv` (m) covers 450–650 nm"), "{}", outcome.stderr);
}

#[test]
fn broken_data_files_are_told_with_both_places() {
    let scene = |file: &str| material(&format!("conductor]\nior = §\"{file}\""));
    for (file, content, says) in [
        ("own.csv", "", "own.csv: the file is empty"),
        ("own.csv", "400,1,2\n", "own.csv:1:1: numbers without a header"),
        ("own.csv", "wavelength_nm,n,k\n400,1,2\n500,-1,2\n", "own.csv:3:5: n is -1"),
        ("own.csv", "wavelength_nm,n,k\n400,1,2\n500,1,nan\n", "own.csv:3:7: "),
        ("own.csv", "wavelength_nm,n,k\n400,1,2\n400,1,2\n", "own.csv:3:1: "),
        ("own.csv", "wavelength_nm,n,k\n400,1\n", "own.csv:2:1: 2 columns"),
        ("own.yml", "", "own.yml"),
        ("own.yml", "DATA:\n  - type: tabulated nk\n    data: |\n        0.4 1\n", "own.yml:4:"),
        ("own.yml", "DATA:\n  - type: nonsense\n", "own.yml:2:11: the type `nonsense`"),
        ("own.yml", "DATA: [\n", "own.yml:"),
        ("own.toml", "quantity = \"ior\"\n", "own.toml:"),
    ] {
        refused_at_mark(&scene(file), &[(file, content)], &[says]);
    }
    refused_at_mark(&scene("none.csv"), &[], &["cannot read none.csv"]);
}

#[test]
fn settings_must_be_possible() {
    all_refused_at_mark(&[
        (format!("[render]\nwidth = §0\n{CAMERA}"), &["`width` is 0"]),
        (format!("[render]\nheight = §0\n{CAMERA}"), &["`height` is 0"]),
        (format!("[render]\nsamples = §0\n{CAMERA}"), &["`samples` is 0"]),
        (format!("[render]\nmax_depth = §0\n{CAMERA}"), &["`max_depth` is 0"]),
        (scene_with("[picture]\nexposure = §nan"), &["exposure of NaN"]),
        (scene_with("[picture]\nexposure = §65"), &["between −64 and 64"]),
    ]);
}

#[test]
fn pictures_beyond_memory_say_how_much_they_would_take() {
    for [width, height] in [["200000", "200000"], ["4294967295", "4294967295"]] {
        let outcome = render(scene_with(SPHERE), &[], &["--width", width, "--height", height]);
        assert_refused(&outcome, &["GiB of memory"]);
    }
}

#[test]
fn impossible_options_are_refused_before_the_render() {
    for (args, says) in [
        (&["--width", "0"] as &[&str], "--width"),
        (&["--spp", "0"], "--spp"),
        (&["--threads", "0"], "--threads"),
        (&["--threads", "60000"], "--threads"),
        (&["--lanes", "2"], "1, 4 or 8"),
        (&["--crop", "0,0,9,9"], "no part of a picture of 4 × 3 pixels"),
        (&["--crop", "1,1,1,2"], "no part of a picture"),
        (&["--crop", "a,b"], "four whole numbers"),
        (&["--fresnel", "schlik"], "did you mean `schlick`?"),
        (&["--png-bits", "12"], "8 or 16"),
        (&["--library", "none"], "no such folder"),
        (&["--spq", "1"], "--spp"),
        (&["-o", "none/a.png"], "the folder `none` does not exist"),
        (&["-o", "a.jpg"], "must end in .exr or .png"),
        (&["-o", "a"], "must end in .exr or .png"),
        (&["-o", "."], "must end in .exr or .png"),
        (&["-o", "a.png", "-o", "none/b.exr"], "does not exist"),
    ] {
        let outcome = render(scene_with(SPHERE), &[], args);
        assert_refused(&outcome, &[says]);
    }
}

#[test]
fn an_output_that_is_a_folder_or_cannot_be_encoded_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("a.png")).expect("a folder");
    fs::write(folder.path().join("scene.toml"), scene_with(SPHERE)).expect("a file");
    let outcome = spectrel(folder.path(), &["render", "scene.toml", "-o", "b.png", "-o", "a.png"]);
    assert_eq!(outcome.code, Some(2));
    assert!(outcome.stderr.contains("`a.png`: it is a folder"), "{}", outcome.stderr);
    assert_eq!(outcome.written, BTreeSet::from(["a.png".into(), "scene.toml".into()]));
    let side = "4294967295";
    let outcome = render(scene_with(SPHERE), &[], &["--width", side, "--height", side, "--crop", "0,0,2,2", "-q"]);
    assert_refused(&outcome, &["cannot encode the EXR"]);
}

/// A small generator of its own: the test must find the same inputs on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % end as u64) as usize
    }

    fn of<'a>(&mut self, choices: &[&'a str]) -> &'a str {
        choices[self.below(choices.len())]
    }
}

const NASTY: [&str; 22] = [
    "nan",
    "-inf",
    "0",
    "-0.0",
    "1e300",
    "-1e38",
    "1e-300",
    "1e15",
    "4294967295",
    "-9223372036854775808",
    "\"\"",
    "[]",
    "{}",
    "true",
    "\"D50\"",
    "1979-05-27",
    "\n",
    "[[",
    "]",
    "= ",
    "µ",
    "\u{0}",
];

/// A scene with one to three wounds: bytes changed, words replaced by nasty ones, lines lost, doubled or moved.
fn wounded(scene: &str, random: &mut Random) -> String {
    let mut text = scene.as_bytes().to_vec();
    for _ in 0..=random.below(3) {
        let at = random.below(text.len());
        match random.below(5) {
            0 => text[at] = random.below(256) as u8,
            1 => drop(text.drain(at..(at + 1 + random.below(12)).min(text.len()))),
            2 => drop(text.splice(at..at, random.of(&NASTY).bytes())),
            3 => {
                let is_word = |byte: &u8| byte.is_ascii_alphanumeric() || b".-_\"".contains(byte);
                let start = text[..at].iter().rposition(|byte| !is_word(byte)).map_or(0, |before| before + 1);
                let end = text[at..].iter().position(|byte| !is_word(byte)).map_or(text.len(), |length| at + length);
                text.splice(start..end.max(start), random.of(&NASTY).bytes());
            }
            _ => {
                let mut lines: Vec<_> = text.split(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect();
                let line = lines.remove(random.below(lines.len()));
                for _ in 0..random.below(3) {
                    lines.insert(random.below(lines.len()), line.clone());
                }
                text = lines.join(&b'\n');
            }
        }
    }
    String::from_utf8_lossy(&text).into_owned()
}

#[test]
fn wounded_scenes_are_scenes_or_errors() {
    let scene = include_str!("../scenes/tray.toml");
    let library = Library::default();
    let mut random = Random(0x5eed);
    let started = Instant::now();
    let (mut good, mut bad) = (0, 0);
    while good + bad < 4000 && started.elapsed() < Duration::from_secs(20) {
        let text = wounded(scene, &mut random);
        let read = || resolve(Text::new("wounded.toml", text.clone()), &library, &Overrides::default()).map(drop);
        match std::panic::catch_unwind(std::panic::AssertUnwindSafe(read)) {
            Ok(Ok(())) => good += 1,
            Ok(Err(error)) => {
                assert!(!error.to_string().is_empty());
                bad += 1;
            }
            Err(_) => panic!("panicked on\n{text}"),
        }
    }
    assert!(good > 0 && bad > 0, "{good} good and {bad} bad scenes");
}
