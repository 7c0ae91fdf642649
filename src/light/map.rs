//! Surroundings from a latitude–longitude picture: the radiance of each texel, and directions chosen by it.
//!
//! Between texels nothing is interpolated: a texel is the mean over its solid angle, so its light is exactly its value times
//! that angle, also of a sun in one texel, and the density of the choice follows it exactly. Mirrors that show texels want a
//! larger picture.
//!
//! Vectors are chosen by what a texel's luminance has above the mean of all: O. Karlík, M. Šik, P. Vévoda, T. Skřivan &
//! J. Křivánek, "MIS compensation: optimizing sampling techniques in multiple importance sampling", ACM Transactions on
//! Graphics 38 (2019). What is not above it is found well enough by the directions that surfaces choose. Where
//! that leaves next to nothing, in surroundings of one luminance, all of it is chosen from.
//!
//! Measured on a ball under a sky with a sun, and under one with a wide soft light: the standard deviation of a sample is 0.55
//! and 0.61 of what it is without compensation on a matt ball, 0.33 and 0.67 on metal of roughness 0.4; with half the mean
//! taken away it lies in between. A map of 2048 × 1024 costs 0.1 µs a sample in a scene of metals, mostly for memory.

use super::distribution::Distribution;
use super::grid::Grid;
use crate::spectrum::{SpectrumId, Tint};
use glam::Vec3;

/// Of all light: less than this above the mean is rounding.
const NOTHING: f64 = 1e-6;

#[derive(Clone, Debug)]
pub struct Map {
    grid: Grid,
    tints: Vec<Tint>,
    light: SpectrumId,
    distribution: Distribution,
    /// 1 over the solid angle of a texel, by row, sr⁻¹.
    densities: Vec<f32>,
    chosen: f64,
    brightest: f64,
}

/// What a map shows in a direction.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    pub tint: Tint,
    /// Density with which [`Map::sample`] gives the direction, per steradian.
    pub pdf: f32,
}

impl Map {
    /// Rows from the top, each from the left; `light` is the spectral radiance of white, `luminances` are relative to its.
    /// `rotation` in radians, as in `grid`; `brightest` is the largest channel of a texel.
    pub fn new(
        size: [u32; 2],
        tints: Vec<Tint>,
        (luminances, brightest): (&[f32], f32),
        light: SpectrumId,
        rotation: f64,
    ) -> Self {
        let [width, height] = size;
        let grid = Grid::new(width, height, rotation);
        let angles: Vec<f64> = (0..height).map(|row| grid.solid_angle(row)).collect();
        let mean = mean(&angles, luminances, width);
        let above = |level: f64| {
            let rows = luminances.chunks(width as usize).zip(&angles);
            rows.flat_map(|(row, angle)| row.iter().map(move |y| (f64::from(*y) - level).max(0.0) * angle))
                .collect::<Vec<f64>>()
        };
        let sphere = 4.0 * std::f64::consts::PI;
        let mut weights = above(mean);
        if weights.iter().sum::<f64>() <= NOTHING * mean * sphere {
            weights = above(0.0);
        }
        Self {
            tints,
            light,
            chosen: weights.iter().sum(),
            brightest: brightest.into(),
            distribution: Distribution::new(width, &weights),
            densities: angles.iter().map(|angle| (1.0 / angle) as f32).collect(),
            grid,
        }
    }

    pub fn size(&self) -> [u32; 2] {
        [self.grid.width, self.grid.height]
    }

    /// Spectral radiance of what is white in it.
    pub fn light(&self) -> SpectrumId {
        self.light
    }

    /// ∫ over the sphere of the luminance that directions are chosen by, relative to that of white, sr.
    pub fn chosen(&self) -> f64 {
        self.chosen
    }

    /// The largest channel of a texel, relative to white: no texel is brighter in X, Y or Z than white times this.
    pub fn brightest(&self) -> f64 {
        self.brightest
    }

    #[inline]
    pub fn look(&self, direction: Vec3) -> Look {
        self.at(self.grid.texel(direction))
    }

    /// A direction for two numbers in [0, 1), and what is seen there; `None` if all is black.
    #[inline]
    pub fn sample(&self, u: [f32; 2]) -> Option<(Vec3, Look)> {
        let (texel, inside) = self.distribution.sample(u)?;
        Some((self.grid.direction(texel, inside), self.at(texel)))
    }

    #[inline]
    fn at(&self, [row, column]: [u32; 2]) -> Look {
        let tint = self.tints[row as usize * self.grid.width as usize + column as usize];
        Look { tint, pdf: self.distribution.probability([row, column]) * self.densities[row as usize] }
    }
}

/// Mean over the sphere of values by row, given the solid angle of a texel of each.
fn mean(angles: &[f64], values: &[f32], width: u32) -> f64 {
    let rows = values.chunks(width as usize).zip(angles);
    let sum: f64 = rows.map(|(row, angle)| angle * row.iter().map(|value| f64::from(*value)).sum::<f64>()).sum();
    sum / (4.0 * std::f64::consts::PI)
}

/// Mean over the sphere of the texels of a latitude–longitude picture.
pub fn mean_over_sphere([width, height]: [u32; 2], values: &[f32]) -> f64 {
    let grid = Grid::new(width, height, 0.0);
    mean(&(0..height).map(|row| grid.solid_angle(row)).collect::<Vec<_>>(), values, width)
}
