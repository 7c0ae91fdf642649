//! What people read of pictures: how far they are apart, how sure that is, and reports of it.
//!
//! - `view`: radiances as a display shows them; `difference`: two pictures compared, replicate by replicate
//! - `jackknife`: what independent replicates say of a number's error
//! - `colormap`: numbers as colours; `curves`: lines in a small SVG
//! - `timing`: what one evaluation costs
//! - `comparison`: variants of a scene beside each other, as one HTML page and as JSON
//!
//! Numbers in, text and pixels out: this room knows no scene.

pub mod colormap;
pub mod comparison;
pub mod curves;
pub mod difference;
pub mod jackknife;
pub mod timing;
pub mod view;

pub use comparison::Comparison;
pub use difference::{Difference, Noise, Verdict};
pub use jackknife::Estimate;
pub use view::View;
