//! The command line: one file a command.

mod inspect;
mod list;
mod progress;
mod render;
mod show;

use crate::scene::{SceneError, Text};
use crate::spectrum::Library;
use clap::{Args, Parser, Subcommand};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The scene that is rendered when none is named.
const DEFAULT_SCENE: (&str, &str) = ("spectrel.toml", include_str!("../../scenes/tray.toml"));

/// Predicts how metals and gems look from measured spectra.
#[derive(Debug, Parser)]
#[command(version, about, long_about = LONG_ABOUT, args_conflicts_with_subcommands = true, max_term_width = 110)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    render: render::RenderArgs,
}

const LONG_ABOUT: &str = "Predicts how metals and gems look from measured spectra.\n\n\
    Paths carry eight wavelengths, interfaces use the exact Fresnel equations with measured n and k, and colours go \
    through the CIE observers. Scenes and materials are TOML files.\n\n\
    Without a command spectrel renders its default scene into spectrel.png and spectrel.exr.";

#[derive(Debug, Subcommand)]
enum Command {
    /// Render a scene (this is what spectrel does without a command)
    Render(render::RenderArgs),
    /// Show what a scene contains, which physics it needs and why, and which data it uses
    Inspect(inspect::InspectArgs),
    /// List the materials, spectra or illuminants that scenes can name, with their sources
    List(list::ListArgs),
}

/// Where a scene and its data come from.
#[derive(Clone, Debug, Args)]
struct SceneArgs {
    /// Scene file (TOML); the built-in jeweller's tray unless given
    scene: Option<PathBuf>,
    #[command(flatten)]
    library: LibraryArgs,
}

#[derive(Clone, Debug, Args)]
struct LibraryArgs {
    /// Folder with own `spectra/` and `materials/`, searched before the built-in ones (can be repeated)
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
        let Some(path) = &self.scene else { return Ok(Text::new(DEFAULT_SCENE.0, DEFAULT_SCENE.1)) };
        read_text(path)
    }
}

/// A file that should hold a scene: too large a one, or one that is no text, is told apart from a missing one.
fn read_text(path: &Path) -> Result<Text, SceneError> {
    const LARGEST: u64 = 64 << 20;
    let unreadable = |error: std::io::Error| SceneError::new(format!("cannot read {}: {error}", path.display()));
    let size = std::fs::metadata(path).map_err(unreadable)?.len();
    if size > LARGEST {
        return Err(SceneError::new(format!(
            "{} is {} MB: a scene is a text file of at most 64 MB",
            path.display(),
            size >> 20
        )));
    }
    let bytes = std::fs::read(path).map_err(unreadable)?;
    match String::from_utf8(bytes) {
        Ok(content) => Ok(Text::new(path, content)),
        Err(error) => {
            let at = error.utf8_error().valid_up_to();
            Err(SceneError::new(format!("{} is no text: byte {at} is not UTF-8", path.display()))
                .help("a scene is a TOML file; `spectrel list` and the README show how it looks"))
        }
    }
}

/// Parses the command line, runs it, prints one error if there is one.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    let outcome = match cli.command {
        None => render::run(&cli.render),
        Some(Command::Render(args)) => render::run(&args),
        Some(Command::Inspect(args)) => inspect::run(&args),
        Some(Command::List(args)) => list::run(&args),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            show::error(&error);
            ExitCode::from(2)
        }
    }
}
