//! What `spectrel render` writes beside the picture: AOVs into EXR files, bands of wavelength into spectral ones.

use crate::adaptive::{Aim, Noise, Pilot};
use crate::cli::effort::EffortArgs;
use crate::cli::memory;
use crate::film::View;
use crate::film::{Develop, Developed, FilmError, Layers, REPLICATES, Replicates, Wanted, Window};
use crate::image::channels::FAR;
use crate::image::{Channel, ExrSpace, Extra, Format, Metadata, spectral};
use crate::render::{FirstHit, Guides, Kernel, Recorder, first_hits};
use crate::scene::{Needs, Scene, SceneError};
use crate::spectrum::{Bins, Matrix3, RgbSpace};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

#[derive(Clone, Debug, Args)]
pub struct LayerArgs {
    /// Layers of the EXR files beside the picture, separated by commas (variance and noise render 8 independent
    /// replicates of each pixel, with another and somewhat stronger noise)
    #[arg(long, value_name = "LAYER,…", value_enum, value_delimiter = ',')]
    aovs: Vec<Aov>,
    /// Albedo and normal as denoisers want them, into the EXR files: as --aovs albedo,normal but seen in mirrors too
    #[arg(long)]
    denoise_inputs: bool,
    /// Bands of the files that end in .spectral.exr: centres in nm, as wide as the step [default: 380:10:780]
    #[arg(long, value_name = "FIRST:STEP:LAST")]
    spectral: Option<Bins>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Aov {
    Albedo,
    Normal,
    Depth,
    Variance,
    /// ΔE2000 that the noise makes, and samples a pixel.
    Noise,
    Object,
    All,
}

/// What is to be recorded, and what of it goes into files.
#[derive(Clone, Debug)]
pub struct Recording {
    aovs: Vec<Aov>,
    mirrors: bool,
    bins: Option<Bins>,
    /// Whether the render stops by its error.
    judged: bool,
    /// What samples are shared out for.
    aim: Option<Aim>,
}

/// Whether a file's name asks for bands of wavelength.
fn is_spectral(path: &Path) -> bool {
    path.to_string_lossy().to_ascii_lowercase().ends_with(spectral::ENDING)
}

impl LayerArgs {
    /// Fails if no file could hold what is asked for.
    pub fn recording(&self, outputs: &[PathBuf], effort: &EffortArgs) -> Result<Recording, SceneError> {
        let exr = |path: &&PathBuf| matches!(Format::of(path), Ok(Format::Exr));
        let (bands, plain): (Vec<_>, Vec<_>) = outputs.iter().filter(exr).partition(|path| is_spectral(path));
        let option = if self.denoise_inputs { "--denoise-inputs" } else { "--aovs" };
        if plain.is_empty() && (self.denoise_inputs || !self.aovs.is_empty()) {
            let why = match bands.is_empty() {
                true => "layers need an EXR file",
                false => "layers stand beside colours, and a .spectral.exr has bands",
            };
            let message = format!("{option} has no file to go into: {why}");
            return Err(SceneError::new(message).help("add -o picture.exr"));
        }
        if bands.is_empty() && self.spectral.is_some() {
            let message = "--spectral has no file to go into: bands are written into files that end in .spectral.exr";
            return Err(SceneError::new(message).help("add -o picture.spectral.exr"));
        }
        let bins = (!bands.is_empty()).then(|| self.spectral.unwrap_or_default());
        let aovs = if self.aovs.contains(&Aov::All) { Aov::value_variants().to_vec() } else { self.aovs.clone() };
        Ok(Recording { aovs, mirrors: self.denoise_inputs, bins, judged: effort.judges(), aim: effort.shares_out() })
    }
}

impl Recording {
    fn has(&self, aov: Aov) -> bool {
        self.aovs.contains(&aov)
            || (self.judged && aov == Aov::Noise)
            || (self.mirrors && matches!(aov, Aov::Albedo | Aov::Normal))
    }

    /// Whether replicates of each pixel are compared.
    fn compares(&self) -> bool {
        self.has(Aov::Variance) || self.has(Aov::Noise)
    }

    fn wanted(&self) -> Wanted {
        Wanted {
            features: self.has(Aov::Albedo) || self.has(Aov::Normal),
            replicates: self.compares(),
            bands: self.bins.map_or(0, |bins| bins.count()),
        }
    }

    /// Empty layers, if the scene's settings and the memory allow them.
    pub fn layers(&self, scene: &Scene, window: Window) -> Result<Layers, SceneError> {
        let least = REPLICATES as u32;
        if self.compares() && !self.judged && scene.settings.samples < least {
            let message =
                format!("variance and noise compare {least} replicates of each pixel: they need --spp {least} or more");
            return Err(SceneError::new(message));
        }
        let channels = 3 * self.aovs.len() + self.wanted().bands;
        let a_pixel = self.wanted().bytes_per_pixel();
        let parts = if self.aim.is_some() && !self.compares() { Pilot::BYTES } else { 0 };
        // One half is kept as it was while it judges the other one.
        let kept = if self.judged { a_pixel.div_ceil(2) } else { 0 };
        memory::check(window, a_pixel + parts + kept, channels)?;
        Layers::new([scene.settings.width, scene.settings.height], window, self.wanted()).map_err(SceneError::new)
    }

    pub fn recorder<'a>(&self, kernel: &'a Kernel<'a>, scene: &Scene, needs: &Needs) -> Recorder<'a> {
        let guides = self.wanted().features.then(|| match self.mirrors {
            true => Guides::behind_mirrors(scene, needs, RgbSpace::Srgb),
            false => Guides::first_hit(scene, needs, RgbSpace::Srgb),
        });
        Recorder::new(kernel, guides, self.bins.as_ref())
    }

    /// What goes into a file beside the picture.
    pub fn extra(&self, path: &Path, scene: &Scene, layers: &Layers, picture: &Picture) -> Extra {
        match &self.bins {
            Some(bins) if is_spectral(path) => spectral::extra(layers, bins),
            _ => Extra { channels: self.channels(scene, layers, picture), attributes: vec![] },
        }
    }

    fn channels(&self, scene: &Scene, layers: &Layers, picture: &Picture) -> Vec<Channel> {
        let mut channels = Vec::new();
        if self.has(Aov::Albedo) {
            let albedo: Vec<_> = layers.features().iter().map(|pixel| picture.color(pixel.albedo())).collect();
            channels.extend(Channel::triple("albedo", ["R", "G", "B"], false, &albedo));
        }
        if self.has(Aov::Normal) {
            let normal: Vec<_> = layers.features().iter().map(|pixel| pixel.normal()).collect();
            channels.extend(Channel::triple("normal", ["X", "Y", "Z"], false, &normal));
        }
        if self.has(Aov::Variance) {
            let of = |pixel: &Replicates| pixel.variance_of_mean(&picture.from_xyz).map(|v| v as f32);
            let variance: Vec<_> = layers.replicates().iter().map(of).collect();
            channels.extend(Channel::triple("variance", ["R", "G", "B"], true, &variance));
        }
        if self.has(Aov::Noise) {
            channels.push(Channel::new(
                "noise.dE",
                Noise::of(layers.replicates(), layers.film().window().width as usize, &picture.viewing).de,
            ));
        }
        if self.has(Aov::Noise) || self.aim.is_some() {
            let counts = layers.film().pixels().iter().map(|pixel| pixel.count() as f32);
            channels.push(Channel::new("samples.N", counts.collect()));
        }
        channels.extend(self.of_first_hits(scene, layers.film().window()));
        channels
    }

    fn of_first_hits(&self, scene: &Scene, window: Window) -> Vec<Channel> {
        let (depth, object) = (self.has(Aov::Depth), self.has(Aov::Object));
        if !depth && !object {
            return vec![];
        }
        let hits = first_hits(scene, window);
        let channel = |name, value: fn(&FirstHit) -> f32, nothing: f32| {
            Channel::new(name, hits.iter().map(|hit| hit.as_ref().map_or(nothing, value)).collect())
        };
        let depth = depth.then(|| channel("depth.Z", |hit| hit.depth, FAR));
        let object = object.then(|| channel("object.id", |hit| (hit.object + 1) as f32, 0.0));
        depth.into_iter().chain(object).collect()
    }

    /// What a file says of itself.
    pub fn describe(&self, path: &Path, scene: &Scene, metadata: &Metadata) -> Result<Metadata, SceneError> {
        let metadata = &self.aim.map_or_else(|| metadata.clone(), |aim| metadata.clone().with("adaptive", aim.name()));
        if let (Some(bins), true) = (&self.bins, is_spectral(path)) {
            return Ok(spectral::describe(metadata, bins));
        }
        if !self.has(Aov::Object) || !matches!(Format::of(path), Ok(Format::Exr)) {
            return Ok(metadata.clone());
        }
        let names: Vec<&str> = scene.objects.iter().map(|object| object.name.as_str()).collect();
        let names = serde_json::to_string(&names).map_err(SceneError::new)?;
        Ok(metadata.clone().with("objects", format!("0 is nothing, then from 1: {names}")))
    }
}

/// The space of an EXR file's colours.
pub struct Picture {
    /// From the film's XYZ.
    from_xyz: Matrix3,
    /// From linear RGB.
    from_rgb: Matrix3,
    viewing: View,
}

impl Picture {
    /// Of a film that was developed so.
    pub fn new(developed: &Developed, develop: &Develop, space: ExrSpace) -> Result<Self, FilmError> {
        let viewing = View::new(developed.ev, developed.white);
        Ok(match space {
            ExrSpace::Rgb => Self { from_xyz: develop.matrix(developed.ev)?, from_rgb: Matrix3::IDENTITY, viewing },
            ExrSpace::Xyz => Self { from_xyz: Matrix3::IDENTITY, from_rgb: developed.space.xyz_from_rgb(), viewing },
        })
    }

    fn color(&self, rgb: [f32; 3]) -> [f32; 3] {
        self.from_rgb.apply(rgb.map(f64::from)).map(|channel| channel as f32)
    }
}
