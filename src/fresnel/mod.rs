//! Reflectance of an interface: numbers in, numbers out; no scene.
//!
//! `exact` is the f64 reference. `conductor` and `dielectric` are the exact equations in f32 over the lanes of a path, and each
//! approximation has a file of its own. To add a model, write its file with `impl Model` and add one line to `models!` below.

mod average;
pub mod conductor;
pub mod constant;
pub mod dielectric;
mod double;
pub mod exact;
pub mod f82_spectral;
mod model;
pub mod quadrature;
pub mod schlick;

pub use average::{average, f0};
pub use dielectric::Dielectric;
pub use model::{Model, UnknownModel};

use crate::spectrum::Lanes;
use model::models;

models! {
    /// Fresnel's equations.
    Exact = "exact", conductor::Conductor;
    /// Schlick 1994, with F0 from n and k.
    Schlick = "schlick", schlick::Schlick;
    /// Hoffman 2019, per wavelength: Schlick with its dip at 82°.
    F82Spectral = "f82-spectral", f82_spectral::F82Spectral;
    /// The reflectance at normal incidence at every angle.
    Constant = "constant", constant::Constant;
}
