//! Bad input ends with exit code 2, one error in plain words at its line and column, and nothing written.
//!
//! Where an error is expected at a place, the scene holds the mark `§` right before it; it is removed before the run.

mod files;
mod meshes;
mod pictures;
mod scenes;
mod wounded;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

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
