//! `spectrel fresnel`: the Fresnel equations and their approximations by themselves, without a scene.

mod curve;
mod errors;
mod eval;
mod numbers;
mod subjects;

use crate::scene::SceneError;
use clap::{Args, Subcommand};

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
