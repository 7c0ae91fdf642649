//! `--watch`: the scene is rendered again when one of its files changes.
//!
//! Watched are the scene, the files of a user's materials, and every file that a quoted word in them names: tables, pages, meshes
//! and pictures alike, without asking what each is for, and in a scene that is broken too. A change during a render ends
//! it and begins the next; what is broken is told, and the watch goes on.
//!
//! Files are asked for time and size some times a second. That costs a few system calls, works on network drives, and does not
//! mind editors that write a new file and rename it over the old one; notifications from the system would need a crate
//! with a backend for each system, and would lose a file that is renamed unless its folder is watched instead.

use crate::cli::interrupt::Interrupt;
use crate::cli::show;
use crate::scene::{SceneError, Text};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant, SystemTime};

/// Between two looks at the files.
const PAUSE: Duration = Duration::from_millis(150);

/// So long a scene may be missing while an editor replaces it.
const GAP: Duration = Duration::from_secs(1);

/// When a file was written, and its size; `None` if it is not there.
type Stamp = Option<(SystemTime, u64)>;

fn stamp(path: &Path) -> Stamp {
    let metadata = std::fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

/// Files as they were when they were read.
#[derive(Debug)]
struct Watched {
    files: BTreeMap<PathBuf, Stamp>,
}

impl Watched {
    /// A scene file and what it names.
    fn new(scene: &Path) -> Self {
        // Before it is read: a change right after it must not go unseen.
        let mut watched = Self { files: BTreeMap::from([(scene.to_owned(), stamp(scene))]) };
        if let Ok(content) = std::fs::read_to_string(scene) {
            watched.add(&Text::new(scene, content));
        }
        watched
    }

    /// A text's own file, if it has one, and the files that it names.
    fn add(&mut self, text: &Text) {
        let named = text.content.split(['"', '\'', '\n']).filter(|word| !word.is_empty());
        let paths = std::iter::once(text.path.clone()).chain(named.map(|word| text.base().join(word)));
        for path in paths {
            self.watch(path);
        }
    }

    /// A file, and what a glTF file names in turn. What is not there yet may come, if its name has an extension.
    fn watch(&mut self, path: PathBuf) {
        if !(path.is_file() || path.extension().is_some_and(|extension| extension.len() <= 5)) || path.is_dir() {
            return;
        }
        if self.files.contains_key(&path) {
            return;
        }
        self.files.insert(path.clone(), stamp(&path));
        if path.extension().is_some_and(|extension| extension == "gltf")
            && let Ok(content) = std::fs::read_to_string(&path)
        {
            self.add(&Text::new(&path, content));
        }
    }

    fn changed(&self) -> Option<&Path> {
        self.files.iter().find(|(path, then)| stamp(path) != **then).map(|(path, _)| path.as_path())
    }
}

/// Renders, waits for a change, and renders again until people end it. `render` tells of the texts that it has read.
pub fn run(
    scene: &Path,
    interrupt: &Interrupt,
    quiet: bool,
    mut render: impl FnMut(&dyn Fn(&[Text])) -> Result<(), SceneError>,
) {
    loop {
        let watched = Mutex::new(Watched::new(scene));
        let read = |texts: &[Text]| {
            if let Ok(mut watched) = watched.lock() {
                texts.iter().for_each(|text| watched.add(text));
            }
        };
        while_watching(&watched, interrupt, || render(&read)).unwrap_or_else(show::error);
        let watched = watched.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
        if !quiet && !interrupt.stopped() {
            let there = watched.files.values().flatten().count();
            show::note(format_args!("watching {}; Ctrl-C ends", counted(there)));
        }
        let Some(changed) = wait(&watched, interrupt) else { return };
        settle(scene);
        if !quiet {
            show::note(format_args!("{} has changed", changed.display()));
        }
        interrupt.rearm();
    }
}

fn counted(files: usize) -> String {
    if files == 1 { "1 file".into() } else { format!("{files} files") }
}

/// Does something that ends early if a file changes meanwhile.
fn while_watching<T>(watched: &Mutex<Watched>, interrupt: &Interrupt, work: impl FnOnce() -> T) -> T {
    let (done, ended) = mpsc::channel::<()>();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            while ended.recv_timeout(PAUSE) == Err(RecvTimeoutError::Timeout) {
                if watched.lock().is_ok_and(|watched| watched.changed().is_some()) {
                    return interrupt.restart();
                }
            }
        });
        let result = work();
        drop(done);
        result
    })
}

/// The file that changed, or `None` when people end the program.
fn wait(watched: &Watched, interrupt: &Interrupt) -> Option<PathBuf> {
    loop {
        if interrupt.pressed() {
            return None;
        }
        if let Some(changed) = watched.changed() {
            return Some(changed.to_owned());
        }
        std::thread::sleep(PAUSE);
    }
}

/// Waits until a scene is there and nobody is writing it.
fn settle(scene: &Path) {
    let started = Instant::now();
    let mut before = stamp(scene);
    loop {
        std::thread::sleep(PAUSE);
        let now = stamp(scene);
        if now == before && (now.is_some() || started.elapsed() > GAP) {
            return;
        }
        before = now;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn files_that_a_scene_names_are_watched() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::create_dir(path("data")).unwrap();
        fs::write(path("data/n.csv"), "").unwrap();
        fs::write(path("stone.obj"), "").unwrap();
        fs::write(path("a.toml"), "ior = \"data/n.csv\"\nmesh = { file = 'stone.obj' }\nmaterial = \"gold\"\n[[broken")
            .unwrap();
        let watched = Watched::new(&path("a.toml"));
        assert_eq!(watched.files.values().flatten().count(), 3, "{watched:?}");
        assert_eq!(watched.changed(), None);
        fs::write(path("data/n.csv"), "longer").unwrap();
        assert_eq!(watched.changed(), Some(path("data/n.csv").as_path()));
        assert_eq!(Watched::new(&path("none.toml")).changed(), None, "what is not there has not changed");
        fs::remove_file(path("a.toml")).unwrap();
        assert_eq!(watched.changed(), Some(path("a.toml").as_path()));
        fs::write(path("b.toml"), "file = \"b.gltf\"\n'later.csv'\nprice = \"0.5\"").unwrap();
        fs::write(path("b.gltf"), "{ \"buffers\": [{ \"uri\": \"b.bin\" }] }").unwrap();
        fs::write(path("b.bin"), "").unwrap();
        let watched = Watched::new(&path("b.toml"));
        assert_eq!(watched.changed(), None);
        fs::write(path("later.csv"), "").unwrap();
        assert_eq!(watched.changed(), Some(path("later.csv").as_path()), "what was missing has come");
        fs::remove_file(path("later.csv")).unwrap();
        fs::write(path("b.bin"), "longer").unwrap();
        assert_eq!(watched.changed(), Some(path("b.bin").as_path()), "buffers of a glTF file");
    }
}
