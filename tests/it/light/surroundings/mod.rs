//! Surroundings from a picture: directions follow their density, and renders show and receive the light that is in the texels.

mod directions;
mod looks;
mod renders;
use crate::common::pictures::write_exr;
use std::f64::consts::PI;
use tempfile::TempDir;

/// A picture of all directions in a folder of its own.
pub struct Picture {
    folder: TempDir,
    pub width: usize,
    pub pixels: Vec<[f32; 3]>,
}

impl Picture {
    pub fn new(width: usize, pixels: Vec<[f32; 3]>) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        write_exr(&folder.path().join("sky.exr"), width, &pixels);
        Self { folder, width, pixels }
    }

    pub fn constant(width: usize, height: usize, value: f32) -> Self {
        Self::new(width, vec![[value; 3]; width * height])
    }

    /// Dark but for one grey texel.
    pub fn bright(width: usize, height: usize, [row, column]: [usize; 2], value: f32) -> Self {
        let mut pixels = vec![[0.0; 3]; width * height];
        pixels[row * width + column] = [value; 3];
        Self::new(width, pixels)
    }

    pub fn height(&self) -> usize {
        self.pixels.len() / self.width
    }

    /// The scene's words for it, with another key.
    pub fn environment(&self, more: &str) -> String {
        let path = self.folder.path().join("sky.exr");
        let more = if more.is_empty() { String::new() } else { format!(", {more}") };
        format!("environment.image = {{ file = {path:?}, illuminant = \"E\"{more} }}\n")
    }

    /// Vectors spread evenly over the angles of a texel, each with its part of the solid angle, sr.
    pub fn directions(&self, [row, column]: [usize; 2]) -> impl Iterator<Item = ([f64; 3], f64)> {
        const GRID: usize = 64;
        let (dv, du) = (PI / self.height() as f64, 2.0 * PI / self.width as f64);
        (0..GRID * GRID).map(move |i| {
            let part = |k: usize| (k as f64 + 0.5) / GRID as f64;
            let theta = dv * (row as f64 + part(i / GRID));
            let psi = du * (column as f64 + part(i % GRID)) - PI;
            let direction = [theta.sin() * psi.sin(), theta.sin() * psi.cos(), theta.cos()];
            (direction, theta.sin() * dv * du / (GRID * GRID) as f64)
        })
    }

    /// ∫ Y max(cos, 0) against +z: what a level plane receives. Over a texel that is Δψ (sin² θ₁ − sin² θ₀)/2.
    pub fn irradiance(&self) -> f64 {
        let height = self.height() as f64;
        let squared = |edge: usize| (PI * edge as f64 / height).min(PI / 2.0).sin().powi(2);
        let texel = |(i, rgb): (usize, &[f32; 3])| {
            let row = i / self.width;
            f64::from(rgb[1]) * PI / self.width as f64 * (squared(row + 1) - squared(row))
        };
        self.pixels.iter().enumerate().map(texel).sum()
    }
}
