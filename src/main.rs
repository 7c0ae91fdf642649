//! Parse, run, print one error, exit.

#![forbid(unsafe_code)]

fn main() -> std::process::ExitCode {
    spectrel::cli::main()
}
