//! What people take away: tables, curves and plots of models and pictures.
//!
//! Numbers in, text out; names are resolved by `cli`.
//!
//! - `fresnel`: the Fresnel models side by side, against angle and wavelength, and how far off each is.
//! - `plot`: figures in SVG.

pub mod fresnel;
pub mod plot;
