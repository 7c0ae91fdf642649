//! Sums, layers, development and the files they become.

mod develop;
mod exact;
mod files;
mod layers;
