//! Pictures on surfaces: colours become spectra, data become roughness.

use super::Resolver;
use crate::scene::describe::{ImageTexture, TextureSpaceName};
use crate::scene::{SceneError, Text};
use crate::spectrum::{RgbSpace, Tint, UpsampleTable, decode_srgb};
use crate::texture::{self, Encoding, Raster, Samples, Texels};
use rayon::prelude::*;

/// Bytes a texel takes beside the picture that was read: its spectrum, and a grey one's two more channels.
const BESIDE: usize = size_of::<Tint>() + 8;

impl Resolver<'_> {
    /// Reflectances of a picture of colours that `text` names.
    pub fn reflectances(&mut self, text: &Text, texture: &ImageTexture) -> Result<Texels<Tint>, SceneError> {
        let (raster, scale) = self.placed(text, texture)?;
        let size = [raster.width, raster.height];
        let name = texture.image.get_ref();
        let usual = match raster.encoding {
            Encoding::Codes => TextureSpaceName::Srgb,
            Encoding::Linear => TextureSpaceName::Linear,
        };
        let curved = texture.color_space.as_ref().map_or(usual, |space| *space.get_ref()) == TextureSpaceName::Srgb;
        let others = raster.chromaticities.filter(|stated| stated.space() != Some(RgbSpace::Srgb));
        let matrix = others.and_then(|stated| stated.to(RgbSpace::Srgb));
        if others.is_some() && matrix.is_none() {
            self.warn_of_chromaticities(name);
        }
        let table = UpsampleTable::for_reflectance(self.library)?;
        let tint = |rgb: [f32; 3]| {
            let mut linear = rgb.map(f64::from);
            if curved {
                linear = linear.map(decode_srgb);
            }
            if let Some(matrix) = &matrix {
                linear = matrix.apply(linear);
            }
            let possible = linear.map(|value| if value >= 0.0 { value.min(1.0) } else { 0.0 });
            // What is off by rounding is not worth a word.
            let changed = linear.iter().zip(possible).any(|(a, b)| (a - b).abs() > 1e-5 || a.is_nan());
            (table.tint(possible.map(|value| value as f32)), changed)
        };
        let (tints, changed): (Vec<Tint>, Vec<bool>) = raster.into_rgb().into_par_iter().map(tint).unzip();
        let count = changed.iter().filter(|changed| **changed).count();
        if count > 0 {
            self.warnings.push(format!(
                "`{name}`: {count} of {} texels are no colours of a reflectance: their channels are cut to 0…1",
                tints.len()
            ));
        }
        Ok(Texels::new(size, tints, scale, texture.wrap.into()))
    }

    /// Values of a picture of data, 0…1.
    pub fn data_texels(&mut self, text: &Text, texture: &ImageTexture) -> Result<Texels<f32>, SceneError> {
        if let Some(space) = &texture.color_space {
            return Err(text.error(&space.span(), "roughness is data, not a colour: it has no colour space"));
        }
        let (raster, scale) = self.placed(text, texture)?;
        let size = [raster.width, raster.height];
        let name = texture.image.get_ref();
        let values = match raster.samples {
            Samples::Grey(values) => values,
            Samples::Rgb(colors) => {
                let colored = colors.iter().filter(|[r, g, b]| r != g || g != b).count();
                if colored > 0 {
                    let message = format!(
                        "`{name}` has three channels, which differ in {colored} of {} texels: roughness is one number",
                        colors.len()
                    );
                    return Err(text.error(&texture.image.span(), message).help("give a grey picture"));
                }
                colors.into_iter().map(|[value, ..]| value).collect()
            }
        };
        let possible = |value: f32| if value >= 0.0 { value.min(1.0) } else { 0.0 };
        let count = values.iter().filter(|value| possible(**value) != **value).count();
        if count > 0 {
            self.warnings
                .push(format!("`{name}`: {count} of {} texels are no roughness: they are cut to 0…1", values.len()));
        }
        let values = values.into_iter().map(possible).collect();
        Ok(Texels::new(size, values, scale, texture.wrap.into()))
    }

    /// A picture, and how often it stands on its surface.
    fn placed(&mut self, text: &Text, texture: &ImageTexture) -> Result<(Raster, [f32; 2]), SceneError> {
        let (name, span) = (texture.image.get_ref(), texture.image.span());
        let path = text.base().join(name);
        self.files.insert(path.clone());
        let raster = texture::read(&path, BESIDE).map_err(|error| text.error(&span, error))?;
        for note in &raster.notes {
            self.warnings.push(format!("`{name}`: {note}"));
        }
        let scale = texture.scale.map_or([1.0; 2], |scale| scale.values()).map(|side| side as f32);
        Ok((raster, scale))
    }
}
