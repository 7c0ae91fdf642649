//! Luminance and two chroma channels, as OpenEXR keeps colours in half the space: Y, RY = (R − Y)/Y and BY = (B − Y)/Y, where
//! Y is the luminance by the file's primaries (OpenEXR technical introduction, "Luminance/chroma images").

use super::Fault;
use crate::spectrum::{Chromaticities, RgbSpace};

pub fn to_rgb(mut pixels: Vec<[f32; 3]>, stated: Option<Chromaticities>) -> Result<Vec<[f32; 3]>, Fault> {
    let primaries = stated.unwrap_or_else(|| RgbSpace::Srgb.chromaticities());
    let matrix = primaries.xyz_from_rgb().ok_or_else(|| Fault::new("its chromaticities make no colours"))?;
    let [_, weights, _] = matrix.0;
    pixels.iter_mut().for_each(|pixel| {
        let [y, ry, by] = pixel.map(f64::from);
        let [r, b] = [(ry + 1.0) * y, (by + 1.0) * y];
        let g = (y - weights[0] * r - weights[2] * b) / weights[1];
        *pixel = [r, g, b].map(|channel| channel as f32);
    });
    Ok(pixels)
}
