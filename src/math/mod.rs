//! What several rooms compute with and no law of optics is in: numbers by wavelength, vectors by
//! wavelength, frames, turns and integrals.

mod frame;
mod lanes;
pub mod quadrature;
mod turn;
mod vectors;

pub use frame::Frame;
pub use lanes::{LANES, Lanes};
pub use turn::cos_sin;
pub use vectors::Vectors;
