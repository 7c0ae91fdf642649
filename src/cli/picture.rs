//! What a scene says of its picture: which part of it is rendered, how it is developed, and what determines it.

use crate::film::{Develop, Developed, Exposure, Film, Gamut, Window, fnv1a_64};
use crate::fresnel::FresnelModel;
use crate::image::Metadata;
use crate::scene::Scene;
use crate::scene::describe::{ExposureValue, GamutName};
use crate::spectrum::RgbSpace;
use std::ffi::OsStr;
use std::fs;
use std::path::PathBuf;

/// The part of the picture between two corners.
pub fn window([x0, y0, x1, y1]: [u32; 4]) -> Window {
    Window { x0, y0, width: x1 - x0, height: y1 - y0 }
}

/// How a scene is developed.
pub fn development(scene: &Scene) -> Develop {
    Develop {
        exposure: match scene.picture.exposure {
            ExposureValue::Auto => Exposure::Auto,
            ExposureValue::Ev(ev) => Exposure::Ev(ev),
        },
        white: scene.picture.white,
        space: RgbSpace::Srgb,
        gamut: match scene.picture.gamut {
            GamutName::Clip => Gamut::Clip,
            GamutName::PreserveChroma => Gamut::PreserveChroma,
        },
    }
}

/// Samples of a pixel, of the mean one if they were shared out.
pub fn samples_each(film: &Film) -> u64 {
    let pixels = film.window().pixel_count();
    (film.samples() + pixels / 2) / pixels
}

/// What determines the picture.
pub fn metadata(scene: &Scene, identity: u64, film: &Film, developed: &Developed) -> Metadata {
    let settings = &scene.settings;
    let [x0, y0, x1, y1] = settings.crop;
    let metadata = Metadata::new()
        .with("version", env!("CARGO_PKG_VERSION"))
        .with("scene", format!("{identity:016x}"))
        .with("size", format!("{}x{}", settings.width, settings.height))
        .with("crop", format!("{x0},{y0},{x1},{y1}"))
        .with("samples", samples_each(film))
        .with("seed", settings.seed)
        .with("lanes", settings.lanes)
        .with("fresnel", settings.fresnel.map_or("by material", FresnelModel::name))
        .with("exposure", format!("{} EV", developed.ev))
        .with("white", &scene.picture.white_balance)
        .with("observer", &scene.picture.observer.about.name);
    // Only where something was replaced: other pictures keep the bytes that they had.
    let metadata = with_pairs(metadata, "ior", &settings.ior);
    with_pairs(metadata, "vary", &settings.vary)
}

fn with_pairs(metadata: Metadata, key: &str, pairs: &[(String, String)]) -> Metadata {
    let pairs: Vec<_> = pairs.iter().map(|(material, by)| format!("{material}={by}")).collect();
    if pairs.is_empty() { metadata } else { metadata.with(key, pairs.join(", ")) }
}

/// Identifies what is rendered: the texts of scene and materials, and every spectrum that came of them.
pub fn fingerprint(scene: &Scene) -> u64 {
    let texts: String = scene.sources.iter().map(|text| text.content.as_str()).collect();
    // A file that can no longer be read is told apart by its name.
    let hash = |path: &PathBuf| (path.file_name().map(OsStr::to_owned), fs::read(path).ok().map(|b| fnv1a_64(&b)));
    let files: Vec<_> = scene.files.iter().map(hash).collect();
    let files = if files.is_empty() { String::new() } else { format!("{files:?}") };
    fnv1a_64(format!("{texts}{:?}{files}", scene.spectra).as_bytes())
}
