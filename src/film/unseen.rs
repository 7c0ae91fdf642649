//! Light that may be there though no path has found it, and what it would add to a picture.
//!
//! Of paths that meet a light by chance, fewer than three are missing with 95 % (e⁻³ = 0.05), whatever they bring; none brings more than the
//! brightest light that has such a way (`scene::chance`).

use super::View;
use crate::spectrum::{Xyz, ciede2000};
use rayon::prelude::*;

/// As many events may be expected, and none be seen, with 5 %.
pub const EVENTS: f64 = 3.0;

/// Light that may be there though no path has found it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unseen {
    /// XYZ relative to display white that one path brings at most.
    pub brightest: Xyz,
    /// Samples of the pixel that has fewest.
    pub samples: f64,
    /// Pixels of the picture.
    pub pixels: f64,
}

impl Unseen {
    /// For pictures in which everything is aimed at.
    pub const NOTHING: Self = Self { brightest: [0.0; 3], samples: 1.0, pixels: 1.0 };

    /// Mean ΔE2000 that it makes if it lies evenly on pixels of these colours, relative to display white.
    pub fn mean_de(&self, view: &View, colors: &[[f32; 3]]) -> f64 {
        // Summed in order, so that looks end a render at the same sample everywhere.
        let each: Vec<f64> = colors.par_iter().map(|color| self.delta_e(view, color, 1.0)).collect();
        each.iter().sum::<f64>() / colors.len() as f64
    }

    /// Mean luminance that may be missing, relative to display white.
    pub fn luminance(&self) -> f64 {
        self.evenly(1.0)[1]
    }

    /// ΔE2000 that so many times the even share makes in a pixel of a colour.
    pub fn delta_e(&self, view: &View, color: &[f32; 3], amount: f64) -> f64 {
        let missing = self.evenly(amount);
        let color = color.map(f64::from);
        let brighter = std::array::from_fn(|i| color[i] + missing[i]);
        if color == brighter { 0.0 } else { ciede2000(view.lab(color), view.lab(brighter)) }
    }

    /// What each pixel has of so many times the light, if it lies evenly.
    fn evenly(&self, amount: f64) -> Xyz {
        self.brightest.map(|c| amount * EVENTS * c / (self.samples * self.pixels))
    }
}
