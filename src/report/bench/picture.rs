//! What a scene looks like, small, beside its numbers.

use super::super::difference::Image;
use crate::film::View;
use crate::image::{ImageError, png};
use crate::spectrum::encode_srgb;

/// A PNG of an image of [width, height] pixels; what a display cannot show is cut off.
pub fn picture(view: &View, image: &Image, [width, height]: [u32; 2]) -> Result<Vec<u8>, ImageError> {
    let code = |linear: f64| (255.0 * encode_srgb(linear).clamp(0.0, 1.0)).round() as u8;
    let pixel = |xyz: &[f32; 3]| view.rgb(view.display(*xyz)).map(code);
    png::encode_srgb8(width, height, &image.iter().flat_map(pixel).collect::<Vec<_>>())
}
