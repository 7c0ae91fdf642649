//! Size, samples and the other settings: the scene's, or the command line's over them.

use super::Resolver;
use crate::camera::Filter;
use crate::fresnel::FresnelModel;
use crate::scene::describe::{self, FilterName, SamplerName};
use crate::scene::{SceneError, Settings};
use toml::Spanned;

/// What a command line says over a scene file.
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    /// Pixels.
    pub width: Option<u32>,
    /// Pixels.
    pub height: Option<u32>,
    /// x0, y0, x1, y1 in pixels, the upper ends excluded.
    pub crop: Option<[u32; 4]>,
    /// Samples a pixel.
    pub samples: Option<u32>,
    pub seed: Option<u64>,
    /// For every material.
    pub fresnel: Option<FresnelModel>,
    /// Wavelengths a path carries: 1, 4 or 8.
    pub lanes: Option<u32>,
    pub sampler: Option<SamplerName>,
    /// Every dielectric has its n of the helium d line at all wavelengths.
    pub without_dispersion: bool,
    /// Materials by the scene's names, and the data sets of n and k that they take in place of their own.
    pub ior: Vec<(String, String)>,
    /// Materials by the scene's names, and the materials that replace them.
    pub vary: Vec<(String, String)>,
}

/// A picture's size unless the scene or the command line says otherwise.
const SIZE: [u32; 2] = [960, 640];
const SAMPLES: u32 = 128;

impl Resolver<'_> {
    pub fn settings(&self, render: &describe::Render, overrides: &Overrides) -> Result<Settings, SceneError> {
        let [width, height] = self.size(render, overrides)?;
        Ok(Settings {
            width,
            height,
            crop: crop(overrides.crop, [width, height])?,
            samples: match overrides.samples {
                Some(samples) => from_command_line(samples, "spp")?,
                None => self.count(&render.samples, "samples")?.unwrap_or(SAMPLES),
            },
            seed: overrides.seed.or(render.seed).unwrap_or(0),
            max_depth: self.count(&render.max_depth, "max_depth")?,
            sampler: overrides.sampler.unwrap_or(render.sampler),
            filter: render.filter,
            fresnel: overrides.fresnel.or(render.fresnel),
            lanes: overrides.lanes.unwrap_or(crate::math::LANES as u32),
            ior: overrides.ior.clone(),
            vary: overrides.vary.clone(),
        })
    }

    /// Width and height in pixels; of one given alone the other follows by the scene's proportions.
    fn size(&self, render: &describe::Render, overrides: &Overrides) -> Result<[u32; 2], SceneError> {
        let own_width = self.count(&render.width, "width")?.unwrap_or(SIZE[0]);
        let own_height = self.count(&render.height, "height")?.unwrap_or(SIZE[1]);
        let follow = |given: u32, own: u32, other: u32| {
            (f64::from(given) * f64::from(other) / f64::from(own)).round().clamp(1.0, f64::from(u32::MAX)) as u32
        };
        let width = overrides.width.map(|width| from_command_line(width, "width")).transpose()?;
        let height = overrides.height.map(|height| from_command_line(height, "height")).transpose()?;
        Ok(match (width, height) {
            (None, None) => [own_width, own_height],
            (Some(width), None) => [width, follow(width, own_width, own_height)],
            (None, Some(height)) => [follow(height, own_height, own_width), height],
            (Some(width), Some(height)) => [width, height],
        })
    }

    fn count(&self, number: &Option<Spanned<u32>>, name: &str) -> Result<Option<u32>, SceneError> {
        match number {
            Some(number) if *number.get_ref() == 0 => {
                Err(self.text.error(&number.span(), format!("`{name}` is 0: it must be at least 1")))
            }
            number => Ok(number.as_ref().map(|number| *number.get_ref())),
        }
    }
}

fn from_command_line(count: u32, option: &str) -> Result<u32, SceneError> {
    if count == 0 { Err(SceneError::new(format!("--{option} is 0: it must be at least 1"))) } else { Ok(count) }
}

fn crop(given: Option<[u32; 4]>, [width, height]: [u32; 2]) -> Result<[u32; 4], SceneError> {
    let crop = given.unwrap_or([0, 0, width, height]);
    let [x0, y0, x1, y1] = crop;
    if x0 < x1 && x1 <= width && y0 < y1 && y1 <= height {
        return Ok(crop);
    }
    let message = format!("--crop {x0},{y0},{x1},{y1} is no part of a picture of {width} × {height} pixels");
    Err(SceneError::new(message).help("give x0,y0,x1,y1 with x0 < x1 and y0 < y1, the upper ends excluded"))
}

pub fn filter(name: FilterName) -> Filter {
    match name {
        FilterName::Box => Filter::Box,
        FilterName::Tent => Filter::Tent,
        FilterName::BlackmanHarris => Filter::blackman_harris(),
    }
}
