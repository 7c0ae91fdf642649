//! `spectrel fresnel`: the Fresnel equations and their approximations by themselves, without a scene.

mod curve;
mod errors;
mod eval;
mod numbers;
mod subjects;

use super::show;
use crate::image::atomic;
use crate::scene::SceneError;
use clap::{Args, Subcommand};
use std::path::Path;

#[derive(Debug, Args)]
pub struct FresnelArgs {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Reflectance of materials against angle or wavelength, exact and by approximations
    Curve(curve::CurveArgs),
    /// How far each approximation is from the exact equations, in reflectance and in colour, and what it costs
    Errors(errors::ErrorsArgs),
    /// Reflectances and phases for every row of a table of n1, n2, k2 and cos_i
    Eval(eval::EvalArgs),
}

pub fn run(args: &FresnelArgs) -> Result<(), SceneError> {
    match &args.command {
        Command::Curve(args) => curve::run(args),
        Command::Errors(args) => errors::run(args),
        Command::Eval(args) => eval::run(args),
    }
}

/// An answer of whole lines, to a file or to standard output.
fn deliver(text: &str, output: Option<&Path>) -> Result<(), SceneError> {
    match output {
        Some(path) => atomic::write(path, text.as_bytes()).map_err(SceneError::new),
        None => {
            show::answer(text.trim_end_matches('\n'));
            Ok(())
        }
    }
}
