//! Fresnel's equations for red, green and blue, with one n and k for each: the exact model in a renderer that knows no wavelengths.
//!
//! Three ways to choose the indices:
//!
//! - [`Projected`]: n and k taken for spectra and seen by the observer, as a reflectance would be: linear sRGB under D65, n at least 0.001, k at
//!   least 0. What converters of measured data to RGB do.
//! - [`At611`]: n and k at 611.4, 549.1 and 464.2 nm, the dominant wavelengths of the primaries of sRGB, here to the nm.
//! - [`At650`]: n and k at 650, 550 and 450 nm, the customary choice.
//!
//! The reflectance of a mean index is not the mean reflectance, so none of them is exact even at normal incidence.
//!
//! - Error against `exact` (`tests/it/fresnel/errors.rs`; mean ΔE2000 over the angles): projected silver 0.01, aluminium 0.10, copper 0.96, gold 1.8;
//!   at 611, 549 and 464 nm 0.15, 0.35, 2.7 and 4.6; at 650, 550 and 450 nm 0.05, 0.12, 2.0 and 4.0. Schlick's is 0.9 for gold.
//! - Cost (`benches/fresnel.rs`, SSE2, Sapphire Rapids): 32 ns for eight lanes at a hit.

use super::schlick_rgb::single;
use super::{Rgb, Target, conductor};
use crate::math::Lanes;

/// Three indices, however chosen: n1 outside, n2 + i k2 inside.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Indices {
    n1: Lanes<3>,
    n2: Lanes<3>,
    k2: Lanes<3>,
}

impl Indices {
    fn at(target: &Target, wavelengths_nm: [f64; 3]) -> Self {
        let [r, g, b] = wavelengths_nm.map(|nm| target.specimen.indices(nm));
        let [n1, n2, k2] = std::array::from_fn(|i| single([r[i], g[i], b[i]]));
        Self { n1, n2, k2 }
    }

    fn projected(target: &Target) -> Self {
        let project = |index: usize, least: f64| {
            single(target.meter.rgb(|nm| target.specimen.indices(nm)[index]).map(|value| value.max(least)))
        };
        Self { n1: project(0, LEAST_N), n2: project(1, LEAST_N), k2: project(2, 0.0) }
    }

    #[inline]
    fn reflectance(&self, cos_theta_i: f32) -> Lanes<3> {
        conductor::reflectance(&self.n1, &self.n2, &self.k2, &Lanes::splat(cos_theta_i))
    }
}

/// Projected indices may come out below 0.
const LEAST_N: f64 = 0.001;

macro_rules! ways {
    ($($(#[$doc:meta])* $way:ident: $fit:expr;)+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $way(Indices);

        impl Rgb for $way {
            fn fit(target: &Target) -> Self {
                let fit: fn(&Target) -> Indices = $fit;
                Self(fit(target))
            }

            #[inline]
            fn reflectance(&self, cos_theta_i: f32) -> Lanes<3> {
                self.0.reflectance(cos_theta_i)
            }
        }
    )+};
}

ways! {
    /// n and k as the observer sees them.
    Projected: Indices::projected;
    /// n and k at 611, 549 and 464 nm.
    At611: |target| Indices::at(target, [611.0, 549.0, 464.0]);
    /// n and k at 650, 550 and 450 nm.
    At650: |target| Indices::at(target, [650.0, 550.0, 450.0]);
}
