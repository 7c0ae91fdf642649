//! All tests that share a process, by topic: `cargo test --release --test it fresnel::` runs one topic.
//!
//! One binary is linked once, where sixty took most of the time of a fresh clone. Apart from it are tests that are also built another
//! way (`reproducible` in debug, `preview` with its feature) and `promises`, which takes minutes.

mod bsdf;
mod cli;
mod film;
mod fresnel;
mod geometry;
mod house;
mod light;
mod render;
mod report;
mod scene;
mod spectrum;
mod texture;

#[path = "../common/mod.rs"]
mod common;
#[path = "../statistics/mod.rs"]
mod statistics;
