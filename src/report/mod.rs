//! What people read: tables, curves, and how far pictures are apart.
//!
//! - `f0`: colours of interfaces at normal incidence, at 82° and averaged, for tables and for checking those of others.
//! - `fresnel`: reflectance curves, and the errors of approximations.
//! - `difference`: two pictures compared, replicate by replicate.
//! - `jackknife`: what independent replicates say of a number's error.
//! - `comparison`: variants of a scene beside each other, as one HTML page and as JSON.
//! - `bench`: speed against error, as text, figure, HTML page and JSON.
//! - `plot`, `colormap`: figures in SVG, numbers as colours.
//! - `grid`: a table as text, Markdown or CSV; `markup`: texts and values as HTML, Markdown and JSON take them.
//! - `table`: tables of others, read.
//! - `timing`: what one evaluation costs.
//!
//! Numbers in, text and pixels out: this room knows no scene.

pub mod bench;
pub mod colormap;
pub mod comparison;
pub mod difference;
pub mod f0;
pub mod fresnel;
mod grid;
pub mod jackknife;
pub mod markup;
pub mod plot;
pub mod table;
pub mod timing;

pub use comparison::Comparison;
pub use difference::{Difference, Noise, Verdict};
pub use grid::Grid;
pub use jackknife::Estimate;
