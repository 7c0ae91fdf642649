//! From a scene to a film: rows × samples → paths.
//!
//! A render cannot fail. It is cut into passes of [`PASS`] samples over all rows, so that what there is at any time is a
//! whole picture; the film's sums are exact, so neither the cut nor the threads change a bit of it.
//!
//! The budget of a sample of five metals on a floor under a lamp and a sky (`benches/peers/metals.toml`): 2,390 instructions, 205 ns on a
//! core of a Zen 5 server. Shared out by callgrind, in ns: rays 83, paths with their frames and MIS 45, choosing lights and points on them
//! 22, random numbers 17, Fresnel and microfacets 14, observer and film 13, wavelengths and camera 11. Spectra are a small part of it,
//! so eight lanes cost hardly more than one; what is to be gained lies in rays. (With roulette at 3 (`path.rs`); at 4.5 all parts together take
//! 6 % more.)

mod cover;
mod direct;
mod features;
mod interface;
mod layers;
mod media;
mod mis;
mod models;
mod path;
mod pattern;
pub mod rays;
mod scatter;
mod stone;
mod tracer;
mod vertex;
mod visible;

pub use features::{Guides, Seen};
pub use layers::{Recorder, Samples, render};
pub use tracer::COMPILED;
pub use visible::{FirstHit, first_hits};

use crate::geometry::Ray;
use crate::math::Lanes;
use crate::sampler::{self, PixelSamples, Sampler};
use crate::scene::describe::SamplerName;
use crate::scene::{MediumId, Needs, Physics, Scene};
use crate::spectrum::{Nodes, SpectrumId, Tables, Wavelengths};
use glam::Vec3;
use media::{Buried, MediaStack};
use models::RgbCurves;
use path::Path;
use tracer::Tracer;

/// Samples a pixel gets before the next pass over the picture.
pub const PASS: u32 = 16;

/// Told how a render goes on, from any thread.
pub trait Progress: Sync {
    /// So many more samples are done.
    fn advance(&self, samples: u64);
}

impl Progress for () {
    fn advance(&self, _: u64) {}
}

/// A scene made ready for paths: its spectra tabulated at the nodes of its wavelengths.
pub struct Kernel<'a> {
    scene: &'a Scene,
    needs: &'a Needs,
    /// Of [`COMPILED`], what the kernel runs.
    physics: Physics,
    tables: Tables,
    /// X, Y and Z in cd/m² per spectral radiance.
    observer: [SpectrumId; 3],
    /// What all camera rays begin in.
    around_camera: MediaStack,
    /// What paths that are deep inside of solids do not carry themselves.
    buried: Buried,
    max_depth: u32,
    sampler: sampler::Kind,
    rgb: Option<RgbCurves<'a>>,
}

/// A camera ray and the spectral radiance that arrives along it, at some wavelengths.
struct Traced<'a, const N: usize> {
    ray: Ray,
    wavelengths: Wavelengths<'a, N>,
    radiance: Lanes<N>,
}

impl<'a> Kernel<'a> {
    /// The smallest of the compiled kernels that does what the scene needs.
    pub fn new(scene: &'a Scene, needs: &'a Needs) -> Self {
        let nodes = Nodes::new(&needs.wavelength_density);
        let mut tables = scene.spectra.tabulate(&nodes, scene.settings.lanes as usize);
        if needs.pictures {
            tables.push_positions(&nodes);
        }
        let observer = tables.push_observer(&nodes.observer_weights(&scene.picture.observer));
        let sampler = match scene.settings.sampler {
            SamplerName::Sobol => sampler::Kind::Sobol,
            SamplerName::Independent => sampler::Kind::Independent,
        };
        let buried = Buried::default();
        let enter = |media: MediaStack, &solid| media.across(solid, true, &buried);
        let around_camera = scene.around_camera.all.iter().fold(MediaStack::OUTSIDE, enter);
        Self {
            scene,
            needs,
            physics: tracer::smallest(needs.physics),
            tables,
            observer,
            around_camera,
            buried,
            max_depth: scene.settings.max_depth.unwrap_or(u32::MAX),
            sampler,
            rgb: RgbCurves::new(scene),
        }
    }

    /// With another of the compiled kernels, if it does what the scene needs: the same picture at another price.
    pub fn compiled_for(self, physics: Physics) -> Self {
        let physics = if physics.contains(self.needs.physics) { tracer::smallest(physics) } else { self.physics };
        Self { physics, ..self }
    }

    /// What the kernel was compiled for.
    pub fn physics(&self) -> Physics {
        self.physics
    }

    /// One sample of one pixel.
    #[inline]
    fn trace<const N: usize>(&self, pixel: [u32; 2], mut sampler: Sampler) -> Traced<'_, N> {
        let [dx, dy] = self.scene.filter.sample(sampler.uniform_2d());
        let wavelengths = Wavelengths::new(&self.tables, sampler.set(self.tables.sets()));
        let [x, y] = [pixel[0] as f32 + 0.5 + dx, pixel[1] as f32 + 0.5 + dy];
        let ray = self.scene.camera.ray(x, y, || sampler.uniform_2d());
        let mut path = Path::new(ray, wavelengths, self.around_camera, sampler);
        if !self.scene.around_camera.some.is_empty() {
            path.media = self.around(ray.origin);
        }
        let seen_from = path.media.current();
        self.follow(&mut path);
        let mut radiance = path.radiance;
        if seen_from != MediumId::OUTSIDE {
            radiance *= self.concentration(seen_from, MediumId::OUTSIDE, wavelengths);
        }
        Traced { ray, wavelengths, radiance }
    }

    /// What a camera ray begins in, where that is not the same for all of them.
    #[inline(never)]
    fn around(&self, origin: Vec3) -> MediaStack {
        let holds = |shape| self.scene.world.shape(shape).is_some_and(|solid| solid.contains(origin));
        let some = self.scene.around_camera.some.iter().filter(|(shape, _)| holds(*shape));
        some.fold(self.around_camera, |media, &(_, solid)| media.across(solid, true, &self.buried))
    }

    /// How much more radiance there is in a medium than where it comes from: radiance over n² is what
    /// refraction keeps (Nicodemus 1963).
    #[inline]
    fn concentration<const N: usize>(&self, medium: MediumId, from: MediumId, wavelengths: Wavelengths<N>) -> Lanes<N> {
        let n = |medium| wavelengths.at(self.scene.medium(medium).n);
        let ratio = n(medium) / n(from);
        ratio * ratio
    }

    /// XYZ of a sample in cd/m².
    #[inline]
    fn xyz<const N: usize>(&self, traced: &Traced<N>) -> [f32; 3] {
        let [x, y, z] = self.observer;
        let weighted = |weights| (traced.radiance * traced.wavelengths.at(weights)).sum();
        [weighted(x), weighted(y), weighted(z)]
    }

    fn samples(&self, pixel: [u32; 2]) -> PixelSamples {
        PixelSamples::new(self.sampler, self.scene.settings.seed, pixel)
    }
}
