//! Shapes, rays and mesh files.

mod cuts;
mod leaks;
mod loaders;
mod mesh;
mod sampling;
mod world;
