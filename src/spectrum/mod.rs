//! Functions of wavelength.

mod lanes;

pub use lanes::{LANES, Lanes};
