//! The exact equations of a lossless interface in the form that computer graphics first knew.
//!
//! ```text
//! F(θ) = ½ ((g − c)/(g + c))² (1 + ((c (g + c) − 1)/(c (g − c) + 1))²),   g² = (n2/n1)² − 1 + c²,   c = cos θ_i
//! ```
//!
//! - Source: R. Cook & K. Torrance, "A reflectance model for computer graphics" (1982), their F (after J. Blinn 1977).
//! - Exact but for rounding, which it suffers more of: n2/n1 is rounded before 1 is taken from its square, and g − c cancels where the
//!   indices nearly match. g² ≤ 0 is total reflection.
//! - Error against `exact` in f32 (`tests/it/fresnel/rgb.rs`): 7e-7 of R away from the critical angle; 2e-5 relative to R from 1.52 to 1.53.
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids): 8 ns for eight lanes at a hit.

use super::{Dielectric, Model, dielectric};
use crate::math::Lanes;

/// The squares of n2/n1 at a hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CookTorrance<const N: usize> {
    pub eta_squared: Lanes<N>,
}

impl<const N: usize> Model<N> for CookTorrance<N> {
    const DIELECTRICS_ONLY: bool = true;

    #[inline]
    fn new(n1: &Lanes<N>, n2: &Lanes<N>, _: &Lanes<N>) -> Self {
        let eta = *n2 / *n1;
        Self { eta_squared: eta * eta }
    }

    #[inline]
    fn reflectance(&self, cos_theta_i: &Lanes<N>) -> Lanes<N> {
        self.eta_squared.zip(*cos_theta_i, one)
    }

    #[inline]
    fn dielectric(n1: &Lanes<N>, n2: &Lanes<N>, cos_theta_i: &Lanes<N>) -> Dielectric<N> {
        let curve = Self::new(n1, n2, &Lanes::ZERO).reflectance(cos_theta_i);
        dielectric::bounded(n1, n2, &curve, dielectric::cos_theta_t(n1, n2, cos_theta_i))
    }
}

#[inline(always)]
fn one(eta_squared: f32, c: f32) -> f32 {
    let g_squared = eta_squared - 1.0 + c * c;
    let g = g_squared.max(0.0).sqrt();
    let (sum, difference) = (g + c, g - c);
    let s = difference / sum;
    let p = (c * sum - 1.0) / (c * difference + 1.0);
    let r = 0.5 * s * s * (1.0 + p * p);
    if g_squared > 0.0 { r } else { 1.0 }
}
