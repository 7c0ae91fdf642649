//! A reference from a file that spectrel wrote: EXR with linear RGB of the display, or with XYZ.

use crate::report::difference::Image;
use crate::scene::{Scene, SceneError};
use crate::spectrum::{Chromaticities, Matrix3, RgbSpace, bradford};
use crate::texture::{self, Raster};
use exr::meta::MetaData;
use exr::meta::attribute::AttributeValue;
use exr::meta::header::Header;
use std::path::{Path, PathBuf};

/// A picture with what it says of itself.
#[derive(Debug)]
pub struct File {
    path: PathBuf,
    raster: Raster,
    /// Of the display, cd/m².
    white: f64,
    /// What is white, by name.
    white_balance: Option<String>,
    pub samples: Option<u64>,
}

impl File {
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        let wrong = |what: &str| {
            SceneError::new(format!("--reference {}: {what}", path.display()))
                .help("give an .exr that `spectrel render` wrote of the same scene")
        };
        if !path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("exr")) {
            return Err(wrong("a reference is an .exr, for other files hold no light"));
        }
        let raster = texture::read(path, size_of::<[f32; 3]>())
            .map_err(|error| SceneError::new(format!("--reference: {error}")))?;
        let meta = MetaData::read_from_file(path, false).map_err(|error| wrong(&error.to_string()))?;
        let header = meta.headers.first().ok_or_else(|| wrong("it holds nothing"))?;
        let (data, display) = (header.data_window().size, header.shared_attributes.display_window.size);
        if data != display {
            let [part, whole] = [data, display].map(|size| format!("{} × {}", size.0, size.1));
            return Err(wrong(&format!("it is a part of {part} pixels of a picture of {whole}")));
        }
        let white = header.own_attributes.white_luminance;
        let white = white.ok_or_else(|| wrong("it does not say how bright its white is (`whiteLuminance`)"))?;
        Ok(Self {
            path: path.to_owned(),
            raster,
            white: white.into(),
            white_balance: said(header, "white"),
            samples: said(header, "samples").and_then(|samples| samples.parse().ok()),
        })
    }

    pub fn name(&self) -> String {
        self.path.display().to_string()
    }

    pub fn size(&self) -> [u32; 2] {
        [self.raster.width, self.raster.height]
    }

    /// XYZ in cd/m² of the same scene.
    pub fn image(self, scene: &Scene) -> Result<Image, SceneError> {
        let to_xyz = self.to_xyz(scene)?;
        let xyz = |rgb: [f32; 3]| to_xyz.apply(rgb.map(f64::from)).map(|c| c as f32);
        Ok(self.raster.into_rgb().into_iter().map(xyz).collect())
    }

    fn to_xyz(&self, scene: &Scene) -> Result<Matrix3, SceneError> {
        let error = |what: String| SceneError::new(format!("--reference {}: {what}", self.name()));
        let stated = self.raster.chromaticities.ok_or_else(|| error("it does not say what its colours are".into()))?;
        let scale = Matrix3::diagonal([self.white; 3]);
        // Primaries that are X, Y and Z themselves: nothing was done to the film's values.
        if stated.primaries_xy == Chromaticities::XYZ.primaries_xy {
            return Ok(scale);
        }
        let of_scene = &scene.picture.white_balance;
        if let Some(of_file) = self.white_balance.as_ref().filter(|white| *white != of_scene) {
            return Err(error(format!("its white is {of_file}, that of the scene is {of_scene}")));
        }
        let space = stated.space().unwrap_or(RgbSpace::Srgb);
        let to_xyz = stated.xyz_from_rgb().unwrap_or_else(|| space.xyz_from_rgb());
        let white = scene.picture.white;
        let back = bradford(space.white_xyz(), white.map(|c| c / white[1]));
        Ok(scale.after(&back).after(&to_xyz))
    }
}

/// What spectrel wrote of the picture under a name.
fn said(header: &Header, key: &str) -> Option<String> {
    let name = format!("{}{key}", crate::image::metadata::PREFIX);
    let all = header.own_attributes.other.iter();
    let (_, value) = all.chain(&header.shared_attributes.other).find(|(known, _)| **known == *name.as_str())?;
    match value {
        AttributeValue::Text(text) => Some(text.to_string()),
        _ => None,
    }
}
