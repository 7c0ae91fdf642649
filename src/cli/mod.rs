//! The command line: one file a command.

mod bench;
mod compare;
mod effort;
mod f0;
mod folder;
mod fresnel;
mod inspect;
mod interrupt;
mod job;
mod layers;
mod list;
mod memory;
mod preview;
mod progress;
mod render;
mod settings;
mod show;
mod subjects;
mod tables;
mod threads;
mod watch;

use crate::scene::{SceneError, Text};
use crate::spectrum::{Library, nearest};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Args, CommandFactory, Parser, Subcommand};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The scene that is rendered when none is named.
const DEFAULT_SCENE: (&str, &str) = ("spectrel.toml", include_str!("../../scenes/tray.toml"));

/// Predicts how metals and gems look from measured spectra.
#[derive(Debug, Parser)]
#[command(version, after_help = AFTER_HELP, args_conflicts_with_subcommands = true, max_term_width = 110)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    render: render::RenderArgs,
}

const AFTER_HELP: &str = "\
Examples:
  spectrel                                  the built-in scene, into spectrel.png and spectrel.exr
  spectrel ring.toml -o ring.png --spp 512  a scene of your own
  spectrel inspect ring.toml                what it contains, and which data it stands on
  spectrel list materials                   what `material = \"…\"` can name

Ctrl-C ends a render early and writes what there is.";

#[derive(Debug, Subcommand)]
enum Command {
    /// Render a scene (this is what spectrel does without a command)
    Render(render::RenderArgs),
    /// Show what a scene contains, which physics it needs and why, and which data it uses
    Inspect(inspect::InspectArgs),
    /// List the materials, spectra or illuminants that scenes can name, with their sources
    List(list::ListArgs),
    /// Render variants of a scene with the same random numbers, and report how far they are apart
    Compare(compare::CompareArgs),
    /// Report the speed of a scene's render against its error, by model, lanes, sampler, dispersion and samples
    Bench(bench::BenchArgs),
    /// Colours of materials at normal incidence and beyond, with their sources, as tables for people and engines
    F0(f0::F0Args),
    /// The Fresnel equations by themselves, without a scene
    Fresnel(fresnel::FresnelArgs),
}

/// Where a scene and its data come from.
#[derive(Clone, Debug, Args)]
struct SceneArgs {
    /// Scene file (TOML) [default: a built-in jeweller's tray]
    scene: Option<PathBuf>,
    #[command(flatten)]
    library: LibraryArgs,
}

#[derive(Clone, Debug, Args)]
struct LibraryArgs {
    /// Folder with your own `spectra/ior/…` and `materials/`, searched before the built-in ones; can be repeated (docs/data-files.md)
    #[arg(long, value_name = "DIR")]
    library: Vec<PathBuf>,
}

impl LibraryArgs {
    fn open(&self) -> Result<Library, SceneError> {
        if let Some(missing) = self.library.iter().find(|folder| !folder.is_dir()) {
            return Err(SceneError::new(format!("--library {}: no such folder", missing.display())));
        }
        Ok(Library::new(self.library.clone()))
    }
}

impl SceneArgs {
    fn read(&self) -> Result<Text, SceneError> {
        scene_text(self.scene.as_deref(), DEFAULT_SCENE)
    }
}

/// A scene file, or a built-in one.
fn scene_text(path: Option<&Path>, (name, content): (&str, &str)) -> Result<Text, SceneError> {
    path.map_or_else(|| Ok(Text::new(name, content)), read_text)
}

/// What is made of a scene is called after its file, unless it is named.
fn scene_name(path: Option<&Path>) -> String {
    path.and_then(Path::file_stem).unwrap_or("spectrel".as_ref()).to_string_lossy().into_owned()
}

/// An option's `MATERIAL=NAME`.
fn pair(text: &str) -> Result<(String, String), String> {
    match text.split_once('=').map(|(material, name)| (material.trim(), name.trim())) {
        Some((material, name)) if !material.is_empty() && !name.is_empty() => Ok((material.into(), name.into())),
        _ => Err("expected a material, `=` and a name, such as gold=silver".into()),
    }
}

/// Larger files are no scenes.
const LARGEST_SCENE: u64 = 64 << 20;

/// A file that should hold a scene: a folder, too large a file or one that is no text is told apart from a missing one.
fn read_text(path: &Path) -> Result<Text, SceneError> {
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

/// What is wrong with words that follow a scene: the first was to be a command, or they are scenes, too.
fn surplus(error: &clap::Error) -> Option<SceneError> {
    let context = error.get(ContextKind::InvalidSubcommand).or(error.get(ContextKind::InvalidArg));
    let Some(ContextValue::String(second)) = context else { return None };
    let words = || std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    let kinds = [ErrorKind::UnknownArgument, ErrorKind::ArgumentConflict];
    if !kinds.contains(&error.kind()) || second.starts_with('-') || second.starts_with('<') {
        return None;
    }
    let first = words().next().filter(|first| !first.starts_with('-'))?;
    let cli = Cli::command();
    let known = || cli.get_subcommands().map(clap::Command::get_name);
    let scene = |word: &str| word.ends_with(".toml");
    if known().all(|command| command != first) && !scene(&first) {
        let error = SceneError::new(format!("there is no command `{first}`"));
        return Some(match nearest(&first, known()) {
            Some(command) => error.help(format!("did you mean `spectrel {command} {second}`?")),
            None => error.help(format!("the commands are {}", known().collect::<Vec<_>>().join(", "))),
        });
    }
    let rendered = words().find(|word| scene(word) && word != second)?;
    let message = format!("one scene at a time: `{rendered}`, and then `{second}` by itself");
    scene(second).then(|| SceneError::new(message))
}

/// Parses the command line, runs it, prints one error if there is one.
pub fn main() -> ExitCode {
    let cli = Cli::try_parse().unwrap_or_else(|error| match surplus(&error) {
        Some(error) => {
            show::error(&error);
            std::process::exit(2);
        }
        None => error.exit(),
    });
    let outcome = match cli.command {
        None => render::run(&cli.render),
        Some(Command::Render(args)) => render::run(&args),
        Some(Command::Inspect(args)) => inspect::run(&args),
        Some(Command::List(args)) => list::run(&args),
        Some(Command::Compare(args)) => compare::run(&args),
        Some(Command::Bench(args)) => bench::run(&args),
        Some(Command::F0(args)) => f0::run(&args),
        Some(Command::Fresnel(args)) => fresnel::run(&args),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            show::error(&error);
            ExitCode::from(2)
        }
    }
}
