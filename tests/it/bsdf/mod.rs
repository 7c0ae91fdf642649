//! Surfaces by themselves: samplers, densities, energy and reciprocity.

mod chi_squared;
mod energy;
mod rough_dielectric;
