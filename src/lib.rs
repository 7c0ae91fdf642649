//! spectrel predicts how metals and gems look from measured spectra.
//!
//! Light and data flow one way:
//!
//! ```text
//! scene.toml, materials/*.toml, spectra/*.toml, pictures (texture)
//!     → scene::describe   what the files say, with the place of every value
//!     → scene::resolve    names become data, units become SI and nm, every check is made
//!     → scene::needs      which physics this scene uses, and why
//!     → render            paths of eight wavelengths, tile by tile
//!     → adaptive          how many samples, where, and how large the error still is
//!     → film              exact sums of XYZ in cd/m², and of what is asked for beside it
//!     → film::develop     exposure, white balance, RGB space, gamut
//!     → image             EXR with its layers, spectral EXR, PNG
//!     → report            tables and comparisons, for people and for programs
//! ```
//!
//! `math` holds the numbers that all of them share. Parsing and resolving may fail; rendering cannot. `spectrum` and `fresnel` know no scene and are usable alone.
//!
//! Conventions, here once for all rooms:
//!
//! - Wavelengths are vacuum wavelengths in nm, names end in `_nm`; the visible range is 360–830 nm.
//! - The complex index is N = n + i k with k ≥ 0, fields go as exp(−iωt); r_p = −r_s at normal incidence.
//! - `cos_theta_i` is the cosine against the normal on the side of incidence, 0…1.
//! - Vectors are unit vectors pointing away from the surface: `wo` to the viewer, `wi` to the light.
//! - Lengths are scene units; `meters_per_unit` gives their scale where absorption needs it.
//! - Spectral radiance is in W m⁻² sr⁻¹ nm⁻¹; the film holds XYZ in cd/m².

#![forbid(unsafe_code)]

pub mod adaptive;
pub mod bsdf;
pub mod camera;
pub mod cli;
pub mod files;
pub mod film;
pub mod fresnel;
pub mod geometry;
pub mod image;
pub mod light;
pub mod math;
pub mod memory;
pub mod render;
pub mod report;
pub mod sampler;
pub mod scene;
pub mod spectrum;
pub mod texture;
