//! Reflectance of an interface: numbers in, numbers out; no scene.
//!
//! `exact` is the f64 reference. `conductor`, `dielectric` and `absorbing` (media with k on both sides) are
//! the exact equations in f32 over the lanes of a path, and each approximation has a file of its own. To add a model, write its file with `impl Model` or `impl Rgb` and add one line to
//! `models!` below.
//!
//! - `specimen`: an interface as measured; `target`: the colours that RGB models are fitted to; `rgb`: how they act on wavelengths.
//! - `tabulated`: any model on a specimen, for tables and curves; `ready`: in the lanes of a path.
//! - `average`: sums over angles.
//!
//! An F0 table, in linear sRGB under D65:
//!
//! ```
//! use spectrel::fresnel::{Specimen, Target};
//! use spectrel::spectrum::{Adaptation, Colorimeter, Library, Observer, RgbSpace};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let library = Library::default();
//! let light = library.illuminant("D65", "".as_ref())?;
//! let observer = library.observer(Observer::Cie1931)?;
//! let meter = Colorimeter::new(&light.spectrum, &observer, RgbSpace::Srgb, Adaptation::Bradford)?;
//! for name in ["Au/olmon-2012-evaporated", "Ag/yang-2015", "Cu/mcpeak-2015"] {
//!     let ior = library.ior(name, "".as_ref())?;
//!     let [r, g, b] = Target::new(Specimen::in_vacuum(&ior), &meter).f0();
//!     println!("{r:.4} {g:.4} {b:.4}  {name}, {} {:?}", ior.about.source.authors, ior.about.source.year);
//! }
//! # Ok(())
//! # }
//! ```

pub mod absorbing;
mod average;
pub mod conductor;
pub mod constant;
pub mod cook_torrance;
pub mod dielectric;
mod double;
mod downhill;
pub mod exact;
pub mod f82;
pub mod f82_spectral;
pub mod f82_tint;
pub mod gulbrandsen;
pub mod lazanyi;
mod model;
mod ready;
mod rgb;
pub mod rgb_exact;
pub mod schlick;
pub mod schlick_gaussian;
pub mod schlick_rgb;
pub mod schlick_sides;
mod specimen;
mod tabulated;
mod target;

pub use average::{average, f0};
pub use dielectric::Dielectric;
pub use model::{Model, Rgb, UnknownModel};
pub use ready::{Fitted, Ready};
pub use rgb::{DielectricFresnel, Fresnel, RgbFresnel};
pub use specimen::Specimen;
pub use tabulated::Tabulated;
pub use target::{COS_82, COSINES, Target};

use crate::math::Lanes;
use model::models;

/// The Fresnel model that a scene asks for, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FresnelModel {
    Spectral(SpectralModel),
    Rgb(RgbModel),
}

models! {
    spectral {
        /// Fresnel's equations.
        Exact = "exact", conductor::Conductor;
        /// Schlick 1994, with F0 from n and k.
        Schlick = "schlick", schlick::Schlick;
        /// Hoffman 2019, per wavelength: Schlick with its dip at cos θ = 1/7 (81.79°).
        F82Spectral = "f82-spectral", f82_spectral::F82Spectral;
        /// The reflectance at normal incidence at every angle.
        Constant = "constant", constant::Constant;
        /// Schlick by the cosine on the side that light comes from; for dielectrics.
        SchlickIncident = "schlick-incident", schlick_sides::SchlickIncident;
        /// Schlick by the cosine on the rarer side; for dielectrics.
        SchlickTransmitted = "schlick-transmitted", schlick_sides::SchlickTransmitted;
        /// The exact equations in Cook & Torrance's g; for dielectrics.
        CookTorrance = "cook-torrance", cook_torrance::CookTorrance;
    }
    rgb {
        /// Schlick 1994, with the RGB of F0.
        SchlickRgb = "schlick-rgb", schlick_rgb::SchlickRgb;
        /// Schlick in RGB, its power replaced by a Gaussian.
        SchlickGaussian = "schlick-gaussian", schlick_gaussian::SchlickGaussian;
        /// Lazányi & Szirmay-Kalos 2005: Schlick minus a fitted dip.
        Lazanyi = "lazanyi", lazanyi::Lazanyi;
        /// Hoffman 2019, in RGB: Schlick with its dip at cos θ = 1/7 (81.79°).
        F82 = "f82", f82::F82;
        /// Kutz, Hašan & Edmondson 2021: F82 as a tint, bounded.
        F82Tint = "f82-tint", f82_tint::F82Tint;
        /// Gulbrandsen 2014: n and k from the RGB of F0 and a fitted edge.
        Gulbrandsen = "gulbrandsen", gulbrandsen::Gulbrandsen;
        /// Fresnel's equations with n and k projected to RGB.
        RgbExact = "rgb-exact", rgb_exact::Projected;
        /// Fresnel's equations with n and k at 611, 549 and 464 nm.
        RgbExact611 = "rgb-exact-611-549-464", rgb_exact::At611;
        /// Fresnel's equations with n and k at 650, 550 and 450 nm.
        RgbExact650 = "rgb-exact-650-550-450", rgb_exact::At650;
    }
}
