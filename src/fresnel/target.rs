//! What RGB models are fitted to: the exact colours of an interface, in linear sRGB under the light of a colorimeter.

use super::Specimen;
use crate::spectrum::Colorimeter;
use std::cell::OnceCell;

/// Fits and errors are over the cosines 0, 0.01, … 1.
pub const COSINES: usize = 101;

/// The cosine at which c (1 − c)⁶ is largest, 81.8°: where F82 models are fitted.
pub const COS_82: f64 = 1.0 / 7.0;

/// An interface and what its colours are measured with.
#[derive(Clone, Debug)]
pub struct Target<'a> {
    pub specimen: Specimen<'a>,
    pub meter: &'a Colorimeter,
    curve: OnceCell<Vec<[f64; 3]>>,
}

impl<'a> Target<'a> {
    pub fn new(specimen: Specimen<'a>, meter: &'a Colorimeter) -> Self {
        Self { specimen, meter, curve: OnceCell::new() }
    }

    /// The exact colour at cos θ_i.
    pub fn color(&self, cos_theta_i: f64) -> [f64; 3] {
        self.meter.rgb(|nm| self.specimen.reflect(nm, cos_theta_i).r)
    }

    /// The exact colour at normal incidence.
    pub fn f0(&self) -> [f64; 3] {
        self.color(1.0)
    }

    /// The exact colour at c = 1/7.
    pub fn f82(&self) -> [f64; 3] {
        self.color(COS_82)
    }

    /// The cosines of fits.
    pub fn cosines() -> impl Iterator<Item = f64> {
        (0..COSINES).map(|i| i as f64 / (COSINES - 1) as f64)
    }

    /// The exact colours at [`Self::cosines`].
    pub fn curve(&self) -> &[[f64; 3]] {
        self.curve.get_or_init(|| Self::cosines().map(|cos| self.color(cos)).collect())
    }

    /// One channel of [`Self::curve`], with its cosines.
    pub(super) fn channel(&self, channel: usize) -> impl Iterator<Item = (f64, f64)> {
        Self::cosines().zip(self.curve()).map(move |(cos, rgb)| (cos, rgb[channel]))
    }
}
