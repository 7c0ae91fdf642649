//! What a command line says of a picture in the place of the scene: size, samples, seed; and on how many threads.

use super::threads::ThreadArgs;
use crate::scene::Overrides;
use clap::{Args, value_parser};

#[derive(Debug, Args)]
pub struct SettingsArgs {
    /// Samples a pixel
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..))]
    spp: Option<u32>,
    /// Another seed gives another noise
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    #[command(flatten)]
    pub threads: ThreadArgs,
    /// Width in pixels; the height follows if it is not given
    #[arg(long, value_name = "W", value_parser = value_parser!(u32).range(1..))]
    width: Option<u32>,
    /// Height in pixels; the width follows if it is not given
    #[arg(long, value_name = "H", value_parser = value_parser!(u32).range(1..))]
    height: Option<u32>,
}

impl SettingsArgs {
    pub fn overrides(&self) -> Overrides {
        Overrides { width: self.width, height: self.height, samples: self.spp, seed: self.seed, ..Overrides::default() }
    }

    /// Samples a pixel, if the command line says how many.
    pub fn samples(&self) -> Option<u32> {
        self.spp
    }
}

/// An option's wavelengths a path.
pub fn lanes(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(lanes @ (1 | 4 | 8)) => Ok(lanes),
        _ => Err("a path carries 1, 4 or 8 wavelengths".into()),
    }
}
