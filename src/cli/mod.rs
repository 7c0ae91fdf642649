//! The command line: what all commands share; `commands` has one file or folder a command.
//!
//! - `scene_file`, `settings`, `effort`, `subjects`, `threads`: options that several commands have, and what they stand for.
//! - `picture`: how a scene is developed, and what determines its picture.
//! - `folder`, `tables`: files that are written and read; `memory`: whether a picture fits.
//! - `show`, `progress`, `interrupt`: what people see, and how they end it.

mod commands;
mod effort;
mod folder;
mod interrupt;
mod memory;
mod picture;
mod progress;
mod scene_file;
mod settings;
mod show;
mod subjects;
mod tables;
mod threads;

use crate::scene::SceneError;
use crate::spectrum::nearest;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, Parser, Subcommand};
use commands::{bench, compare, f0, fresnel, inspect, list, render};
use std::process::ExitCode;

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
