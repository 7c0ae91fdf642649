//! The light tree: its choice as a probability, and the light that it finds.

#[path = "../common/mod.rs"]
mod common;
#[path = "../statistics/mod.rs"]
mod statistics;

mod choice;
mod copies;
mod lamps;
mod light;
