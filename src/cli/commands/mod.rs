//! The commands: one file or folder each.

pub mod bench;
pub mod compare;
pub mod f0;
pub mod fresnel;
pub mod inspect;
pub mod list;
pub mod render;
