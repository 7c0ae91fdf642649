//! Development: exact sums become a picture. XYZ (cd/m²) × 2^−EV → Bradford to the display's white → linear RGB.
//!
//! Nothing is clipped here: RGB may be above 1 or negative, and the report counts where. Files that cannot hold such
//! colours map them when they are written ([`Developed::display`]).

use super::{Exposure, Film, FilmError, Gamut, GamutReport, Pixel, Window};
use crate::spectrum::{Matrix3, RgbSpace, Xyz, bradford};
use rayon::prelude::*;

/// How to develop a film.
#[derive(Clone, Debug, PartialEq)]
pub struct Develop {
    pub exposure: Exposure,
    /// XYZ of the colour that becomes display white; only its chromaticity counts (Y is taken as 1).
    pub white: Xyz,
    pub space: RgbSpace,
    pub gamut: Gamut,
}

impl Default for Develop {
    /// Automatic exposure, no white balance, sRGB, hue kept.
    fn default() -> Self {
        let space = RgbSpace::Srgb;
        Self { exposure: Exposure::Auto, white: space.white_xyz(), space, gamut: Gamut::PreserveChroma }
    }
}

/// A developed film.
#[derive(Clone, Debug, PartialEq)]
pub struct Developed {
    /// [width, height] of the full image.
    pub image: [u32; 2],
    /// The part of it the pixels cover, row by row from the top.
    pub window: Window,
    /// Mean XYZ in cd/m², as on the film: neither exposed nor balanced.
    pub xyz: Vec<[f32; 3]>,
    /// Linear RGB relative to display white, not clipped.
    pub rgb: Vec<[f32; 3]>,
    /// RGB (1, 1, 1) is 2^EV cd/m².
    pub ev: f64,
    /// XYZ of the colour that became display white, Y = 1.
    pub white: Xyz,
    pub space: RgbSpace,
    pub gamut: Gamut,
    pub report: GamutReport,
}

impl Developed {
    pub fn width(&self) -> u32 {
        self.window.width
    }

    pub fn height(&self) -> u32 {
        self.window.height
    }

    /// Linear RGB mapped into [0, 1] for files that hold no more.
    pub fn display(&self) -> impl Iterator<Item = [f64; 3]> {
        let luminance = self.space.xyz_from_rgb().0[1];
        self.rgb.iter().map(move |rgb| self.gamut.map(rgb.map(f64::from), luminance))
    }
}

impl Develop {
    /// The matrix from XYZ in cd/m² to linear RGB at exposure `ev`.
    pub fn matrix(&self, ev: f64) -> Result<Matrix3, FilmError> {
        let adapt = bradford(self.normalised_white()?, self.space.white_xyz());
        Ok(self.space.rgb_from_xyz().after(&adapt).after(&Matrix3::diagonal([libm::exp2(-ev); 3])))
    }

    fn normalised_white(&self) -> Result<Xyz, FilmError> {
        let white = self.white;
        let valid = white.iter().all(|c| c.is_finite() && *c >= 0.0) && white[1] > 0.0;
        if valid { Ok(white.map(|c| c / white[1])) } else { Err(FilmError::White { white }) }
    }
}

impl Film {
    /// Mean Y (cd/m²) of every pixel.
    pub fn luminances(&self) -> impl IndexedParallelIterator<Item = f64> {
        self.pixels().par_iter().map(|pixel| pixel.mean()[1])
    }

    /// Develops the film.
    pub fn develop(&self, develop: &Develop) -> Result<Developed, FilmError> {
        let ev = develop.exposure.ev(self.luminances())?;
        let matrix = develop.matrix(ev)?;
        let color = |pixel: &Pixel| {
            let mean = pixel.mean();
            (to_f32(mean), to_f32(matrix.apply(mean)))
        };
        let (xyz, rgb): (Vec<_>, Vec<_>) = self.pixels().par_iter().map(color).unzip();
        Ok(Developed {
            image: self.image(),
            window: self.window(),
            xyz,
            ev,
            white: develop.normalised_white()?,
            space: develop.space,
            gamut: develop.gamut,
            report: self.gamut_report(&rgb, develop),
            rgb,
        })
    }

    fn gamut_report(&self, rgb: &[[f32; 3]], develop: &Develop) -> GamutReport {
        let nothing = || GamutReport { gamut: develop.gamut, space: develop.space, ..GamutReport::default() };
        let each = self.pixels().par_iter().zip(rgb);
        each.fold(nothing, |report, (pixel, rgb)| report.with(pixel, *rgb)).reduce(nothing, GamutReport::and)
    }
}

fn to_f32(xyz: [f64; 3]) -> [f32; 3] {
    xyz.map(|c| c as f32)
}
