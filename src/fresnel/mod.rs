//! Reflectance of an interface: numbers in, numbers out.

mod double;
pub mod exact;
