//! The command from outside.

mod basics;
mod bench;
mod compare;
mod output;
mod target_error;
mod watch;
