//! How many samples a picture gets, where they go, and how large its error still is.
//!
//! - [`effort`]: how long a render is to go on, and the render that goes on so long; [`render_loop`]: the loop itself.
//! - [`sharing`]: samples shared out; [`pilot`]: what the first ones tell; [`allocation`]: which pixel gets how many.
//! - [`promise`]: a render that ends by its error; [`target`]: what is asked of that error.
//! - [`noise`]: how far each pixel is from the picture without noise; [`bound`]: what may be promised of that, `lift` its percentiles.
//!
//! Nothing is printed here: callbacks are told how a render goes on.

pub mod allocation;
pub mod bound;
pub mod effort;
mod lift;
pub mod noise;
pub mod pilot;
pub mod promise;
pub mod render_loop;
pub mod sharing;
pub mod target;

pub use allocation::Aim;
pub use bound::Bound;
pub use effort::{Effort, LEAST_SHARED, LIMIT, Session};
pub use noise::Noise;
pub use pilot::Pilot;
pub use promise::{Goal, Look};
pub use render_loop::RenderLoop;
pub use sharing::{Halves, SharedLoop};
pub use target::{Measure, Reached, Target};
