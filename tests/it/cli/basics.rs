//! The command line from outside: what is printed, which files appear, and what is in them.

use crate::common::command::{command, folder, run};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

const SPHERE_SCENE: &str = r#"
[render]
width = 6
height = 4
samples = 4

[camera]
position = [0, -10, 0]
look_at = [0, 0, 0]
fov = 25

[picture]
exposure = 7

[environment.constant]
spectrum = "D50"
luminance = 100

[[objects]]
material = "MATERIAL"
shape.sphere = { radius = 3 }
"#;

fn scene_of(material: &str) -> String {
    SPHERE_SCENE.replace("MATERIAL", material)
}

fn stdout(folder: &Path, args: &[&str]) -> String {
    String::from_utf8(run(folder, args).stdout).expect("text")
}

fn json(args: &[&str]) -> Value {
    serde_json::from_str(&stdout(Path::new("."), args)).expect("JSON")
}

fn files(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("a plain name")).collect()
}

struct Picture {
    size: (u32, u32),
    pixels: Vec<u8>,
    texts: BTreeMap<String, String>,
}

fn read_png(path: &Path) -> Picture {
    let file = std::io::BufReader::new(fs::File::open(path).expect("a picture"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a small picture")];
    reader.next_frame(&mut pixels).expect("pixels");
    let info = reader.info();
    let texts = info.uncompressed_latin1_text.iter().map(|text| (text.keyword.clone(), text.text.clone())).collect();
    Picture { size: info.size(), pixels, texts }
}

/// The pixels of a small render.
fn pixels(folder: &Path, args: &[&str]) -> Vec<u8> {
    run(folder, &[&["render"], args, &["-q", "-o", "picture.png"]].concat());
    read_png(&folder.join("picture.png")).pixels
}

#[test]
fn list_names_everything_with_its_source() {
    for (what, at_least) in [("materials", 80), ("spectra", 100), ("illuminants", 20)] {
        let entries = json(&["list", what, "--json"]);
        let entries = entries.as_array().expect("a list");
        assert!(entries.len() >= at_least, "{} {what}", entries.len());
        let text = stdout(Path::new("."), &["list", what]);
        assert_eq!(text.lines().count(), entries.len() + 1, "a line each and a head");
        for entry in entries {
            let name = entry["name"].as_str().expect("a name");
            assert!(text.lines().any(|line| line.starts_with(&format!("{name} "))), "{name}");
            assert!(!entry["authors"].as_str().expect("authors").is_empty(), "{name} names nobody");
            assert!(!entry["licence"].as_str().expect("a licence").is_empty(), "{name} has no licence");
        }
    }
    assert!(stdout(Path::new("."), &["list", "materials"]).contains("R. L. Olmon 2012"));
}

/// Every material that the reference selection names can be asked for by that name.
#[test]
fn every_name_of_the_selection_is_known() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/ior_selection.csv");
    let Ok(selection) = fs::read_to_string(path) else { return };
    let entries = json(&["list", "materials", "--json"]);
    let known: BTreeSet<&str> = entries
        .as_array()
        .expect("a list")
        .iter()
        .flat_map(|entry| entry["aliases"].as_array().into_iter().flatten().chain([&entry["name"]]))
        .filter_map(Value::as_str)
        .collect();
    let rows = selection.lines().filter(|line| !line.starts_with('#') && !line.starts_with("name,"));
    let wanted: Vec<&str> = rows.filter_map(|row| row.split(',').next()).collect();
    assert_eq!(wanted.len(), 91);
    let missing: Vec<_> = wanted.iter().filter(|name| !known.contains(**name)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn inspect_shows_the_default_scene() {
    let text = stdout(Path::new("."), &["inspect"]);
    for words in [
        "960 × 640 pixels, 128 samples each",
        "Objects: ",
        "dispersion",
        "Data\n",
        "Au/olmon-2012-evaporated",
        "300–2502 nm",
    ] {
        assert!(text.contains(words), "{words:?} is not in\n{text}");
    }
    let report = json(&["inspect", "--json"]);
    assert_eq!((report["width"].as_u64(), report["samples"].as_u64()), (Some(960), Some(128)));
    assert_eq!(report["white_balance"], "D50");
    let physics = report["physics"].as_array().expect("decisions");
    assert!(physics.iter().all(|decision| !decision["reason"].as_str().expect("a reason").is_empty()));
    let dispersion = physics.iter().find(|decision| decision["part"] == "dispersion").expect("a decision");
    assert_eq!(dispersion["used"], true);
    let data = report["data"].as_array().expect("data sets");
    let gold = data.iter().find(|data| data["name"] == "Au/olmon-2012-evaporated").expect("gold's data");
    assert!(gold["used_by"].as_array().expect("users").contains(&"gold".into()));
}

#[test]
fn inspect_warns_as_render_does() {
    let folder = folder(&[
        (
            "a.toml",
            &scene_of("own").replace("[[objects]]", "[materials.own.conductor]\nior = \"own.csv\"\n[[objects]]"),
        ),
        ("own.csv", "wavelength_nm,n,k\n450,1,2\n650,1,3\n"),
    ]);
    let text = stdout(folder.path(), &["inspect", "a.toml"]);
    assert!(text.contains("Warnings\n  `own.csv` (own) covers 450–650 nm"), "{text}");
    assert!(text.contains("short of the visible"), "{text}");
}

#[test]
fn render_writes_the_named_files_and_says_so() {
    let folder = folder(&[("a.toml", &scene_of("gold"))]);
    let output = run(folder.path(), &["render", "a.toml", "--crop", "1,1,4,3", "-o", "b.png", "-o", "c.exr"]);
    let stderr = String::from_utf8(output.stderr).expect("text");
    for words in ["100 %", "3 × 2 pixels, 4 samples each", "exposure 7.00 EV", "wrote b.png", "wrote c.exr"] {
        assert!(stderr.contains(words), "{words:?} is not in\n{stderr}");
    }
    assert!(output.stdout.is_empty());
    assert_eq!(files(folder.path()), BTreeSet::from(["a.toml", "b.png", "c.exr"].map(String::from)));
    assert_eq!(read_png(&folder.path().join("b.png")).size, (3, 2));
}

#[test]
fn render_names_files_after_the_scene() {
    let scene = scene_of("gold");
    let folder = folder(&[("below/white.gold.toml", &scene)]);
    run(folder.path(), &["below/white.gold.toml", "-q"]);
    assert_eq!(files(folder.path()), BTreeSet::from(["below", "white.gold.exr", "white.gold.png"].map(String::from)));
}

#[test]
fn the_default_scene_needs_no_file_and_quiet_prints_nothing() {
    let folder = folder(&[("spectrel.png", "an older file")]);
    let output = run(folder.path(), &["--width", "12", "--spp", "1", "--quiet"]);
    assert_eq!((output.stdout, output.stderr), (vec![], vec![]));
    assert_eq!(files(folder.path()), BTreeSet::from(["spectrel.exr", "spectrel.png"].map(String::from)));
    assert_eq!(read_png(&folder.path().join("spectrel.png")).size, (12, 8), "replaced, and the height follows");
}

#[test]
fn files_hold_what_determines_them_and_nothing_else() {
    let folder = folder(&[("a.toml", &scene_of("gold"))]);
    let outputs = |threads: &str, seed: &str| {
        run(folder.path(), &["render", "a.toml", "-q", "--threads", threads, "--seed", seed]);
        ["a.png", "a.exr"].map(|name| fs::read(folder.path().join(name)).expect("a picture"))
    };
    let one = outputs("1", "5");
    assert!(one == outputs("2", "5"), "one thread and two");
    assert!(one == outputs("2", "5"), "again");
    let texts = read_png(&folder.path().join("a.png")).texts;
    let text = |key: &str| texts.get(&format!("spectrel:{key}")).map(String::as_str);
    assert_eq!(
        (text("samples"), text("seed"), text("size"), text("lanes")),
        (Some("4"), Some("5"), Some("6x4"), Some("8"))
    );
    assert_eq!((text("crop"), text("fresnel"), text("white")), (Some("0,0,6,4"), Some("by material"), Some("D65")));
    assert_eq!(text("version"), Some(env!("CARGO_PKG_VERSION")));
    assert_eq!(text("scene").map(str::len), Some(16));
    assert!(one != outputs("2", "6"), "another seed");
}

#[test]
fn options_change_the_picture_as_they_say() {
    let folder = folder(&[("a.toml", &scene_of("copper"))]);
    let exact = pixels(folder.path(), &["a.toml"]);
    assert_ne!(exact, pixels(folder.path(), &["a.toml", "--fresnel", "schlick"]));
    assert_eq!(exact, pixels(folder.path(), &["a.toml", "--lanes", "8"]));
    for lanes in ["1", "4"] {
        assert_ne!(
            exact,
            pixels(folder.path(), &["a.toml", "--lanes", lanes]),
            "{lanes} wavelengths have another noise"
        );
    }
    assert_eq!(pixels(folder.path(), &["a.toml", "--height", "2"]).len(), 3 * 2 * 3);
    assert_eq!(pixels(folder.path(), &["a.toml", "--png-bits", "16"]).len(), 2 * exact.len());
}

const OWN_MATERIAL: &str = "aliases = [\"pale-metal\"]\n[conductor]\nior = { n = 0.2, k = 4 }\n";

#[test]
fn a_users_library_adds_and_overrides() {
    let folder = folder(&[
        ("library/materials/own-metal.toml", OWN_MATERIAL),
        ("library/materials/gold.toml", OWN_MATERIAL),
        ("own.toml", &scene_of("own-metal")),
        ("alias.toml", &scene_of("pale-metal")),
        ("gold.toml", &scene_of("gold")),
    ]);
    let with_library = |scene: &str| pixels(folder.path(), &[scene, "--library", "library"]);
    let own = with_library("own.toml");
    assert_eq!(own, with_library("alias.toml"));
    assert_eq!(own, with_library("gold.toml"), "the user's gold");
    assert_ne!(own, pixels(folder.path(), &["gold.toml"]), "the built-in gold");
    let list = stdout(folder.path(), &["list", "materials", "--library", "library"]);
    assert!(list.contains("own-metal") && list.contains("pale-metal"));
    let scene =
        scene_of("own").replace("[[objects]]", "[materials.own.conductor]\nior = { n = 0.2, k = 4 }\n[[objects]]");
    fs::write(folder.path().join("inline.toml"), scene).expect("a file");
    assert_eq!(own, pixels(folder.path(), &["inline.toml"]), "the same material in the scene");
}

#[test]
fn a_users_data_files_stand_beside_the_scene() {
    let scene = |ior: &str| {
        scene_of("own").replace("[[objects]]", &format!("[materials.own.conductor]\nior = {ior}\n[[objects]]"))
    };
    let page = "REFERENCES: \"own measurement\"\nDATA:\n  - type: tabulated nk\n    data: |\n        0.3 0.2 4\n        0.9 0.2 4\n";
    let folder = folder(&[
        ("scenes/plain.toml", &scene("{ n = 0.2, k = 4 }")),
        ("scenes/page.toml", &scene("\"own.yml\"")),
        ("scenes/table.toml", &scene("\"data/own.csv\"")),
        ("scenes/own.yml", page),
        ("scenes/data/own.csv", "wavelength_nm,n,k\n300,0.2,4\n900,0.2,4\n"),
    ]);
    let plain = pixels(folder.path(), &["scenes/plain.toml"]);
    assert_eq!(plain, pixels(folder.path(), &["scenes/page.toml"]));
    assert_eq!(plain, pixels(folder.path(), &["scenes/table.toml"]));
}

#[test]
fn help_is_short_and_names_every_command() {
    for args in [&["--help"] as &[&str], &["-h"], &["render", "--help"], &["inspect", "--help"], &["list", "--help"]] {
        let help = stdout(Path::new("."), args);
        let longest = help.lines().map(|line| line.chars().count()).max();
        assert!(longest <= Some(130), "{args:?}: {longest:?} columns");
    }
    let help = stdout(Path::new("."), &["--help"]);
    assert!(["render", "inspect", "list", "Examples:", "Ctrl-C"].iter().all(|word| help.contains(word)), "{help}");
}

/// As in `spectrel list spectra | head -1`.
#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    for args in [&["list", "spectra"] as &[&str], &["list", "spectra", "--json"], &["inspect", "--json"]] {
        let mut child =
            command(Path::new("."), args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("spectrel runs");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("spectrel ends");
        assert!(output.status.success());
        assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

/// Ctrl-C: what there is is written, and that is no failure.
#[cfg(target_os = "linux")]
#[test]
fn an_interrupt_writes_what_there_is() {
    use std::time::{Duration, Instant};

    /// Whether a process has a handler for SIGINT (2): bit 1 of the mask of caught signals.
    fn catches_interrupts(process: u32) -> bool {
        let status = fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap_or("0");
        u64::from_str_radix(mask.trim(), 16).is_ok_and(|mask| mask & 0b10 != 0)
    }

    let folder = folder(&[("a.toml", &scene_of("gold"))]);
    let args = ["a.toml", "--width", "300", "--spp", "1000000"];
    let child = command(folder.path(), &args).stderr(Stdio::piped()).spawn().expect("spectrel runs");
    let started = Instant::now();
    while !catches_interrupts(child.id()) && started.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(20));
    }
    std::thread::sleep(Duration::from_millis(300));
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill runs");
    assert!(kill.success());
    let output = child.wait_with_output().expect("spectrel ends");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{stderr}");
    assert!(stderr.contains("interrupted: writing what there is"), "{stderr}");
    assert_eq!(read_png(&folder.path().join("a.png")).size, (300, 200));
    assert!(folder.path().join("a.exr").is_file());
}
