//! Lamps and skies: how they are chosen, and the light that is found.

mod surroundings;
mod tree;
