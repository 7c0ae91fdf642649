//! The path integral: from the camera, surface by surface, with the light sampled at each.
//!
//! Kajiya 1986 ("The rendering equation"); next-event estimation and BSDF sampling are combined by the balance heuristic
//! (Veach & Guibas 1995). A path's N wavelengths share every random choice and, until a dispersive refraction parts them,
//! every ray. Parted lanes go on as N paths of one wavelength that draw the same numbers: each has its own rays to the end,
//! which measures better than going on with one of them, and is simpler.

use super::media::MediaStack;
use super::mis::balance_heuristic;
use super::vertex::Vertex;
use super::{Tracer, rays};
use crate::bsdf::{Conductor, Diffuse};
use crate::geometry::{Hit, Ray};
use crate::light::Receiver;
use crate::math::Lanes;
use crate::sampler::Sampler;
use crate::scene::{MediumId, Metal, Physics, Surface};
use crate::spectrum::Wavelengths;
use glam::Vec3;
use std::ops::ControlFlow;

/// Paths survive with min(1, this × their largest throughput). Relaxed roulette: 1 costs less a path, but more for the same error.
///
/// Variance at 64 samples and time of 4.5 against 3: metals 0.86 and 1.06 ×, a Cornell box 0.99 and 1.06, a dispersive diamond 0.99 and 1.07,
/// the tray 0.98 and 1.03, as bright rays decide there. Relative to each pixel's own brightness, which is what an eye sees, it is 0.69,
/// 0.94, 0.77 and 0.81 ×. 6 goes on like that (metals 0.84 and 1.08, relative 0.59), 10 costs more than it gains but on the tray. Roulette only
/// after the emission that a ray finds did no better for the time, nor did letting all first scatterings go on.
const ROULETTE: f32 = 4.5;

/// From this depth on a path that loses nothing is ended by its length too ([`Path::late_survival`]).
const LATE: u32 = 256;

/// An interaction that leaves more than this share of the light loses nothing to speak of.
const KEPT: f32 = 1.0 - 1.0 / 4096.0;

/// A path on its way.
#[derive(Clone, Copy)]
pub struct Path<'a, const N: usize> {
    pub ray: Ray,
    pub throughput: Lanes<N>,
    /// Spectral radiance that it has gathered so far, W m⁻² sr⁻¹ nm⁻¹.
    pub radiance: Lanes<N>,
    pub wavelengths: Wavelengths<'a, N>,
    pub sampler: Sampler<'a>,
    pub media: MediaStack,
    /// Density per steradian with which the last surface chose the direction; infinite for a direction without choice, so
    /// that a light it meets counts in full.
    pub pdf: f32,
    /// Normal of the last surface if it scatters to one side only: what its lights were chosen by.
    pub normal: Option<Vec3>,
    /// Surface interactions so far.
    pub depth: u32,
    /// Largest throughput after the interaction before, from [`LATE`] on.
    before: f32,
}

impl<'a, const N: usize> Path<'a, N> {
    pub fn new(ray: Ray, wavelengths: Wavelengths<'a, N>, media: MediaStack, sampler: Sampler<'a>) -> Self {
        Self {
            ray,
            throughput: Lanes::ONE,
            radiance: Lanes::ZERO,
            wavelengths,
            sampler,
            media,
            pdf: f32::INFINITY,
            normal: None,
            depth: 0,
            before: f32::INFINITY,
        }
    }

    /// Returns one lane, to go on alone: it draws the same numbers as the others.
    pub fn lane(&self, lane: usize, ray: Ray) -> Path<'a, 1> {
        Path {
            ray,
            throughput: Lanes([self.throughput[lane]]),
            radiance: Lanes::ZERO,
            wavelengths: self.wavelengths.lane(lane),
            sampler: self.sampler,
            media: self.media,
            pdf: self.pdf,
            normal: self.normal,
            depth: self.depth,
            before: self.before,
        }
    }

    /// Ends the path by chance, in the mean keeping what it carries. False when it has ended.
    #[inline(always)]
    pub fn survives(&mut self) -> bool {
        let carried = self.throughput.max();
        let survival = if self.depth < LATE { ROULETTE * carried } else { self.late_survival(carried) };
        if survival >= 1.0 {
            return true;
        }
        // A throughput of zero, or one that is not a number, ends the path.
        let survives = self.sampler.uniform() < survival;
        if survives {
            self.throughput *= 1.0 / survival;
        }
        survives
    }

    /// Returns the chance to survive of a path that has come far.
    ///
    /// Roulette by throughput ends what loses light, at a finite variance: if k interactions keep ρ
    /// each, a path that carries ρᵏ in the mean is alive with a chance Q ≥ min(1, 4.5 ρᵏ), and the
    /// second moment of what it carries, ρ²ᵏ/Q, is at most ρᵏ. It never ends what loses nothing, as
    /// light that total reflection holds in clear glass. There Q falls as (256/k)², too, by
    /// (k/(k + 1))² at each interaction: such paths have 512 of them in the mean, and the sum of
    /// ρ²ᵏ k² is finite for every ρ below 1.
    ///
    /// A Q that falls as 0.98ᵏ has an infinite variance above ρ = √0.98: closed rooms of 0.998 came
    /// out at 0.88 ± 0.09 of their light (docs/notes/03-ending-paths.md). As 0.95ᵏ from depth 64 on it
    /// darkened a ball of flat glass in a furnace to 99.84 ± 0.02 %.
    #[cold]
    fn late_survival(&mut self, carried: f32) -> f32 {
        let depth = self.depth as f32;
        let shorter = depth / (depth + 1.0);
        let longest = if carried > KEPT * self.before { shorter * shorter } else { 1.0 };
        let survival = (ROULETTE * carried).min(longest);
        self.before = carried / survival;
        survival
    }
}

impl<const P: u32> Tracer<'_, P> {
    /// Follows a path to its end; it gathers the spectral radiance that arrives along its ray.
    pub fn follow<const N: usize>(&self, path: &mut Path<N>) {
        let mut traced = 0;
        loop {
            traced += 1;
            let mut also = Vec::new();
            let Some(hit) = self.next(path, &mut also) else {
                path.radiance += path.throughput * self.environment(path.ray.direction, path.pdf, path.wavelengths);
                break;
            };
            path.throughput *= self.transmittance(self.medium(path), hit.t, path.wavelengths);
            path.radiance += self.emission(path, &hit);
            // The last interaction is followed by a ray that only looks for light, the other half of its estimate.
            if path.depth >= self.max_depth {
                break;
            }
            path.depth += 1;
            let vertex = Vertex::new(&path.ray, (&hit, &also), self.medium(path), path.wavelengths);
            if self.interact(&vertex, path).is_break() || !path.survives() {
                break;
            }
        }
        rays::count(traced);
    }

    /// Sends a path on from what it has met, or ends it.
    #[inline(always)]
    fn interact<const N: usize>(&self, vertex: &Vertex<N>, path: &mut Path<N>) -> ControlFlow<()> {
        let hit = vertex.hit;
        match self.surface(hit) {
            Surface::Black => ControlFlow::Break(()),
            Surface::Diffuse(matt) => {
                let reflectance = self.reflectance(matt.reflectance, vertex);
                self.scatter(&Diffuse { reflectance }.into(), vertex, None, path)
            }
            Surface::Conductor(Metal { n, k, alpha, model }) => {
                let fresnel = self.metal(*model, [*n, *k], vertex);
                let alpha = self.alpha_of_metal(*alpha, hit);
                self.scatter(&Conductor { fresnel, alpha }.into(), vertex, None, path)
            }
            Surface::Dielectric(interface) if Self::runs(Physics::CLEAR_MEDIA) => {
                let interface = self.boundary_at(interface, hit);
                self.interface(&interface, *vertex, path)
            }
            Surface::Dielectric(_) => ControlFlow::Break(()),
        }
    }

    /// Spectral radiance of the surroundings from a direction that was chosen with a density. What has escaped is outside of all solids,
    /// whatever was entered where surfaces coincide.
    #[inline]
    pub fn environment<const N: usize>(&self, direction: Vec3, pdf: f32, wavelengths: Wavelengths<N>) -> Lanes<N> {
        let lights = &self.scene.lights;
        let (mut arriving, map_pdf) = lights.environment(direction, wavelengths);
        if map_pdf > 0.0 {
            arriving *= balance_heuristic(pdf, map_pdf);
        }
        for (radiance, light_pdf) in lights.suns(direction) {
            arriving += wavelengths.at(radiance) * balance_heuristic(pdf, light_pdf);
        }
        arriving * self.transmittance(MediumId::OUTSIDE, f32::INFINITY, wavelengths)
    }

    /// Light that a hit sends back along the ray, weighted against finding it by sampling the light.
    #[inline]
    fn emission<const N: usize>(&self, path: &Path<N>, hit: &Hit) -> Lanes<N> {
        let lights = &self.scene.lights;
        let Some(radiance) = lights.emitted(hit) else { return Lanes::ZERO };
        let emitted =
            path.throughput * path.wavelengths.at(radiance) * self.compression(self.medium(path), path.wavelengths);
        if path.pdf == f32::INFINITY {
            return emitted;
        }
        let receiver = Receiver { point: path.ray.origin, normal: path.normal };
        let light_pdf = lights.pdf(&self.scene.world, &receiver, path.ray.direction, hit);
        emitted * balance_heuristic(path.pdf, light_pdf)
    }

    /// What a light's radiance is multiplied by where it joins the path, so that it counts as if it
    /// came from outside of all solids: a light inside glass looks n² times dimmer from there. So
    /// it needs no state and leaves the throughput that roulette looks at alone; what the camera
    /// stands in counts once for the whole path.
    #[inline(always)]
    pub fn compression<const N: usize>(&self, medium: MediumId, wavelengths: Wavelengths<N>) -> Lanes<N> {
        if !Self::runs(Physics::CLEAR_MEDIA) || medium == MediumId::OUTSIDE {
            return Lanes::ONE;
        }
        self.concentration(MediumId::OUTSIDE, medium, wavelengths)
    }

    /// Share of light that a medium lets through over a length (Beer–Lambert).
    #[inline(always)]
    pub fn transmittance<const N: usize>(
        &self,
        medium: MediumId,
        length: f32,
        wavelengths: Wavelengths<N>,
    ) -> Lanes<N> {
        let absorption = if self.needs(Physics::ABSORPTION) { self.scene.medium(medium).absorption } else { None };
        match absorption {
            None => Lanes::ONE,
            Some(absorption) => wavelengths.at(absorption).map(|alpha| {
                let optical_depth = if alpha > 0.0 { alpha * length } else { 0.0 };
                libm::expf(-optical_depth)
            }),
        }
    }

    /// The medium that a path is in.
    #[inline]
    pub fn medium<const N: usize>(&self, path: &Path<N>) -> MediumId {
        if Self::runs(Physics::CLEAR_MEDIA) { path.media.current() } else { MediumId::OUTSIDE }
    }

    /// Index of refraction of a medium.
    #[inline]
    pub fn n<const N: usize>(&self, medium: MediumId, wavelengths: Wavelengths<N>) -> Lanes<N> {
        wavelengths.at(self.scene.medium(medium).n)
    }
}
