//! `spectrel compare` from outside: which files appear, what is in them, and what is refused.

use crate::common::command::{folder, refused, run};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// A gold sphere and a glass one on a grey floor.
const SCENE: &str = r#"
[render]
width = 24
height = 16
samples = 32

[camera]
position = [0, -12, 4]
look_at = [0, 0, 1]
fov = 30

[environment.gradient]
zenith = { spectrum = "D65", luminance = 200 }
horizon = { spectrum = "D65", luminance = 60 }
nadir = { spectrum = "D65", luminance = 5 }

[materials.grey.diffuse]
reflectance = 0.3

[materials."a <b> & c".conductor]
ior = "Ti/palm-2018"

[[objects]]
material = "grey"
shape.rectangle = { size = [40, 40] }

[[objects]]
material = "gold"
shape.sphere = { center = [-1.6, 0, 1.501], radius = 1.5 }

[[objects]]
material = "diamond"
shape.sphere = { center = [1.6, 0, 1.501], radius = 1.5 }

[[objects]]
material = "a <b> & c"
shape.sphere = { center = [0, -2, 0.501], radius = 0.5 }
"#;

fn report(folder: &Path, dir: &str) -> Value {
    serde_json::from_slice(&fs::read(folder.join(dir).join("report.json")).expect("a report")).expect("JSON")
}

/// Compares the scene in a folder of its own, and gives the report.
fn compared(args: &[&str]) -> Value {
    let folder = folder(&[("s.toml", SCENE)]);
    run(folder.path(), &[&["compare", "s.toml", "-q", "-o", "out"], args].concat());
    report(folder.path(), "out")
}

fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("no {path} in {value}"))
}

#[test]
fn a_report_is_whole_and_says_what_it_is() {
    let folder = folder(&[("s.toml", SCENE)]);
    let answer = run(
        folder.path(),
        &["compare", "s.toml", "--models", "exact,schlick", "--ior", "gold=Au/johnson-christy-1972"],
    );
    let table = String::from_utf8(answer.stdout).expect("text");
    assert!(table.contains("reference") && table.contains("gold: Au/johnson-christy-1972"), "{table}");
    let said = String::from_utf8(answer.stderr).expect("text");
    assert!(said.contains("rendering") && said.contains("report"), "{said}");

    let out = folder.path().join("s-compare");
    let names: BTreeSet<_> = fs::read_dir(&out)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("plain"))
        .collect();
    let json = report(folder.path(), "s-compare");
    let variants = json["variants"].as_array().expect("variants");
    assert_eq!(variants.len(), 3);
    let mut expected = BTreeSet::from(["report.html".to_owned(), "report.json".to_owned()]);
    for variant in variants {
        let files = variant["files"].as_object().expect("files");
        expected.extend(files.values().filter_map(Value::as_str).map(str::to_owned));
    }
    assert_eq!(names, expected);
    assert_eq!(names.len(), 2 + 3 * 2 + 2 * 2);
    for name in names.iter().filter(|name| name.ends_with(".png")) {
        let file = std::io::BufReader::new(fs::File::open(out.join(name)).expect("a picture"));
        let info = png::Decoder::new(file).read_info().expect("a PNG").info().size();
        assert_eq!(info, (24, 16), "{name}");
    }
    assert!(names.contains("gold-by-au-johnson-christy-1972.exr"), "{names:?}");
    assert!(variants[0]["difference"].is_null() && variants[0]["model"] == "exact");
    for key in ["mean", "percentile_95", "max", "noise", "beyond_noise", "interval_95/0", "interval_95/1"] {
        number(&variants[1], &format!("/difference/delta_e2000/{key}"));
    }
    for key in ["rmse", "rmse_noise", "rel_mse", "energy/value", "energy/interval_95/0"] {
        number(&variants[1], &format!("/difference/{key}"));
    }
    for key in ["/rendering_seconds", "/report_seconds", "/settings/exposure_ev", "/reference_noise/rmse"] {
        number(&json, key);
    }
    assert!(number(&variants[1], "/ns_per_evaluation") > 0.0 && number(&variants[1], "/render_seconds") > 0.0);
    assert_eq!(json["settings"]["samples"], 32);
    assert_eq!(json["interrupted"], false);
    assert_eq!(
        json["settings"]["command"],
        "spectrel compare s.toml --models exact,schlick --ior gold=Au/johnson-christy-1972 --width 24 --height 16 --spp 32 --seed 0 --replicates 8"
    );
    let data = |name: &str| {
        json["data"].as_array().expect("data").iter().any(|data| data["name"] == name && data["doi"].is_string())
    };
    assert!(data("Au/olmon-2012-evaporated") && data("Au/johnson-christy-1972"), "{}", json["data"]);
}

#[test]
fn the_page_needs_nothing_else_and_names_stand_for_themselves() {
    let folder = folder(&[("s.toml", SCENE)]);
    run(folder.path(), &["compare", "s.toml", "-q", "--models", "exact,schlick", "--vary", "a <b> & c=silver"]);
    let page = fs::read_to_string(folder.path().join("s-compare/report.html")).expect("a page");
    assert!(page.starts_with("<!doctype html>") && page.contains("Content-Security-Policy"));
    for attribute in ["src=\"", "href=\"", "url("] {
        for target in page.split(attribute).skip(1) {
            let fine = ["data:", "https://doi.org/"].iter().any(|start| target.starts_with(start));
            assert!(fine, "{attribute}{}", &target[..40]);
        }
    }
    assert!(!page.contains("<b> &") && page.contains("a &lt;b&gt; &amp; c → silver"));
    assert!(!page.contains("{{") && !page.contains("NaN"));
    // Three pictures, two times two maps.
    assert_eq!(page.matches("src=\"data:image/png;base64,").count(), 3 + 2 * 2);
}

/// Neither threads nor chance change a number, but those of time.
#[test]
fn threads_change_nothing() {
    let numbers = |threads: &str| {
        let json = compared(&["--threads", threads, "--spp", "8"]);
        assert_eq!(json.pointer("/settings/threads").map(Value::to_string).as_deref(), Some(threads), "{json}");
        let variants = json["variants"].as_array().expect("variants");
        variants.iter().map(|variant| variant["difference"].clone()).collect::<Vec<_>>()
    };
    assert_eq!(numbers("1"), numbers("3"));
}

#[test]
fn the_same_is_identical() {
    let json = compared(&["--vary", "gold=gold"]);
    let difference = &json["variants"][1]["difference"];
    assert_eq!(difference["verdict"], "identical");
    for key in ["/delta_e2000/mean", "/delta_e2000/max", "/rmse", "/energy/value", "/delta_e2000/noise"] {
        assert_eq!(number(difference, key), 0.0, "{key}");
    }
}

#[test]
fn a_difference_is_found_at_few_samples_by_common_random_numbers() {
    let json = compared(&["--models", "exact,constant,schlick", "--spp", "16"]);
    assert_eq!(json["variants"][1]["difference"]["verdict"], "different");
    // What is left of the noise in the difference is a small part of that of the picture. Of `constant`, which changes what paths carry by
    // much more, it is less than half of the √2 that two pictures of their own would have.
    for (variant, most) in [(1, 0.5 * 2.0f64.sqrt()), (2, 0.5)] {
        let noise = number(&json, &format!("/variants/{variant}/difference/rmse_noise"));
        assert!(
            noise < most * number(&json, "/reference_noise/rmse"),
            "{variant}: {noise} {}",
            json["reference_noise"]
        );
    }
}

#[test]
fn what_varies_changes_the_picture() {
    let json = compared(&[
        "--vary",
        "gold=silver",
        "--ior",
        "gold=Au/johnson-christy-1972",
        "--ior",
        "diamond=Al2O3/malitson-dodge-1972-o",
    ]);
    let variants = json["variants"].as_array().expect("variants");
    assert_eq!(variants.len(), 4);
    for variant in &variants[1..] {
        assert_eq!(variant["difference"]["verdict"], "different", "{}", variant["label"]);
        assert_eq!(variant["model"], "exact");
    }
    let delta_e = |i: usize| number(&variants[i], "/difference/delta_e2000/mean");
    assert!(number(&variants[1], "/difference/energy/interval_95/0") > 0.0, "silver reflects more: {}", variants[1]);
    assert!(delta_e(1) > 2.0 * delta_e(2), "silver is no gold: {} {}", delta_e(1), delta_e(2));
}

#[test]
fn an_earlier_report_is_replaced_by_force_only() {
    let folder = folder(&[("s.toml", SCENE), ("mine/precious.txt", "x")]);
    let again = ["compare", "s.toml", "-q", "--models", "exact,schlick", "--spp", "8", "-o", "out"];
    run(folder.path(), &again);
    fs::write(folder.path().join("out/stale.png"), "").expect("a file");
    let said = refused(folder.path(), &again);
    assert!(said.contains("out holds a report already") && said.contains("--force"), "{said}");
    run(folder.path(), &[&again[..], &["--force"]].concat());
    assert!(!folder.path().join("out/stale.png").exists());
    // What is no report is never thrown away.
    let said = refused(folder.path(), &["compare", "s.toml", "-q", "-o", "mine", "--force"]);
    assert!(said.contains("no report"), "{said}");
    assert!(folder.path().join("mine/precious.txt").exists());
    let said = refused(folder.path(), &["compare", "s.toml", "-o", "no/where"]);
    assert!(said.contains("there is no folder no"), "{said}");
    // Nothing is left beside them.
    let left = fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(left, 3, "the scene, `mine` and `out`");
}

/// Other programs write a `report.json` too, and people put their notes beside a report.
#[test]
fn force_throws_nothing_away_that_is_no_report() {
    let folder = folder(&[("s.toml", SCENE)]);
    let out = folder.path().join("out");
    let again = ["compare", "s.toml", "-q", "-o", "out", "--force"];
    for (file, content) in [("report.json", "{}"), ("notes.txt", "mine"), ("src/main.rs", "fn main() {}")] {
        let path = out.join(file);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, content).expect("a file");
    }
    let said = refused(folder.path(), &again);
    assert!(said.contains("out is not empty") && said.contains("no report"), "{said}");
    assert!(out.join("notes.txt").is_file() && out.join("src/main.rs").is_file());
    fs::remove_dir_all(out.join("src")).expect("removed");
    assert!(refused(folder.path(), &again).contains("(`notes.txt`)"));
}

#[test]
fn wrong_names_are_told_with_what_was_meant() {
    let folder = folder(&[("s.toml", SCENE)]);
    let cases: [(&[&str], &[&str]); 10] = [
        (&["--vary", "gold=silver", "--vary", "gold=silver"], &["`gold → silver` is named twice"]),
        (&["--models", "exact,schlik"], &["schlik", "did you mean `schlick`?"]),
        (&["--models", "exact,exact"], &["`exact` twice"]),
        (&["--models", "exact"], &["nothing to compare"]),
        (&["--vary", "gald=silver"], &["no material `gald`", "did you mean `gold`?"]),
        (&["--vary", "gold=slver"], &["gold=slver", "did you mean `silver`?"]),
        (&["--vary", "gold"], &["gold=silver"]),
        (&["--ior", "gold=Au/jonson"], &["Au/jonson", "did you mean `Au/johnson-christy-1972`?"]),
        (&["--ior", "grey=Au/johnson-christy-1972"], &["`grey`", "diffuse", "Au/johnson-christy-1972"]),
        (&["--replicates", "2"], &["2", "3..=16"]),
    ];
    for (args, expected) in cases {
        let said = refused(folder.path(), &[&["compare", "s.toml"], args].concat());
        assert!(expected.iter().all(|part| said.contains(part)), "{args:?}: {said}");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1, "nothing was written");
}

/// `--ior` of a plain render: the picture is another one, and its file says why.
#[test]
fn a_render_takes_another_data_set() {
    let folder = folder(&[("s.toml", SCENE), ("mine.csv", "wavelength_nm,n,k\n360,1.5,2\n830,1.5,2\n")]);
    let picture = |args: &[&str]| {
        run(folder.path(), &[&["render", "s.toml", "-q", "-o", "p.png"], args].concat());
        fs::read(folder.path().join("p.png")).expect("a picture")
    };
    let contains = |bytes: &[u8], text: &str| bytes.windows(text.len()).any(|window| window == text.as_bytes());
    let (own, other) = (picture(&[]), picture(&["--ior", "gold=Au/johnson-christy-1972"]));
    assert!(own != other && contains(&other, "gold=Au/johnson-christy-1972") && !contains(&own, "spectrel:ior"));
    // The set that it has anyway, and a file of one's own.
    let mine = picture(&["--ior", "gold=mine.csv"]);
    assert!(mine != own && mine != other);
}

#[cfg(target_os = "linux")]
mod interrupted {
    use super::*;
    use crate::common::command::command;
    use std::io::{BufRead, BufReader};
    use std::process::{Child, Command, Stdio};

    /// Starts a comparison, interrupts it once it has said `until`, and gives its status in the end.
    fn interrupted(folder: &Path, spp: &str, until: &str) -> Option<i32> {
        let args = ["compare", "s.toml", "-o", "out", "--models", "exact,schlick", "--replicates", "16", "--spp", spp];
        let mut child: Child =
            command(folder, &args).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("spectrel runs");
        let mut lines = BufReader::new(child.stderr.take().expect("stderr")).lines();
        let heard = lines.any(|line| line.expect("text").contains(until));
        assert!(heard, "never said {until}");
        let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill runs");
        assert!(kill.success());
        lines.for_each(drop);
        child.wait().expect("spectrel ends").code()
    }

    #[test]
    fn after_enough_replicates_a_report_is_written() {
        let folder = folder(&[("s.toml", SCENE)]);
        assert_eq!(interrupted(folder.path(), "4000", "40 %"), Some(0));
        let json = report(folder.path(), "out");
        let replicates = json["settings"]["replicate_seeds"].as_array().expect("seeds").len();
        assert_eq!(json["interrupted"], true);
        assert!((4..16).contains(&replicates), "{replicates}");
        assert_eq!(json["settings"]["samples"], 250 * replicates);
    }

    #[test]
    fn before_that_nothing_is() {
        let folder = folder(&[("s.toml", SCENE)]);
        assert_eq!(interrupted(folder.path(), "16000", "10 %"), Some(130));
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
    }
}
