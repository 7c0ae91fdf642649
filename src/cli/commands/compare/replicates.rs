//! Variants rendered replicate by replicate, each replicate of all variants with the same random numbers.
//!
//! In turn, so that what there is when a render ends early is as much of one variant as of another.

use crate::adaptive::RenderLoop;
use crate::cli::interrupt::Interrupt;
use crate::cli::picture::window;
use crate::cli::progress::Shown;
use crate::film::{Film, Layers, Pixel, Wanted, fnv1a_64};
use crate::render::{Kernel, Recorder};
use crate::report::difference::Image;
use crate::scene::{Needs, Scene, SceneError};
use std::time::Instant;

/// How much is rendered.
#[derive(Clone, Debug)]
pub struct Replication {
    /// What the seeds of the replicates come of.
    pub seed: u64,
    /// One a replicate.
    pub seeds: Vec<u64>,
    /// Samples a pixel and replicate.
    pub samples: u32,
}

/// What became of a variant.
#[derive(Debug)]
pub struct Rendered {
    /// All replicates together.
    pub film: Film,
    pub replicates: Vec<Image>,
    pub seconds: f64,
}

impl Replication {
    /// `samples` a pixel in as many equal replicates, rounded up.
    pub fn new(seed: u64, samples: u32, replicates: u16) -> Self {
        let seeds = (0..replicates).map(|r| fnv1a_64(format!("replicate {r} of seed {seed}").as_bytes())).collect();
        Self { seed, seeds, samples: samples.div_ceil(u32::from(replicates)) }
    }

    pub fn samples_in_all(&self) -> u32 {
        self.samples.saturating_mul(self.seeds.len() as u32)
    }
}

impl Rendered {
    fn empty(scene: &Scene) -> Result<Self, SceneError> {
        let film = Film::new(size(scene), window(scene.settings.crop)).map_err(SceneError::new)?;
        Ok(Self { film, replicates: Vec::new(), seconds: 0.0 })
    }
}

/// Renders all variants; fewer replicates of each if it is interrupted.
pub fn render_all(
    scenes: &mut [Scene],
    replication: &Replication,
    progress: &Shown,
    interrupt: &Interrupt,
) -> Result<Vec<Rendered>, SceneError> {
    let mut all = scenes.iter().map(Rendered::empty).collect::<Result<Vec<_>, _>>()?;
    for &seed in &replication.seeds {
        let mut replicate = Vec::with_capacity(scenes.len());
        for scene in scenes.iter_mut() {
            scene.settings.seed = seed;
            let started = Instant::now();
            let layers = render_one(scene, replication.samples, progress, interrupt)?;
            replicate.push((layers, started.elapsed().as_secs_f64()));
            if interrupt.stopped() {
                return Ok(all);
            }
        }
        for (rendered, (layers, seconds)) in all.iter_mut().zip(replicate) {
            rendered.film.merge(layers.film()).map_err(SceneError::new)?;
            rendered.replicates.push(image(layers.film()));
            rendered.seconds += seconds;
        }
    }
    Ok(all)
}

fn render_one(scene: &Scene, samples: u32, progress: &Shown, interrupt: &Interrupt) -> Result<Layers, SceneError> {
    let mut layers =
        Layers::new(size(scene), window(scene.settings.crop), Wanted::default()).map_err(SceneError::new)?;
    let needs = Needs::of(scene);
    let kernel = Kernel::new(scene, &needs);
    let recorder = Recorder::new(&kernel, None, None);
    RenderLoop::new(&recorder, progress, interrupt.flag()).evenly(&mut layers, u64::from(samples));
    Ok(layers)
}

fn size(scene: &Scene) -> [u32; 2] {
    [scene.settings.width, scene.settings.height]
}

fn image(film: &Film) -> Image {
    film.pixels().iter().map(Pixel::mean).map(|xyz| xyz.map(|c| c as f32)).collect()
}
