//! Rough glass worked out by quadrature over facets, apart from the renderer: what a plane interface of one scattering keeps, and
//! a ball of it in a furnace.
//!
//! - Facets: B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces" (2007): GGX, eq. 33; refraction at a facet,
//!   eq. 40; Λ from eq. 34. Of light that a facet scatters from o to i, G2 (o·m)/(z_o m_z) D m_z dm goes on, with
//!   G2 = 1/(1 + Λo + Λi) on one side and B(1 + Λo, 1 + Λi) between the two (E. Heitz et al., 2016, eqs. 18, 19).
//! - D m_z dm = du dφ/2π with tan²θ_m = α² u/(1 − u); with 1 − u = (1 − s)² the tail of steep facets has no singularity left.
//! - Ball: a ray within meets the surface under the same angle that it has left it, so cosines are all there is to know. With V(μ) the
//!   share of the furnace seen by a ray that arrives from within, V = T + ∫ K(μ → μ′) V(μ′), solved on a grid of cosines.

use super::plates::fresnel;
use libm::lgamma;
use std::f64::consts::PI;

/// Points over s and φ, and cosines of the grid. Doubling all three moves a ball's mean by 2e-5, single angles by 3e-4 at most.
const S: usize = 96;
const PHI: usize = 128;
const GRID: usize = 480;

/// How G2 joins both sides of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Joint {
    /// Beta function: heights are anti-correlated.
    Beta,
    /// The form for one side, on two: wrong, and what the tests must be able to tell.
    OneSide,
}

/// An interface from n1, where light is followed from, to n2.
#[derive(Clone, Copy, Debug)]
pub struct Facets {
    pub alpha: f64,
    pub n1: f64,
    pub n2: f64,
    pub joint: Joint,
}

impl Facets {
    fn lambda(&self, cos: f64) -> f64 {
        let tan2 = (1.0 - cos * cos) / (cos * cos);
        0.5 * ((1.0 + self.alpha * self.alpha * tan2).sqrt() - 1.0)
    }

    /// Shows to `each` the share of light that goes on under a cosine: `reflected(μ′, share)` or `refracted(μ′, share)`.
    pub fn scatter(&self, cos: f64, mut reflected: impl FnMut(f64, f64), mut refracted: impl FnMut(f64, f64)) {
        let sin = (1.0 - cos * cos).sqrt();
        let eta = self.n1 / self.n2;
        let lambda_o = self.lambda(cos);
        for i in 0..S {
            let left = 1.0 - (i as f64 + 0.5) / S as f64;
            let u = 1.0 - left * left;
            let tan = self.alpha * u.sqrt() / left;
            let m_z = 1.0 / (1.0 + tan * tan).sqrt();
            for j in 0..PHI {
                let phi = PI * (j as f64 + 0.5) / PHI as f64;
                let projected = sin * tan * m_z * phi.cos() + cos * m_z;
                if projected <= 0.0 {
                    continue;
                }
                let share = projected / (cos * m_z) * 2.0 * left / (S * PHI) as f64;
                let (r, beyond) = fresnel(self.n1, self.n2, projected.min(1.0));
                let up = 2.0 * projected * m_z - cos;
                if up > 0.0 {
                    reflected(up, share * r / (1.0 + lambda_o + self.lambda(up)));
                }
                let down = eta * cos - (eta * projected - beyond) * m_z;
                if r < 1.0 && down > 0.0 {
                    let lambda_i = self.lambda(down.min(1.0));
                    let g2 = match self.joint {
                        Joint::Beta => {
                            (lgamma(1.0 + lambda_o) + lgamma(1.0 + lambda_i) - lgamma(2.0 + lambda_o + lambda_i)).exp()
                        }
                        Joint::OneSide => 1.0 / (1.0 + lambda_o + lambda_i),
                    };
                    refracted(down.min(1.0), share * (1.0 - r) * g2);
                }
            }
        }
    }

    /// What is reflected and refracted of light followed from a cosine.
    pub fn albedo(&self, cos: f64) -> [f64; 2] {
        let (mut r, mut t) = (0.0, 0.0);
        self.scatter(cos, |_, share| r += share, |_, share| t += share);
        [r, t]
    }
}

/// A ball of rough glass in vacuum.
pub struct Ball {
    outside: Facets,
    /// V at the middles of equal steps of the cosine.
    within: Vec<f64>,
}

impl Ball {
    /// `absorbs`: absorption times diameter.
    pub fn new(alpha: f64, n: f64, absorbs: f64, joint: Joint) -> Self {
        let inside = Facets { alpha, n1: n, n2: 1.0, joint };
        let at = |i: usize| (i as f64 + 0.5) / GRID as f64;
        // V(μ) = exp(−absorption 2r μ) (T + ∫ K V): rows of 1 − K, and T.
        let mut rows: Vec<Vec<f64>> = (0..GRID)
            .map(|i| {
                let (mut row, mut escapes) = (vec![0.0; GRID + 1], 0.0);
                let passes = (-absorbs * at(i)).exp();
                inside.scatter(
                    at(i),
                    |cos, share| around(cos).iter().for_each(|&(cell, part)| row[cell] -= passes * share * part),
                    |_, share| escapes += passes * share,
                );
                row[i] += 1.0;
                row[GRID] = escapes;
                row
            })
            .collect();
        Self { outside: Facets { alpha, n1: 1.0, n2: n, joint }, within: solve(&mut rows) }
    }

    /// What a ray from outside sees that meets the ball at a cosine, as a share of the furnace.
    pub fn seen(&self, cos: f64) -> f64 {
        let (mut back, mut through) = (0.0, 0.0);
        self.outside.scatter(
            cos,
            |_, share| back += share,
            |cos, share| through += share * around(cos).iter().map(|&(i, part)| part * self.within[i]).sum::<f64>(),
        );
        back + through
    }

    /// The mean over its disk.
    pub fn mean(&self) -> f64 {
        let n = 64;
        (0..n).map(|i| (i as f64 + 0.5) / n as f64).map(|cos| 2.0 * cos * self.seen(cos)).sum::<f64>() / n as f64
    }
}

/// Where a cosine lies on the grid: two neighbours and their parts.
fn around(cos: f64) -> [(usize, f64); 2] {
    let place = (cos * GRID as f64 - 0.5).clamp(0.0, (GRID - 1) as f64);
    let cell = (place as usize).min(GRID - 2);
    let part = place - cell as f64;
    [(cell, 1.0 - part), (cell + 1, part)]
}

/// Gauss's elimination; rows end with the right-hand side. Shares that are lost make the diagonal the largest.
fn solve(rows: &mut [Vec<f64>]) -> Vec<f64> {
    let n = rows.len();
    for k in 0..n {
        let (done, rest) = rows.split_at_mut(k + 1);
        let pivot = &done[k];
        for row in rest {
            let factor = row[k] / pivot[k];
            (k..=n).for_each(|j| row[j] -= factor * pivot[j]);
        }
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| rows[k][j] * x[j]).sum();
        x[k] = (rows[k][n] - known) / rows[k][k];
    }
    x
}
