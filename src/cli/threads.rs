//! On how many threads all of a command runs, loading and writing included.

use crate::scene::SceneError;
use clap::{Args, value_parser};

#[derive(Clone, Debug, Args)]
pub struct ThreadArgs {
    /// Threads, which change nothing but the time [default: all cores]
    #[arg(long, value_name = "T", value_parser = value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

impl ThreadArgs {
    /// Starts them, once in a program and before anything is done in parallel.
    pub fn start(&self) -> Result<(), SceneError> {
        let threads = usize::from(self.threads.unwrap_or(0));
        rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().map_err(SceneError::new)
    }
}
