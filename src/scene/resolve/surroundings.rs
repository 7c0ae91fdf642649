//! Surroundings from a picture: texels become spectra, whose white has the strength that the scene gives it.

use super::Resolver;
use super::emission::BRIGHTEST;
use crate::light::{Emitter, Map, Source, mean_over_sphere};
use crate::scene::SceneError;
use crate::scene::describe::{ColorSpaceName, EnvironmentImage, LightSpectrum};
use crate::spectrum::{About, Matrix3, RgbSpace, SpectrumId, Tint, UpsampleTable};
use crate::texture::{self, Encoding, Raster};
use rayon::prelude::*;

/// Bytes a texel takes beside the picture that was read: its spectrum, its luminance, its weight, the sum of these, and a grey
/// one's two more channels.
const BESIDE: usize = size_of::<Tint>() + 4 + 8 + 4 + 8;

/// What is white in a picture unless the scene says otherwise.
const ILLUMINANT: &str = "D65";

/// Where the values of files in no known space go: what is outside of it, next to no light has.
const WIDE: RgbSpace = RgbSpace::Rec2020;

/// Beyond this a sum of values has no digits left.
const LARGEST_VALUE: f32 = 1e30;

/// A picture all around.
pub struct Surroundings {
    pub map: Map,
    /// Mean, cd/m².
    pub luminance: f64,
    /// cd/m² of white.
    scale: f64,
}

impl Surroundings {
    /// The light that directions are aimed at, beside others around a scene in a ball of this radius: what comes through its
    /// cross-section, over the π that a lamp's power lacks too.
    pub fn emitter(&self, radius: f64) -> Emitter {
        let power = self.map.chosen() * self.scale * radius * radius;
        Emitter { source: Source::Map, radiance: self.map.light(), power }
    }
}

impl Resolver<'_> {
    pub fn surroundings(&mut self, image: &EnvironmentImage) -> Result<Surroundings, SceneError> {
        let raster = self.raster(image)?;
        let size = [raster.width, raster.height];
        let stated = raster.white_luminance;
        let colors = self.colors(raster, image);
        let table = UpsampleTable::for_radiance(self.library, colors.space)?;
        let [_, y, _] = colors.space.xyz_from_rgb().0;
        let luminance = |rgb: &[f32; 3]| (0..3).map(|i| y[i] * f64::from(rgb[i])).sum::<f64>().max(0.0) as f32;
        let luminances: Vec<f32> = colors.rgb.par_iter().map(luminance).collect();
        let mean = mean_over_sphere(size, &luminances);
        let scale = self.scale(image, mean, stated)?;
        self.check_brightness(image, &colors.rgb, scale)?;
        let tints = colors.rgb.par_iter().map(|rgb| table.tint(*rgb)).collect();
        let light = self.white(image, scale)?;
        let rotation = match &image.rotate {
            Some(degrees) => self.finite(degrees, "rotate")?.to_radians(),
            None => 0.0,
        };
        let brightest = colors.rgb.iter().flatten().copied().fold(0.0, f32::max);
        let map = Map::new(size, tints, (&luminances, brightest), light, rotation);
        Ok(Surroundings { map, luminance: mean * scale, scale })
    }

    /// The illuminant at this luminance.
    fn white(&mut self, image: &EnvironmentImage, luminance: f64) -> Result<SpectrumId, SceneError> {
        let named = LightSpectrum::Name(ILLUMINANT.into());
        let (source, span) = match &image.illuminant {
            Some(illuminant) => (illuminant.get_ref(), illuminant.span()),
            None => (&named, image.file.span()),
        };
        let (spectrum, _) = self.light_spectrum(source, &span, "the environment")?;
        let factor = self.factor("luminance", luminance, &spectrum, &span)?;
        Ok(self.spectra.add(spectrum.scaled(factor)))
    }

    /// The file of radiances, with what is to be said of it.
    fn raster(&mut self, image: &EnvironmentImage) -> Result<Raster, SceneError> {
        let (name, span) = (image.file.get_ref(), image.file.span());
        let path = self.text.base().join(name);
        self.files.insert(path.clone());
        let raster = texture::read(&path, BESIDE).map_err(|error| self.text.error(&span, error))?;
        if raster.encoding() != Encoding::Linear {
            let message = format!("`{name}` holds what a display shows, not the light of surroundings");
            return Err(self.text.error(&span, message).help("give an .exr or .hdr file"));
        }
        for note in &raster.notes {
            self.warnings.push(format!("`{name}`: {note}"));
        }
        let [width, height] = [raster.width, raster.height];
        if u64::from(width) != 2 * u64::from(height) && (width, height) != (1, 1) {
            self.warnings.push(format!(
                "`{name}` has {width} × {height} texels: a picture of all directions is twice as wide as high, so this one is stretched"
            ));
        }
        self.note_data("the environment", &About { name: name.clone(), ..About::default() });
        Ok(raster)
    }

    /// Its linear RGB in a space that has a table, without what light cannot have.
    fn colors(&mut self, raster: Raster, image: &EnvironmentImage) -> Colors {
        let name = image.file.get_ref();
        let stated = image.color_space.map(ColorSpaceName::chromaticities).or(raster.chromaticities);
        let (space, matrix) = match stated.map(|stated| (stated.space(), stated.to(WIDE))) {
            None => (RgbSpace::Srgb, None),
            Some((Some(space), _)) => (space, None),
            Some((None, Some(matrix))) => (WIDE, Some(matrix)),
            Some((None, None)) => {
                self.warn_of_chromaticities(name);
                (RgbSpace::Srgb, None)
            }
        };
        let (mut rgb, endless) = raster.into_finite_rgb();
        let counts = rgb.par_iter_mut().map(|rgb| clean(rgb, &matrix));
        let [bad, outside] = counts.reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        let all = rgb.len();
        self.warn_of_endless(name, endless, all);
        if bad > 0 {
            self.warnings.push(format!(
                "`{name}`: {bad} of {all} texels have values that are negative or no numbers: these count as 0"
            ));
        }
        if outside > 0 {
            self.warnings.push(format!(
                "`{name}`: {outside} of {all} texels have colours outside of {}: they are moved to its edge",
                space.name()
            ));
        }
        Colors { space, rgb }
    }

    /// cd/m² of white, given the mean of the file's Y and what the file says.
    fn scale(&mut self, image: &EnvironmentImage, mean: f64, stated: Option<f64>) -> Result<f64, SceneError> {
        match (&image.scale, &image.luminance) {
            (None, None) => {
                let white = stated.unwrap_or(1.0);
                if white != 1.0 {
                    let name = image.file.get_ref();
                    let note = format!("`{name}`: its header states a white of {white} cd/m², which is its scale");
                    self.warnings.push(note);
                }
                Ok(white)
            }
            (Some(scale), None) => self.not_negative(scale, "scale"),
            (None, Some(luminance)) => {
                let value = self.not_negative(luminance, "luminance")?;
                if mean > 0.0 {
                    return Ok(value / mean);
                }
                Err(self.text.error(
                    &luminance.span(),
                    format!("`{}` is black: no factor gives it a luminance", image.file.get_ref()),
                ))
            }
            (Some(_), Some(luminance)) => {
                Err(self.text.error(&luminance.span(), "`scale` and `luminance` both say how strong the light is"))
            }
        }
    }

    fn check_brightness(&self, image: &EnvironmentImage, rgb: &[[f32; 3]], scale: f64) -> Result<(), SceneError> {
        let largest = rgb.iter().flatten().copied().fold(0.0, f32::max);
        let brightest = f64::from(largest) * scale;
        if brightest <= BRIGHTEST && largest <= LARGEST_VALUE {
            return Ok(());
        }
        let message = format!("the brightest texel has {brightest:.2e} cd/m²: a light can have up to {BRIGHTEST:e}");
        Err(self.text.error(&image.file.span(), message).help("give a smaller `scale`"))
    }
}

struct Colors {
    space: RgbSpace,
    rgb: Vec<[f32; 3]>,
}

/// Takes from a texel, which has no infinite value, what light cannot have. Counts 1 where it had a value that none has, and 1 where it was no mixture of
/// the primaries that are computed with.
fn clean(rgb: &mut [f32; 3], matrix: &Option<Matrix3>) -> [usize; 2] {
    let possible = |value: f32| if value >= 0.0 && value.is_finite() { value } else { 0.0 };
    let good = rgb.map(possible);
    let bad = good != *rgb;
    let converted = match matrix {
        Some(matrix) => matrix.apply(good.map(f64::from)).map(|value| value as f32),
        None => good,
    };
    // Rounding of the matrix alone puts no colour outside.
    let largest = converted.into_iter().fold(0.0, f32::max);
    let outside = converted.iter().any(|value| *value < -1e-5 * largest);
    *rgb = converted.map(|value| value.max(0.0));
    [usize::from(bad), usize::from(outside)]
}
