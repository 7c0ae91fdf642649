//! Tables that people hand in, and what is wrong with them told with its place.

use crate::report::table::TableError;
use crate::scene::SceneError;
use std::io::{self, Read};
use std::path::Path;

/// A file's bytes; of `-` those of standard input.
pub fn contents(path: &Path) -> Result<Vec<u8>, SceneError> {
    let mut bytes = Vec::new();
    let read = match path == Path::new("-") {
        true => io::stdin().read_to_end(&mut bytes).map(|_| bytes),
        false => std::fs::read(path),
    };
    read.map_err(|error| SceneError::new(format!("cannot read {}: {error}", path.display())))
}

/// The error with its file; without a line it is about the columns, of which `example` is a header.
pub fn wrong(path: &Path, TableError { line, message }: TableError, example: &str) -> SceneError {
    let shown = path.display();
    match line {
        Some(line) => SceneError::new(format!("{shown}:{line}: {message}")),
        None => SceneError::new(format!("{shown}: {message}"))
            .help(format!("the first line that is no comment names the columns, such as `{example}`")),
    }
}
