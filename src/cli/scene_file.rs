//! Where scenes and their data come from, and what is told of a file that is none.

use super::Cli;
use crate::scene::{SceneError, Text};
use crate::spectrum::{Library, nearest};
use clap::{Args, CommandFactory};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The scene that is rendered when none is named.
const DEFAULT_SCENE: (&str, &str) = ("spectrel.toml", include_str!("../../scenes/tray.toml"));

/// Where a scene and its data come from.
#[derive(Clone, Debug, Args)]
pub struct SceneArgs {
    /// Scene file (TOML) [default: a built-in jeweller's tray]
    pub scene: Option<PathBuf>,
    #[command(flatten)]
    pub library: LibraryArgs,
}

#[derive(Clone, Debug, Args)]
pub struct LibraryArgs {
    /// Folder with your own `spectra/ior/…` and `materials/`, searched before the built-in ones; can be repeated (docs/data-files.md)
    #[arg(long, value_name = "DIR")]
    pub library: Vec<PathBuf>,
}

impl LibraryArgs {
    pub fn open(&self) -> Result<Library, SceneError> {
        if let Some(missing) = self.library.iter().find(|folder| !folder.is_dir()) {
            return Err(SceneError::new(format!("--library {}: no such folder", missing.display())));
        }
        Ok(Library::new(self.library.clone()))
    }
}

impl SceneArgs {
    pub fn read(&self) -> Result<Text, SceneError> {
        scene_text(self.scene.as_deref(), DEFAULT_SCENE)
    }
}

/// A scene file, or a built-in one.
pub fn scene_text(path: Option<&Path>, (name, content): (&str, &str)) -> Result<Text, SceneError> {
    path.map_or_else(|| Ok(Text::new(name, content)), read_text)
}

/// What is made of a scene is called after its file, unless it is named.
pub fn scene_name(path: Option<&Path>) -> String {
    path.and_then(Path::file_stem).unwrap_or("spectrel".as_ref()).to_string_lossy().into_owned()
}

/// An option's `MATERIAL=NAME`.
pub fn pair(text: &str) -> Result<(String, String), String> {
    match text.split_once('=').map(|(material, name)| (material.trim(), name.trim())) {
        Some((material, name)) if !material.is_empty() && !name.is_empty() => Ok((material.into(), name.into())),
        _ => Err("expected a material, `=` and a name, such as gold=silver".into()),
    }
}

/// Larger files are no scenes.
const LARGEST_SCENE: u64 = 64 << 20;

/// A file that should hold a scene: a folder, too large a file or one that is no text is told apart from a missing one.
pub fn read_text(path: &Path) -> Result<Text, SceneError> {
    let shown = path.display();
    if path.is_dir() {
        return Err(SceneError::new(format!("{shown} is a folder, not a scene file")));
    }
    let mut bytes = Vec::new();
    // A device or a pipe has no size to ask for and may never end.
    let read = File::open(path).and_then(|file| file.take(LARGEST_SCENE + 1).read_to_end(&mut bytes));
    read.map_err(|error| unreadable(path, &error))?;
    if bytes.len() as u64 > LARGEST_SCENE {
        return Err(SceneError::new(format!(
            "{shown} is too large: a scene is a text file of at most {} MB",
            LARGEST_SCENE >> 20
        )));
    }
    String::from_utf8(bytes).map(|content| Text::new(path, content)).map_err(|error| {
        let (before, _) = error.as_bytes().split_at(error.utf8_error().valid_up_to());
        let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
        SceneError::new(format!("{shown}:{line}: this is no text: byte {} of the file is not UTF-8", before.len() + 1))
            .help("a scene is a TOML text file")
    })
}

fn unreadable(path: &Path, error: &io::Error) -> SceneError {
    if error.kind() != io::ErrorKind::NotFound {
        return SceneError::new(format!("cannot read {}: {error}", path.display()));
    }
    let missing = SceneError::new(format!("there is no file {}", path.display()));
    match meant(path) {
        Some(name) => missing.help(format!("did you mean {name}?")),
        None => missing,
    }
}

/// The scene file of the same folder, or the command, that a missing file's name is most like.
fn meant(path: &Path) -> Option<String> {
    let name = path.file_name()?.to_str()?;
    if path.extension().is_none() {
        let cli = Cli::command();
        let command = nearest(name, cli.get_subcommands().map(clap::Command::get_name));
        return command.map(|command| format!("the command `{command}`"));
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let names = std::fs::read_dir(folder).ok()?.flatten().filter_map(|entry| entry.file_name().into_string().ok());
    let scenes: Vec<_> = names.filter(|name| name.ends_with(".toml")).collect();
    nearest(name, scenes.iter().map(String::as_str)).map(|scene| path.with_file_name(scene).display().to_string())
}
