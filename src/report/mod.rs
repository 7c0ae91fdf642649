//! What a picture is worth: error measures, and how the work is spent that brings them down.

pub mod noise;
pub mod plan;
