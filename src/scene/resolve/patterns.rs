//! Pictures on surfaces: colours become spectra, data become roughness.

use super::Resolver;
use super::colors::Reading;
use crate::scene::describe::ImageTexture;
use crate::scene::{SceneError, Text};
use crate::spectrum::{Tint, UpsampleTable};
use crate::texture::{self, Raster, Samples, Texels};
use rayon::prelude::*;

/// Bytes a texel takes beside the picture that was read: its spectrum, and a grey one's two more channels.
const BESIDE: usize = size_of::<Tint>() + 8;

impl Resolver<'_> {
    /// Reflectances of a picture of colours that `text` names.
    pub fn reflectances(&mut self, text: &Text, texture: &ImageTexture) -> Result<Texels<Tint>, SceneError> {
        let (raster, scale) = self.placed(text, texture)?;
        let size = [raster.width, raster.height];
        let name = texture.image.get_ref();
        let reading = Reading::new(&raster, texture.color_space.as_ref().map(|space| *space.get_ref()));
        if reading.odd {
            self.warn_of_chromaticities(name);
        }
        let table = UpsampleTable::for_reflectance(self.library)?;
        let tint = |rgb: [f64; 3]| {
            let linear = reading.linear_srgb(rgb);
            let possible = linear.map(|value| if value >= 0.0 { value.min(1.0) } else { 0.0 });
            // What is off by rounding is not worth a word.
            let changed = linear.iter().zip(possible).any(|(a, b)| (a - b).abs() > 1e-5 || a.is_nan());
            (table.tint(possible.map(|value| value as f32)), changed)
        };
        let texels = (size[0] as usize) * size[1] as usize;
        let indexed = match raster.samples {
            Samples::Codes(codes) => codes.indexed().map_err(Samples::Codes),
            samples => Err(samples),
        };
        let (found, count) = match indexed {
            Ok((colors, index)) => {
                let (tints, changed): (Vec<Tint>, Vec<bool>) = colors.into_par_iter().map(tint).unzip();
                let count = index.count(&changed);
                (Texels::indexed(size, tints, index, scale, texture.wrap.into()), count)
            }
            Err(samples) => {
                let (rgb, endless) = Raster { samples, ..raster }.into_finite_rgb();
                self.warn_of_endless(name, endless, texels);
                let tints = rgb.into_par_iter().map(|rgb| tint(rgb.map(f64::from)));
                let (tints, changed): (Vec<Tint>, Vec<bool>) = tints.unzip();
                let count = changed.into_iter().filter(|changed| *changed).count();
                (Texels::new(size, tints, scale, texture.wrap.into()), count)
            }
        };
        if count > 0 {
            self.warnings.push(format!(
                "`{name}`: {count} of {texels} texels are no colours of a reflectance: their channels are cut to 0…1"
            ));
        }
        Ok(found)
    }

    /// Values of a picture of data, 0…1.
    pub fn data_texels(&mut self, text: &Text, texture: &ImageTexture) -> Result<Texels<f32>, SceneError> {
        if let Some(space) = &texture.color_space {
            return Err(text.error(&space.span(), "roughness is data, not a colour: it has no colour space"));
        }
        let (raster, scale) = self.placed(text, texture)?;
        let (size, wrap) = ([raster.width, raster.height], texture.wrap.into());
        let name = texture.image.get_ref();
        let colored = colored(&raster.samples);
        if colored > 0 {
            let texels = (size[0] as usize) * size[1] as usize;
            let message = format!(
                "`{name}` has three channels, which differ in {colored} of {texels} texels: roughness is one number"
            );
            return Err(text.error(&texture.image.span(), message).help("give a grey picture"));
        }
        let values: Vec<f32> = match raster.samples {
            Samples::Grey(values) => values,
            Samples::Rgb(colors) => colors.into_iter().map(|[value, ..]| value).collect(),
            Samples::Codes(codes) => match codes.indexed() {
                Ok((colors, index)) => {
                    let values = colors.into_iter().map(|[value, ..]| value as f32).collect();
                    return Ok(Texels::indexed(size, values, index, scale, wrap));
                }
                Err(codes) => codes.colors().map(|[value, ..]| value as f32).collect(),
            },
        };
        let possible = |value: f32| if value >= 0.0 { value.min(1.0) } else { 0.0 };
        let count = values.iter().filter(|value| possible(**value) != **value).count();
        if count > 0 {
            self.warnings
                .push(format!("`{name}`: {count} of {} texels are no roughness: they are cut to 0…1", values.len()));
        }
        let values = values.into_iter().map(possible).collect();
        Ok(Texels::new(size, values, scale, wrap))
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

/// How many texels are not grey.
fn colored(samples: &Samples) -> usize {
    match samples {
        Samples::Grey(_) => 0,
        Samples::Rgb(colors) => colors.iter().filter(|[r, g, b]| r != g || g != b).count(),
        Samples::Codes(codes) => codes.colors().filter(|[r, g, b]| r != g || g != b).count(),
    }
}
