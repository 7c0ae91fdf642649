//! Scene files: what they mean, and how they are refused.

mod bad_input;
mod far_from_origin;
mod meshes;
