//! Layers and bands in the files that `spectrel render` writes.

use crate::common::command::{folder, refused, run};
use exr::prelude::{FlatSamples, MetaData, ReadChannels, ReadLayers, read};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

const SCENE: &str = r#"
render = { width = 6, height = 4, samples = 16, filter = "box" }
camera = { position = [0, -10, 0], look_at = [0, 0, 0], fov = 25 }
picture = { exposure = 7 }
environment.constant = { spectrum = "D50", luminance = 100 }
[[objects]]
name = "ball"
material = "gold"
shape.sphere = { radius = 1.5 }
"#;

/// The channels of an EXR file by name, and its text attributes.
fn read_exr(path: &Path) -> (BTreeMap<String, FlatSamples>, BTreeMap<String, String>) {
    let read = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer().all_attributes();
    let image = read.from_file(path).expect("an EXR");
    let channels = image.layer_data.channel_data.list.into_iter();
    let channels = channels.map(|channel| (channel.name.to_string(), channel.sample_data)).collect();
    let texts = MetaData::read_from_file(path, true).expect("a header").headers[0].own_attributes.other.clone();
    let texts =
        texts.into_iter().filter_map(|(name, value)| Some((name.to_string(), value.to_text().ok()?.to_string())));
    (channels, texts.collect())
}

fn names(channels: &BTreeMap<String, FlatSamples>) -> Vec<&str> {
    channels.keys().map(String::as_str).collect()
}

fn values(samples: &FlatSamples) -> Vec<f32> {
    samples.values_as_f32().collect()
}

#[test]
fn aovs_are_layers_of_the_exr() {
    let folder = folder(&[("a.toml", SCENE)]);
    run(folder.path(), &["a.toml", "-q", "--aovs", "all", "-o", "a.exr", "-o", "a.png"]);
    let (channels, texts) = read_exr(&folder.path().join("a.exr"));
    let expected = "B G R albedo.B albedo.G albedo.R depth.Z noise.dE normal.X normal.Y normal.Z object.id samples.N variance.B variance.G variance.R";
    assert_eq!(names(&channels), expected.split(' ').collect::<Vec<_>>());
    let at = |name: &str, place: usize| values(&channels[name])[place];
    // The middle of the ball, and a corner that sees nothing.
    let middle = 2 * 6 + 3;
    assert_eq!((at("object.id", middle), at("object.id", 0)), (1.0, 0.0));
    assert!((at("depth.Z", middle) - 8.5).abs() < 0.1 && at("depth.Z", 0) == 1e10);
    assert!(at("normal.Y", middle) < -0.9 && at("normal.Y", 0) == 0.0);
    assert!(at("albedo.R", middle) > 0.99 && at("albedo.B", middle) < 0.4 && at("albedo.R", 0) == 0.0);
    assert!(["variance.R", "variance.G", "variance.B"].iter().all(|name| at(name, middle) > 0.0));
    assert!(texts["spectrel:objects"].contains("[\"ball\"]"));
}

#[test]
fn some_aovs_leave_the_picture_as_it_is() {
    let folder = folder(&[("a.toml", SCENE)]);
    let picture = |args: &[&str]| {
        run(folder.path(), &[&["a.toml", "-q", "-o", "a.exr"], args].concat());
        read_exr(&folder.path().join("a.exr")).0
    };
    let plain = picture(&[]);
    for (args, more) in [
        (&["--aovs", "depth,object"] as &[&str], vec!["depth.Z", "object.id"]),
        (&["--aovs", "normal"], vec!["normal.X", "normal.Y", "normal.Z"]),
        (&["--denoise-inputs"], vec!["albedo.B", "albedo.G", "albedo.R", "normal.X", "normal.Y", "normal.Z"]),
    ] {
        let with = picture(args);
        assert_eq!(names(&with), [vec!["B", "G", "R"], more].concat());
        assert!(["R", "G", "B"].iter().all(|name| with[*name] == plain[*name]), "{args:?}");
    }
    let half = picture(&["--exr-half", "--aovs", "albedo,depth"]);
    assert!(matches!((&half["R"], &half["albedo.R"]), (FlatSamples::F16(_), FlatSamples::F16(_))));
    assert!(matches!(half["depth.Z"], FlatSamples::F32(_)), "16 bits would cut distances");
    let xyz = picture(&["--exr-xyz", "--aovs", "albedo,variance"]);
    let middle = |name: &str| values(&xyz[name])[15];
    assert!(middle("albedo.R") < 0.95 && middle("albedo.G") > middle("albedo.B"), "XYZ of gold");
}

#[test]
fn bands_follow_the_published_layout() {
    let folder = folder(&[("a.toml", SCENE)]);
    run(folder.path(), &["a.toml", "-q", "-o", "a.spectral.exr", "-o", "b.exr"]);
    let (channels, texts) = read_exr(&folder.path().join("a.spectral.exr"));
    let expected: Vec<String> = (0..41).map(|i| format!("S0.{},000000nm", 380 + 10 * i)).collect();
    assert_eq!(names(&channels), [vec!["B", "G", "R"], expected.iter().map(String::as_str).collect()].concat());
    assert_eq!((texts["spectralLayoutVersion"].as_str(), texts["emissiveUnits"].as_str()), ("1.0", "W.m^-2.sr^-1"));
    assert_eq!(texts["spectrel:bands"], "380:10:780 nm");
    assert!(texts["spectrel:spectral-unit"].contains("nm^-1"));
    let (plain, _) = read_exr(&folder.path().join("b.exr"));
    assert_eq!(names(&plain), ["B", "G", "R"]);
    assert!(["R", "G", "B"].iter().all(|name| plain[*name] == channels[*name]));
    run(folder.path(), &["a.toml", "-q", "--exr-half", "--spectral", "532.25:0.5:533.25", "-o", "A.Spectral.EXR"]);
    let (channels, _) = read_exr(&folder.path().join("A.Spectral.EXR"));
    assert_eq!(names(&channels)[3..], ["S0.532,250000nm", "S0.532,750000nm", "S0.533,250000nm"]);
    assert!(matches!(channels["S0.532,250000nm"], FlatSamples::F32(_)));
}

#[test]
fn what_has_no_file_to_go_into_is_refused_before_rendering() {
    let folder = folder(&[("a.toml", SCENE)]);
    let refused = |args: &[&str]| refused(folder.path(), &[&["a.toml"], args].concat());
    for args in [&["--aovs", "depth", "-o", "a.png"] as &[&str], &["--aovs", "all", "-o", "a.spectral.exr"]] {
        let message = refused(args);
        assert!(message.contains("--aovs") && message.contains("add -o picture.exr"), "{message}");
    }
    assert!(refused(&["--denoise-inputs", "-o", "a.png"]).contains("--denoise-inputs"));
    assert!(refused(&["--spectral", "400:10:700", "-o", "a.exr"]).contains("add -o picture.spectral.exr"));
    assert!(refused(&["--spectral", "300:10:700", "-o", "a.spectral.exr"]).contains("beyond 360–830 nm"));
    assert!(refused(&["--aovs", "colour"]).contains("albedo, normal, depth, variance, noise, object, all"));
    assert!(refused(&["--aovs", "variance", "--spp", "7"]).contains("--spp 8"));
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 1, "nothing but the scene");
}

#[cfg(target_os = "linux")]
#[test]
fn bands_count_when_memory_is_checked() {
    let folder = folder(&[("a.toml", SCENE)]);
    // 24 million pixels are 5 GB, with 2048 bands 1.4 TB.
    let args = ["a.toml", "--width", "6000", "--spectral", "400:0.2:700", "-o", "a.spectral.exr"];
    assert!(refused(folder.path(), &args).contains("of memory"));
}
