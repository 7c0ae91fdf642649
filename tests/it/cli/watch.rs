//! `--watch`: files are edited, pictures follow; what is broken is told; an interrupt ends it.
#![cfg(target_os = "linux")]

use crate::common::command::{command, folder, refused};
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

const SCENE: &str = r#"
render = { width = 6, height = 4, samples = 4 }
camera = { position = [0, -10, 0], look_at = [0, 0, 0], fov = 25 }
environment.constant = { spectrum = "D50", luminance = 100 }
materials.m.conductor.ior = "data/own.csv"
[[objects]]
material = "m"
shape.sphere = { radius = 3 }
"#;

const DATA: &str = "wavelength_nm,n,k\n300,0.2,4\n900,0.2,4\n";

/// Long enough for a busy machine; a test that passes never waits for it.
const PATIENCE: Duration = Duration::from_secs(60);

struct Watch {
    child: Child,
    lines: Receiver<String>,
}

impl Watch {
    fn start(folder: &Path, args: &[&str]) -> Self {
        let mut child = command(folder, args).stderr(Stdio::piped()).spawn().expect("spectrel runs");
        let stderr = BufReader::new(child.stderr.take().expect("piped"));
        let (sender, lines) = channel();
        std::thread::spawn(move || stderr.lines().map_while(Result::ok).try_for_each(|line| sender.send(line)));
        Self { child, lines }
    }

    /// Waits for a line with these words.
    fn says(&self, words: &str) {
        let mut said = Vec::new();
        while let Ok(line) = self.lines.recv_timeout(PATIENCE) {
            if line.contains(words) {
                return;
            }
            said.push(line);
        }
        panic!("{words:?} was not said, but\n{}", said.join("\n"));
    }

    /// Ctrl-C; gives the status.
    fn interrupt(mut self) -> Option<i32> {
        let kill = Command::new("kill").args(["-INT", &self.child.id().to_string()]).status().expect("kill runs");
        assert!(kill.success());
        self.child.wait().expect("it ends").code()
    }
}

impl Drop for Watch {
    /// A test that fails must not leave it running.
    fn drop(&mut self) {
        let _ = self.child.kill();
    }
}

/// As careful editors save: a new file, renamed over the old one.
fn save(path: &Path, content: &str) {
    let beside = path.with_extension("new");
    fs::write(&beside, content).expect("a file");
    fs::rename(&beside, path).expect("renamed");
}

#[test]
fn pictures_follow_edits_and_errors_do_not_end_it() {
    let folder = folder(&[("a.toml", SCENE), ("data/own.csv", DATA)]);
    let (scene, data) = (folder.path().join("a.toml"), folder.path().join("data/own.csv"));
    let picture = || fs::read(folder.path().join("a.png")).expect("a picture");
    let watch = Watch::start(folder.path(), &["a.toml", "--watch", "-o", "a.png"]);
    watch.says("wrote a.png");
    watch.says("watching 2 files");
    let first = picture();

    save(&scene, &SCENE.replace("luminance = 100", "luminance = 50, luminance = 60"));
    watch.says("a.toml has changed");
    watch.says("error: a.toml:4:");
    watch.says("watching 2 files");
    assert!(picture() == first, "a broken scene leaves the picture");

    save(&scene, &SCENE.replace("radius = 3", "radius = 1"));
    watch.says("wrote a.png");
    watch.says("watching");
    let second = picture();
    assert!(second != first);

    fs::write(&data, DATA.replace("0.2,4", "0.9,3.25")).expect("a file");
    watch.says("own.csv has changed");
    watch.says("wrote a.png");
    watch.says("watching");
    assert!(picture() != second);

    fs::remove_file(&scene).expect("removed");
    watch.says("error: there is no file a.toml");
    fs::write(&scene, SCENE).expect("a file");
    watch.says("wrote a.png");
    watch.says("watching");
    assert_eq!(watch.interrupt(), Some(0));
}

#[test]
fn a_change_ends_the_render_that_runs() {
    // The warning of a material that is not used comes right before a render that would take for ever.
    let endless = SCENE.replace("samples = 4", "samples = 100000000");
    let endless = endless.replace("[[objects]]", "materials.idle.diffuse.reflectance = 0.5\n[[objects]]");
    let folder = folder(&[("a.toml", &endless), ("data/own.csv", DATA)]);
    let watch = Watch::start(folder.path(), &["a.toml", "--watch", "-o", "a.png"]);
    watch.says("warning: ");
    save(&folder.path().join("a.toml"), SCENE);
    watch.says("a.toml has changed");
    watch.says("4 samples each");
    watch.says("wrote a.png");
    assert_eq!(watch.interrupt(), Some(0));
}

#[test]
fn the_built_in_scene_cannot_change() {
    let folder = folder(&[]);
    assert!(refused(folder.path(), &["--watch"]).contains("--watch needs a scene file"));
}
