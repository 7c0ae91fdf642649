//! Whole renders against answers worked out apart from the renderer.

mod camera_media;
mod clear_glass;
mod closed_rooms;
mod contact;
mod covering;
mod furnace;
mod immersed;
mod kernels;
mod lanes;
mod mesh_diamond;
mod mesh_sphere;
mod nesting;
mod prism;
mod prism_slit;
mod rainbow;
mod rough_glass;
mod rough_sphere;
mod slab;
mod spectral;
mod transport;
mod white;
