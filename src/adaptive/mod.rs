//! How many samples a picture gets, where they go, and how large its error still is.
//!
//! - [`noise`]: how far each pixel is from the picture without noise; [`bound`]: what may be promised of that, `lift` its percentiles.
//! - [`pilot`]: what the first samples tell; [`allocation`]: which pixel gets how many samples.

pub mod allocation;
pub mod bound;
mod lift;
pub mod noise;
pub mod pilot;
