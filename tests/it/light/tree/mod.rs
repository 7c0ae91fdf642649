//! The light tree: its choice as a probability, and the light that it finds.

mod choice;
mod copies;
mod lamps;
mod light;
