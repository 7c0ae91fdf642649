//! Running `spectrel` from outside, in a folder of its own.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

/// A folder that holds these files.
pub fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, content) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
        fs::write(path, content).expect("a file");
    }
    folder
}

pub fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_spectrel"));
    command.current_dir(folder).args(args);
    command
}

/// Runs `spectrel` and expects success.
pub fn run(folder: &Path, args: &[&str]) -> Output {
    let output = command(folder, args).output().expect("spectrel runs");
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    output
}

/// Runs `spectrel`, expects it to refuse with status 2, and gives what it says.
pub fn refused(folder: &Path, args: &[&str]) -> String {
    let output = command(folder, args).output().expect("spectrel runs");
    let stderr = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(2), "{args:?}: {stderr}");
    stderr
}
