//! The equations, their approximations, and the commands that print them.

mod curve;
mod errors;
mod eval;
mod hard;
mod kernels;
mod literature;
mod models;
mod rgb;
