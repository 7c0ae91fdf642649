//! What is said of pictures and of reflectances: tables, curves and the errors of models.
//!
//! - `f0`: colours of interfaces at normal incidence, at 82° and averaged, for tables and for checking those of others.
//! - `fresnel`: reflectance curves, and the errors of approximations.
//! - `plot`: SVG figures.

pub mod f0;
pub mod fresnel;
pub mod plot;
