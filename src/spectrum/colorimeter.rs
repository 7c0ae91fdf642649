//! The colour of a reflectance under a light, by the convention of colour tables: a rectangle sum at 1 nm over 360–830 nm.
//!
//! A perfect reflector is exactly (1, 1, 1) in every space when its white is adapted to that of the space. Colours are neither
//! clipped nor rounded: gold's red is above 1 in sRGB.
//!
//! The renderer integrates the same spectra exactly; the two differ by 2e-5 under D65 (`integrate`).

use super::integrate::lines_and_nanometres;
use super::{ColorMatching, Matrix3, RgbSpace, Spectrum, SpectrumError, Xyz, bradford, lab_from_xyz, white_xyz_1nm};

/// What a light's white becomes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Adaptation {
    /// The white of the space, by the Bradford transform.
    #[default]
    Bradford,
    /// Nothing is adapted: colours are as the light makes them.
    None,
}

impl Adaptation {
    pub const ALL: [Self; 2] = [Self::Bradford, Self::None];

    pub fn name(self) -> &'static str {
        match self {
            Self::Bradford => "bradford",
            Self::None => "none",
        }
    }
}

/// A light, an observer and an RGB space: spectra of reflectance become linear RGB.
#[derive(Clone, Debug)]
pub struct Colorimeter {
    /// A wavelength, nm, and what a reflectance of 1 there adds to linear RGB.
    samples: Vec<(f64, [f64; 3])>,
    space: RgbSpace,
}

impl Colorimeter {
    /// Fails if the observer sees nothing of the light.
    pub fn new(
        light: &Spectrum,
        observer: &ColorMatching,
        space: RgbSpace,
        adaptation: Adaptation,
    ) -> Result<Self, SpectrumError> {
        let white = white_xyz_1nm(light, observer)?;
        let adapted = match adaptation {
            Adaptation::Bradford => bradford(white, space.white_xyz()),
            Adaptation::None => Matrix3::IDENTITY,
        };
        let rgb_from_xyz = space.rgb_from_xyz().after(&adapted);
        let xyz: Vec<(f64, Xyz)> =
            lines_and_nanometres(light).map(|(nm, power)| (nm, observer.at(nm).map(|value| value * power))).collect();
        let y: f64 = xyz.iter().map(|(_, xyz)| xyz[1]).sum();
        let samples = xyz.into_iter().filter(|(_, xyz)| *xyz != [0.0; 3]);
        let samples = samples.map(|(nm, xyz)| (nm, rgb_from_xyz.apply(xyz.map(|value| value / y)))).collect();
        Ok(Self { samples, space })
    }

    pub fn space(&self) -> RgbSpace {
        self.space
    }

    /// Linear RGB of a reflectance as a function of the wavelength in nm.
    pub fn rgb(&self, mut reflectance: impl FnMut(f64) -> f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (nm, weights) in &self.samples {
            let value = reflectance(*nm);
            (0..3).for_each(|i| sum[i] += weights[i] * value);
        }
        sum
    }

    /// The wavelengths that count, nm.
    pub fn wavelengths_nm(&self) -> impl Iterator<Item = f64> {
        self.samples.iter().map(|(nm, _)| *nm)
    }

    /// L*a*b* of linear RGB with respect to the white of the space, Y = 1.
    pub fn lab(&self, rgb: [f64; 3]) -> [f64; 3] {
        lab_from_xyz(self.space.xyz_from_rgb().apply(rgb), self.space.white_xyz())
    }
}
