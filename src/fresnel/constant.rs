//! No angle at all: the reflectance at normal incidence everywhere.
//!
//! ```text
//! F(θ) = F0 = ((n2 − n1)² + k2²)/((n2 + n1)² + k2²)
//! ```
//!
//! - Source: what a colour picked for a metal means in a shader without a Fresnel term; F0 exact, of n and k.
//! - A lossless interface still reflects all beyond its critical angle, or light would leave by directions that do not exist.
//! - Error against `exact` (`tests/it/fresnel/models.rs`): 1 − F0 at grazing, 0.03 of silver's and 0.67 of gold's darkest channel.
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids): 1.7 ns for eight lanes at a hit, F0 included.

use super::{Model, schlick};
use crate::math::Lanes;

/// One value of one hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant<const N: usize> {
    pub f0: Lanes<N>,
}

impl<const N: usize> Model<N> for Constant<N> {
    #[inline]
    fn new(n1: &Lanes<N>, n2: &Lanes<N>, k2: &Lanes<N>) -> Self {
        Self { f0: schlick::normal_incidence(n1, n2, k2) }
    }

    #[inline]
    fn reflectance(&self, _: &Lanes<N>) -> Lanes<N> {
        self.f0
    }
}
