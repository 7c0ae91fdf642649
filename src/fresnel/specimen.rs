//! An interface as measured: indices of refraction as functions of the wavelength.

use super::exact::{self, Reflection};
use crate::spectrum::{Ior, Spectrum};

/// n1 outside, where light comes from, and N = n2 + i k2 inside.
#[derive(Clone, Copy, Debug)]
pub struct Specimen<'a> {
    pub n1: &'a Spectrum,
    pub n2: &'a Spectrum,
    pub k2: &'a Spectrum,
}

static VACUUM: Spectrum = Spectrum::Constant(1.0);
static LOSSLESS: Spectrum = Spectrum::Constant(0.0);

impl<'a> Specimen<'a> {
    /// A material seen from a medium of n = 1.
    pub fn in_vacuum(ior: &'a Ior) -> Self {
        Self { n1: &VACUUM, n2: &ior.n, k2: &ior.k }
    }

    /// The boundary of two clear media: of what absorbs inside, reflection knows nothing.
    pub fn clear(n1: &'a Spectrum, n2: &'a Spectrum) -> Self {
        Self { n1, n2, k2: &LOSSLESS }
    }

    /// The same, seen from the rarer one (the one of the smaller n at 550 nm).
    pub fn between(a: &'a Spectrum, b: &'a Spectrum) -> Self {
        if a.at(550.0) <= b.at(550.0) { Self::clear(a, b) } else { Self::clear(b, a) }
    }

    /// (n1, n2, k2) at a wavelength, nm.
    pub fn indices(&self, nm: f64) -> [f64; 3] {
        [self.n1.at(nm), self.n2.at(nm), self.k2.at(nm)]
    }

    /// What the exact equations say at a wavelength, nm.
    pub fn reflect(&self, nm: f64, cos_theta_i: f64) -> Reflection {
        let [n1, n2, k2] = self.indices(nm);
        exact::reflect(n1, n2, k2, cos_theta_i)
    }
}
