//! On how many threads all of a command runs, loading included. (EXR files are packed and unpacked by the crate exr's own threads unless
//! one is asked for.)

use crate::scene::SceneError;
use clap::{Args, value_parser};

#[derive(Clone, Debug, Args)]
pub struct ThreadArgs {
    /// Threads, which change nothing but the time [default: all cores]
    #[arg(long, value_name = "T", value_parser = value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

impl ThreadArgs {
    /// Starts them, before anything is done in parallel. Fails if a number is asked for and there is another one by then.
    pub fn start(&self) -> Result<(), SceneError> {
        let Some(threads) = self.threads.map(usize::from) else { return Ok(()) };
        let started = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
        if rayon::current_num_threads() == threads { Ok(()) } else { started.map_err(SceneError::new) }
    }
}
