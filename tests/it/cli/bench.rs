//! `spectrel bench` from outside: what is in its report, whether the numbers are what they say, and what is refused.
//!
//! Times are read but decide nothing: they belong to the machine.

use crate::common::command::{folder, refused, run};
use crate::common::{film, scene};
use serde_json::Value;
use spectrel::scene::Overrides;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

/// A gold sphere and a cut diamond on a grey floor.
const SCENE: &str = r#"
[render]
width = 16
height = 16

[camera]
position = [0, -12, 5]
look_at = [0, 0, 1]
fov = 30

[picture]
exposure = 6.5

[environment.gradient]
zenith = { spectrum = "D65", luminance = 200 }
horizon = { spectrum = "D65", luminance = 60 }
nadir = { spectrum = "D65", luminance = 5 }

[materials.grey.diffuse]
reflectance = 0.3

[[objects]]
material = "grey"
shape.rectangle = { size = [40, 40] }

[[objects]]
material = "gold"
shape.sphere = { center = [-1.6, 0, 1.501], radius = 1.5 }

[[objects]]
material = "diamond"
shape.brilliant = { diameter = 3 }
transform = { rotate = [60, 0, 0], translate = [1.6, 0, 1.0] }
"#;

/// Enough time for all that is asked for, on a slow machine too.
const AMPLE: [&str; 2] = ["--time-budget", "10m"];

fn report(folder: &Path, dir: &str) -> Value {
    serde_json::from_slice(&fs::read(folder.join(dir).join("bench.json")).expect("a report")).expect("JSON")
}

/// Measures the scene in a folder of its own, and gives what was found of it.
fn found(args: &[&str]) -> Value {
    let folder = folder(&[("s.toml", SCENE)]);
    run(folder.path(), &[&["bench", "s.toml", "-q", "-o", "out"], args].concat());
    report(folder.path(), "out")["scenes"][0].clone()
}

fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("no {path} in {value}"))
}

fn array<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().unwrap_or_else(|| panic!("no {key} in {value}"))
}

fn variant<'a>(scene: &'a Value, label: &str) -> &'a Value {
    let all = array(scene, "variants");
    all.iter().find(|variant| variant["label"] == label).unwrap_or_else(|| panic!("no {label} in {all:?}"))
}

#[test]
fn a_report_is_whole_and_its_numbers_agree() {
    let folder = folder(&[("s.toml", SCENE)]);
    let args = [&["bench", "s.toml", "-o", "out", "--spp", "16,4", "--reference-spp", "512"], &AMPLE[..]].concat();
    let answer = run(folder.path(), &args);
    let table = String::from_utf8(answer.stdout).expect("text");
    assert!(table.contains("way to render") && table.contains("schlick instead of exact"), "{table}");
    let report = report(folder.path(), "out");
    assert_eq!(number(&report, "/time_budget_seconds"), 600.0);
    let found = &report["scenes"][0];
    assert_eq!((found["name"].as_str(), number(found, "/width")), (Some("s"), 16.0));
    assert_eq!((number(found, "/reference/samples"), number(found, "/reference/replicates")), (512.0, 8.0));
    assert!(number(found, "/reference/mse") > 0.0 && number(found, "/reference/delta_e2000") > 0.0);
    let labels: Vec<_> = array(found, "variants").iter().map(|v| v["label"].as_str().unwrap_or_default()).collect();
    let expected = [
        "exact, 8 lanes, sobol",
        "schlick",
        "f82",
        "rgb-exact",
        "4 lanes",
        "1 lane",
        "independent",
        "adaptive for rmse",
        "no dispersion",
    ];
    assert_eq!(labels, expected);
    // The usual way, then each of the others.
    assert_eq!(found["findings"].as_array().map(|all| all.len() >= labels.len()), Some(true));
    let mut runs = Vec::new();
    for variant in array(found, "variants") {
        let samples: Vec<_> = array(variant, "runs").iter().map(|run| number(run, "/samples")).collect();
        assert_eq!(samples, [4.0, 16.0], "{variant}");
        runs.extend(array(variant, "runs"));
    }
    for run in &runs {
        let (mse, seconds) = (number(run, "/mse"), number(run, "/cpu_seconds"));
        assert!(mse > 0.0 && seconds > 0.0 && number(run, "/rel_mse") > 0.0, "{run}");
        assert!((number(run, "/efficiency") * mse * seconds - 1.0).abs() < 1e-9, "{run}");
        // A path has a ray at least.
        assert!(number(run, "/rays_per_second") >= number(run, "/samples_per_second"), "{run}");
        let rate = 256.0 * number(run, "/samples") / number(run, "/wall_seconds");
        assert!((number(run, "/samples_per_second") / rate - 1.0).abs() < 1e-9, "{run}");
        let beaten = runs.iter().any(|other| number(other, "/mse") < mse && number(other, "/cpu_seconds") < seconds);
        assert!(run["pareto"] != true || !beaten, "{run}");
        assert_eq!(run["near_reference"] == true, mse < 3.0 * number(found, "/reference/mse"), "{run}");
    }
    let least = runs.iter().min_by(|a, b| number(a, "/mse").total_cmp(&number(b, "/mse"))).expect("runs");
    assert_eq!(least["pareto"], true);
    let page = fs::read_to_string(folder.path().join("out/bench.html")).expect("a page");
    assert!(page.contains("Content-Security-Policy") && page.contains("<svg") && !page.contains("src=\"http"));
    let figure = fs::read_to_string(folder.path().join("out/bench.svg")).expect("a figure");
    assert!(figure.starts_with("<svg") && figure.contains("no dispersion"));
    assert_eq!(fs::read_dir(folder.path().join("out")).expect("a folder").count(), 3);
}

/// Chance calls one of 40 renders different that is not: of fifteen, three or more in one set of seeds of 180.
#[test]
fn what_is_only_rendered_differently_has_no_bias() {
    const UNBIASED: [&str; 5] = ["exact, 8 lanes, sobol", "4 lanes", "1 lane", "independent", "adaptive for rmse"];
    let mut alarms = 0;
    for seed in ["0", "1", "2"] {
        let args =
            ["--spp", "4,64", "--reference-spp", "2048", "--models", "exact", "--dispersion", "on", "--seed", seed];
        let found = found(&[&args[..], &AMPLE[..]].concat());
        for label in UNBIASED {
            let variant = variant(&found, label);
            alarms += usize::from(variant["bias"]["verdict"] != "indistinguishable");
            let (bias, noise) = (number(variant, "/bias/delta_e2000"), number(variant, "/runs/1/noise_delta_e2000"));
            assert!(bias.abs() < 0.25 * noise, "{variant}");
        }
        less_error_by_more_samples(&found);
        let noise = |label: &str| number(self::variant(&found, label), "/runs/1/noise_delta_e2000");
        assert!(noise("1 lane") > 1.5 * noise("exact, 8 lanes, sobol"), "{found}");
    }
    assert!(alarms <= 2, "{alarms} of 15");
}

/// 16 times the samples leave a quarter of the noise if they are independent, and less if they are not.
fn less_error_by_more_samples(found: &Value) {
    for variant in array(found, "variants") {
        let [few, many] = [0, 1].map(|i| number(variant, &format!("/runs/{i}/mse")));
        let [loud, calm] = [0, 1].map(|i| number(variant, &format!("/runs/{i}/noise_delta_e2000")));
        assert!(many < few && calm < 0.5 * loud, "{variant}");
    }
}

/// Two approximations against the exact model.
fn approximations(samples: &str, reference: &str) -> Value {
    let args = ["--spp", samples, "--reference-spp", reference, "--models", "schlick,constant"];
    let usual = ["--adaptive", "off", "--dispersion", "on", "--lanes", "8", "--samplers", "sobol"];
    found(&[&args[..], &usual[..], &AMPLE[..]].concat())
}

#[test]
fn a_far_approximation_is_another_picture() {
    let found = approximations("4,1024", "4096");
    assert_eq!(variant(&found, "constant")["bias"]["verdict"], "different", "{found}");
    less_error_by_more_samples(&found);
}

#[test]
#[ignore = "long: 65,536 samples a pixel"]
fn what_is_another_picture_has_a_bias() {
    let found = approximations("4,16384", "65536");
    let bias = |label: &str| variant(&found, label)["bias"].clone();
    assert_eq!(bias("constant")["verdict"], "different", "{}", bias("constant"));
    // What a metal or a stone reflects at grazing angles is most of what `constant` gets wrong; `schlick` has the ends right. With four times
    // the samples ΔE is 0.324 and 0.109, three times as much: both intervals must allow that, and neither less than twice.
    let [constant, schlick] = ["constant", "schlick"].map(|label| array(&bias(label), "interval_95").to_vec());
    let end = |interval: &[Value], end: usize| interval[end].as_f64().expect("a number");
    assert!(end(&constant, 0) > 2.0 * end(&schlick, 1) && end(&constant, 1) > 3.0 * end(&schlick, 0), "{found}");
    let said: Vec<_> = array(&found, "findings").iter().filter_map(Value::as_str).collect();
    let constant = said.iter().find(|line| line.starts_with("constant instead of exact")).expect("a sentence");
    assert!(constant.contains("costs ΔE"), "{constant}");
    less_error_by_more_samples(&found);
}

#[test]
fn a_diamond_without_fire_is_another_one() {
    let diamond = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/diamond.toml");
    let folder = folder(&[]);
    let args =
        ["bench", diamond, "-q", "-o", "out", "--width", "20", "--spp", "16,256", "--models", "exact", "--lanes", "8"];
    run(
        folder.path(),
        &[&args[..], &["--samplers", "sobol", "--adaptive", "off", "--reference-spp", "64"], &AMPLE[..]].concat(),
    );
    let found = report(folder.path(), "out")["scenes"][0].clone();
    let flat = variant(&found, "no dispersion");
    assert_eq!(flat["bias"]["verdict"], "different", "{flat}");
    assert_eq!((array(&found, "variants").len(), &flat["dispersion"]), (2, &Value::Bool(false)));
}

/// The diamond's n_d, Sellmeier's formula of Peter (1923) as the library has it, is what every wavelength gets.
#[test]
fn without_dispersion_a_diamond_is_one_of_a_single_index() {
    let overrides = Overrides { samples: Some(8), without_dispersion: true, ..Overrides::default() };
    let flat = scene(SCENE, &overrides);
    let diamond = flat.media.iter().find(|medium| medium.name == "diamond").expect("a diamond");
    let n = flat.spectra.get(diamond.n).at(450.0);
    let usual = scene(SCENE, &Overrides { samples: Some(8), ..Overrides::default() });
    let dispersive = usual.media.iter().find(|medium| medium.name == "diamond").expect("a diamond");
    assert!(dispersive.dispersive && !diamond.dispersive);
    assert_eq!(n, usual.spectra.get(dispersive.n).at(spectrel::spectrum::HELIUM_D_NM));
    assert!((n - 2.4175).abs() < 5e-4, "{n}");
    let constant = scene(&flat_scene(), &Overrides { samples: Some(8), ..Overrides::default() });
    assert_eq!(film(&flat).pixels(), film(&constant).pixels());
    assert_ne!(film(&flat).pixels(), film(&usual).pixels());
}

/// The scene's diamond with one index at all wavelengths, as `--dispersion off` renders it.
fn flat_scene() -> String {
    let flat = scene(SCENE, &Overrides { samples: Some(1), without_dispersion: true, ..Overrides::default() });
    let diamond = flat.media.iter().find(|medium| medium.name == "diamond").expect("a diamond");
    let n = flat.spectra.get(diamond.n).at(450.0);
    SCENE.replace("material = \"diamond\"", "material = \"flat\"")
        + &format!("[materials.flat.dielectric]\nior = {{ n = {n:?}, k = 0 }}\n")
}

/// Every combination, the fewest changes first; and a combination is rendered as its name says: as the one that changes one thing less
/// in a scene that has the other change written down.
#[test]
fn a_product_has_all_combinations() {
    let folder = folder(&[("s.toml", SCENE), ("flat.toml", &flat_scene())]);
    run(folder.path(), &["render", "s.toml", "-q", "--spp", "64", "-o", "r.exr"]);
    let bench = |file: &str, more: &[&str]| {
        let args = ["bench", file, "-q", "-o", "out", "--force", "--spp", "4", "--reference", "r.exr"];
        run(folder.path(), &[&args[..], more, &AMPLE[..]].concat());
        report(folder.path(), "out")["scenes"][0].clone()
    };
    let axes = ["--models", "exact,schlick", "--lanes", "8,4", "--samplers", "sobol,independent", "--adaptive", "off"];
    let product = bench("s.toml", &[&axes[..], &["--dispersion", "on,off", "--product"]].concat());
    let labels: Vec<_> = array(&product, "variants").iter().filter_map(|v| v["label"].as_str()).collect();
    assert_eq!(labels[..5], ["exact, 8 lanes, sobol", "schlick", "4 lanes", "independent", "no dispersion"]);
    assert_eq!(
        (labels.len(), labels[5], labels[15]),
        (16, "schlick, 4 lanes", "schlick, 4 lanes, independent, no dispersion")
    );
    let changes = |variant: &Value| array(variant, "changes").len();
    assert!(array(&product, "variants").is_sorted_by_key(changes), "{labels:?}");
    let last = &product["variants"][15];
    assert_eq!(last["changes"], serde_json::json!(["model", "lanes", "sampler", "dispersion"]));
    assert_eq!(
        (&last["model"], &last["lanes"], &last["sampler"]),
        (&"schlick".into(), &4.into(), &"independent".into())
    );
    assert_eq!(last["dispersion"], Value::Bool(false));
    let said: Vec<_> = array(&product, "findings").iter().filter_map(Value::as_str).collect();
    assert!(said.iter().any(|line| line.starts_with("Of 11 ways that change several things at once")), "{said:?}");
    let single = bench("flat.toml", &axes);
    assert_eq!(array(&single, "variants").len(), 4);
    for (in_product, in_single) in [("schlick, no dispersion", "schlick"), ("4 lanes, no dispersion", "4 lanes")] {
        let mse = |found: &Value, label: &str| number(variant(found, label), "/runs/0/mse");
        assert_eq!(mse(&product, in_product), mse(&single, in_single), "{in_product}");
        assert_ne!(mse(&product, in_product), mse(&product, in_single), "{in_product}");
    }
    let page = fs::read_to_string(folder.path().join("out/bench.html")).expect("a page");
    assert!(page.contains("in one thing; each"));
}

/// A picture of our own as a reference, in either of the spaces it can be in: the same light, the same errors.
#[test]
fn a_reference_can_be_a_file() {
    let folder = folder(&[("s.toml", SCENE)]);
    let render = |more: &[&str]| run(folder.path(), &[&["render", "s.toml", "-q", "--spp", "1024"], more].concat());
    render(&["-o", "rgb.exr"]);
    render(&["--exr-xyz", "-o", "xyz.exr"]);
    let bench = |name: &str| {
        let args = [
            "bench",
            "s.toml",
            "-q",
            "-o",
            "out",
            "--force",
            "--spp",
            "16",
            "--models",
            "exact",
            "--adaptive",
            "off",
            "--dispersion",
            "on",
        ];
        run(folder.path(), &[&args[..], &["--reference", name], &AMPLE[..]].concat());
        report(folder.path(), "out")["scenes"][0].clone()
    };
    let [rgb, xyz] = ["rgb.exr", "xyz.exr"].map(bench);
    let errors = |found: &Value| {
        ["mse", "rel_mse", "delta_e2000"].map(|key| number(found, &format!("/variants/0/runs/0/{key}")))
    };
    for (a, b) in errors(&rgb).into_iter().zip(errors(&xyz)) {
        assert!((a / b - 1.0).abs() < 1e-3, "{rgb} {xyz}");
    }
    assert_eq!((rgb["reference"]["file"].as_str(), number(&rgb, "/reference/samples")), (Some("rgb.exr"), 1024.0));
    // A picture of the very scene is far nearer to the truth than sixteen samples are.
    assert!(number(&rgb, "/reference/mse") < 0.2 * errors(&rgb)[0], "{rgb}");
    assert!(rgb["variants"][0]["bias"].is_null() && rgb["variants"][1]["bias"].is_object(), "{rgb}");
    let said = refused(folder.path(), &["bench", "s.toml", "--reference", "rgb.exr", "--width", "8", "-o", "b"]);
    assert!(said.contains("--width 8") && said.contains("16 pixels wide"), "{said}");
    let said = refused(folder.path(), &["bench", "s.toml", "s.toml", "--reference", "rgb.exr", "-o", "b"]);
    assert!(said.contains("several"), "{said}");
    fs::write(folder.path().join("other.toml"), SCENE.replace("height = 16", "height = 12")).expect("a file");
    let said = refused(folder.path(), &["bench", "other.toml", "--reference", "rgb.exr", "-o", "b"]);
    assert!(said.contains("16 × 16 pixels, the scene 16 × 12"), "{said}");
    let said = refused(folder.path(), &["bench", "s.toml", "--reference", "s.toml", "-o", "b"]);
    assert!(said.contains("a reference is an .exr"), "{said}");
}

#[test]
fn time_is_kept_and_what_it_cost_is_told() {
    let folder = folder(&[("s.toml", SCENE)]);
    let started = Instant::now();
    run(folder.path(), &["bench", "s.toml", "-q", "-o", "out", "--time-budget", "3s"]);
    // A guard against one that never ends, not a measurement.
    assert!(started.elapsed() < Duration::from_secs(15), "{:?}", started.elapsed());
    // No machine renders anything in so little.
    run(folder.path(), &["bench", "s.toml", "-q", "-o", "none", "--time-budget", "0.001ms", "--spp", "2,4"]);
    let found = report(folder.path(), "none")["scenes"][0].clone();
    assert_eq!(array(&found, "variants").len(), 1);
    assert_eq!(array(&found["variants"][0], "runs").len(), 1);
    let left_out: Vec<_> = array(&found, "left_out").iter().filter_map(Value::as_str).collect();
    assert!(left_out.contains(&"schlick: no time for it"), "{left_out:?}");
    assert!(left_out.contains(&"4 samples a pixel: no time for them"), "{left_out:?}");
    let none = [
        "bench",
        "s.toml",
        "-q",
        "-o",
        "product",
        "--product",
        "--models",
        "schlick",
        "--samplers",
        "sobol",
        "--adaptive",
        "off",
    ];
    run(folder.path(), &[&none[..], &["--time-budget", "0.001ms", "--spp", "2"]].concat());
    let found = report(folder.path(), "product")["scenes"][0].clone();
    let left_out: Vec<_> = array(&found, "left_out").iter().filter_map(Value::as_str).collect();
    // Of two models, three numbers of lanes and dispersion or none: one change in 1 + 2 + 1 ways, three in 1 · 2 · 1, two in the rest.
    let two = "5 of 5 ways that change 2 things at once: no time for them";
    let three = "2 of 2 ways that change 3 things at once: no time for them";
    assert_eq!((left_out.len(), left_out[4], left_out[5]), (6, two, three), "{left_out:?}");
}

#[test]
fn what_cannot_be_is_refused() {
    let metal_only = SCENE.split("[[objects]]\nmaterial = \"diamond\"").next().expect("the beginning");
    let folder = folder(&[("s.toml", SCENE), ("metal.toml", metal_only), ("mine/notes.txt", "x")]);
    let refused = |args: &[&str]| refused(folder.path(), &[&["bench"], args].concat());
    let cases: [(&[&str], &[&str]); 12] = [
        (&["t.toml"], &["there is no file t.toml", "did you mean s.toml?"]),
        (&["s.toml", "--models", "schlik"], &["did you mean `schlick`?"]),
        (&["metal.toml", "--models", "cook-torrance"], &["cook-torrance", "gold"]),
        (&["s.toml", "--models", "f82,f82"], &["--models names one of its values twice"]),
        (&["s.toml", "--spp", "4,8,4"], &["--spp names 4 twice"]),
        (&["s.toml", "--lanes", "2"], &["1, 4 or 8"]),
        (&["s.toml", "--samplers", "halton"], &["sobol or independent"]),
        (&["s.toml", "--dispersion", "maybe"], &["dispersion is on or off"]),
        (&["s.toml", "--adaptive", "on"], &["samples are shared out for dE or rmse"]),
        (&["s.toml", "--dispersion", "off,off"], &["--dispersion names one of its values twice"]),
        (&["s.toml", "--time-budget", "soon"], &["expected a time"]),
        (&["s.toml", "-o", "mine", "--force"], &["no report of `spectrel bench`"]),
    ];
    for (args, parts) in cases {
        let said = refused(args);
        assert!(parts.iter().all(|part| said.contains(part)), "{args:?}: {said}");
    }
    let short = ["s.toml", "-q", "-o", "out", "--spp", "1", "--time-budget", "1ms"];
    run(folder.path(), &[&["bench"], &short[..]].concat());
    let said = refused(&short);
    assert!(said.contains("holds a report already") && said.contains("--force"), "{said}");
    run(folder.path(), &[&["bench"], &short[..], &["--force"]].concat());
}

#[test]
fn what_changes_nothing_is_not_rendered() {
    let metal_only = SCENE.split("[[objects]]\nmaterial = \"diamond\"").next().expect("the beginning");
    let folder = folder(&[("s.toml", metal_only)]);
    let args = [
        "bench",
        "s.toml",
        "-q",
        "-o",
        "out",
        "--spp",
        "1",
        "--models",
        "exact",
        "--lanes",
        "8",
        "--samplers",
        "sobol",
        "--adaptive",
        "off",
        "--threads",
        "3",
    ];
    run(folder.path(), &[&args[..], &AMPLE[..]].concat());
    assert_eq!(report(folder.path(), "out")["threads"], 3);
    let found = report(folder.path(), "out")["scenes"][0].clone();
    assert_eq!(array(&found, "variants").len(), 1);
    assert_eq!(array(&found, "left_out"), ["no dispersion: nothing in this scene has any"]);
}

/// What can be counted by hand: a sky alone takes one ray a sample; a grey floor under it takes one for what is met, and one more,
/// from there to the sky, for nothing else is to be met.
#[test]
fn rays_are_those_that_are_traced() {
    let head =
        SCENE.split("[materials").next().expect("the beginning").replace("look_at = [0, 0, 1]", "look_at = [0, 0, 0]");
    let floor = "[materials.white.diffuse]\nreflectance = 1\n[[objects]]\nmaterial = \"white\"\nshape.rectangle = { size = [4000, 4000] }\n";
    let away = floor.replace("size", "center = [0, 0, -9e5], size");
    let rays_a_sample = |objects: &str| {
        let scene = scene(&format!("{head}{objects}"), &Overrides { samples: Some(4), ..Overrides::default() });
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        one.install(|| {
            let before = spectrel::render::rays::traced();
            let film = film(&scene);
            (spectrel::render::rays::traced() - before) as f64 / film.samples() as f64
        })
    };
    assert_eq!(rays_a_sample(&away.replace("4000", "1")), 1.0);
    assert_eq!(rays_a_sample(floor), 2.0);
}
