//! The path integral: from the camera, surface by surface, with the light sampled at each.
//!
//! Kajiya 1986 ("The rendering equation"); next-event estimation and BSDF sampling are combined by the power heuristic
//! (Veach & Guibas 1995). A path's N wavelengths share every random choice and, until a dispersive refraction parts them,
//! every ray. Parted lanes go on as N paths of one wavelength that draw the same numbers: each has its own rays to the end,
//! which measures better than going on with one of them, and is simpler.

use super::media::MediaStack;
use super::stone;
use super::Kernel;
use crate::bsdf::{self, Bsdf, Frame};
use crate::fresnel::{self, Fresnel};
use crate::geometry::{Departure, Hit, Ray, Side};
use crate::sampler::Sampler;
use crate::scene::{Inside, MediumId, Surface};
use crate::spectrum::Lanes;
use glam::Vec3;

/// Paths survive with min(1, this × their largest throughput). Relaxed roulette: 1 costs less a path, but 2–4 had the least
/// error for the time (2.3 × on metals).
const ROULETTE: f32 = 3.0;

/// From this depth on a path survives with at most [`LATE_SURVIVAL`], so that light caught by total reflection ends too.
const LATE: u32 = 64;
const LATE_SURVIVAL: f32 = 0.95;

/// A path on its way.
#[derive(Clone, Copy, Debug)]
pub struct Path<const N: usize> {
    pub ray: Ray,
    pub throughput: Lanes<N>,
    /// Where its wavelengths stand in the tables.
    pub offset: u32,
    pub media: MediaStack,
    /// Density per steradian with which the last surface chose the direction; infinite for a direction without choice, so
    /// that a light it meets counts in full.
    pub pdf: f32,
    /// Surface interactions so far.
    pub depth: u32,
}

impl<const N: usize> Path<N> {
    pub fn new(ray: Ray, offset: u32) -> Self {
        Self { ray, throughput: Lanes::ONE, offset, media: MediaStack::OUTSIDE, pdf: f32::INFINITY, depth: 0 }
    }

    /// One lane, to go on alone.
    pub fn lane(&self, lane: usize, ray: Ray) -> Path<1> {
        Path {
            ray,
            throughput: Lanes([self.throughput[lane]]),
            offset: self.offset + lane as u32,
            media: self.media,
            pdf: self.pdf,
            depth: self.depth,
        }
    }

    /// Ends the path by chance, in the mean keeping what it carries. False when it has ended.
    #[inline]
    pub fn survives(&mut self, sampler: &mut Sampler) -> bool {
        let wanted = ROULETTE * self.throughput.max();
        let survival = if self.depth < LATE { wanted.min(1.0) } else { wanted.min(LATE_SURVIVAL) };
        if survival >= 1.0 {
            return true;
        }
        // Written so that a throughput of zero, or one that is not a number, ends the path.
        if !(sampler.next() < survival) {
            return false;
        }
        self.throughput *= 1.0 / survival;
        true
    }
}

/// Power heuristic's weight of a sample with density `taken` that `other` could have found too.
#[inline]
fn power_heuristic(taken: f32, other: f32) -> f32 {
    let ratio = other / taken;
    1.0 / (1.0 + ratio * ratio)
}

/// What a surface did to a path.
enum Outcome {
    GoesOn,
    Ended,
}

impl Kernel<'_> {
    /// Spectral radiance (W m⁻² sr⁻¹ nm⁻¹) that arrives along a path's ray, a lane each.
    pub fn radiance<const N: usize>(&self, mut path: Path<N>, sampler: &mut Sampler) -> Lanes<N> {
        let mut radiance = Lanes::ZERO;
        while path.depth < self.max_depth {
            let Some(hit) = self.scene.world.closest(&path.ray, f32::INFINITY) else {
                radiance += self.environment(&path);
                break;
            };
            path.throughput *= self.transmittance(path.media.current(), hit.t, path.offset);
            radiance += self.emission(&path, &hit);
            path.depth += 1;
            let outcome = match self.surface(&hit) {
                Surface::Dielectric { .. } => self.interface(&mut path, &hit, sampler, &mut radiance),
                _ => self.scatter(&mut path, &hit, sampler, &mut radiance),
            };
            if matches!(outcome, Outcome::Ended) || !path.survives(sampler) {
                break;
            }
        }
        radiance
    }

    #[inline]
    fn surface(&self, hit: &Hit) -> Surface {
        self.scene.surfaces[self.scene.object(hit.shape).surface as usize]
    }

    #[inline]
    fn environment<const N: usize>(&self, path: &Path<N>) -> Lanes<N> {
        let arriving = self.scene.lights.environment.radiance(&self.tables, path.ray.direction, path.offset);
        path.throughput * arriving * self.transmittance(path.media.current(), f32::INFINITY, path.offset)
    }

    /// Light that a hit sends back along the ray, weighted against finding it by sampling the light.
    #[inline]
    fn emission<const N: usize>(&self, path: &Path<N>, hit: &Hit) -> Lanes<N> {
        let lights = &self.scene.lights;
        let Some(radiance) = lights.emitted(hit) else { return Lanes::ZERO };
        let emitted = path.throughput * self.tables.get(radiance, path.offset);
        if path.pdf == f32::INFINITY {
            return emitted;
        }
        let light_pdf = lights.pdf(&self.scene.world, path.ray.origin, path.ray.direction, hit);
        emitted * power_heuristic(path.pdf, light_pdf)
    }

    /// Share of light that a medium lets through over a length (Beer–Lambert).
    #[inline]
    pub fn transmittance<const N: usize>(&self, medium: MediumId, length: f32, offset: u32) -> Lanes<N> {
        match self.scene.medium(medium).absorption {
            None => Lanes::ONE,
            Some(absorption) => self.tables.get::<N>(absorption, offset).map(|alpha| {
                let optical_depth = if alpha > 0.0 { alpha * length } else { 0.0 };
                libm::expf(-optical_depth)
            }),
        }
    }

    /// The BSDF of an opaque surface, in the medium that the path is in.
    #[inline]
    fn bsdf<const N: usize>(&self, surface: Surface, path: &Path<N>) -> Bsdf<N> {
        match surface {
            Surface::Diffuse { reflectance } => Bsdf::Diffuse { reflectance: self.tables.get(reflectance, path.offset) },
            Surface::Conductor { n, k, alpha, model } => {
                let outside = self.tables.get(self.scene.medium(path.media.current()).n, path.offset);
                let (n, k) = (self.tables.get(n, path.offset), self.tables.get(k, path.offset));
                Bsdf::Conductor { fresnel: Fresnel::new(model, outside, n, k), alpha }
            }
            Surface::Dielectric { .. } => unreachable!("interfaces are no BSDF"),
        }
    }

    /// An opaque surface: light sampled directly, then a new direction.
    #[inline]
    fn scatter<const N: usize>(
        &self,
        path: &mut Path<N>,
        hit: &Hit,
        sampler: &mut Sampler,
        radiance: &mut Lanes<N>,
    ) -> Outcome {
        let bsdf = self.bsdf(self.surface(hit), path);
        let normal = if hit.side == Side::Outside { hit.normal } else { -hit.normal };
        let frame = Frame::new(normal);
        let wo = frame.to_local(-path.ray.direction);
        let departs = Departure::Surface { shape: hit.shape, side: hit.side };
        if self.needs.light_sampling && !bsdf.is_delta() {
            *radiance += path.throughput * self.direct(&bsdf, &frame, wo, path, hit, sampler);
        }
        let Some(sample) = bsdf.sample(wo, sampler.next_2d()) else { return Outcome::Ended };
        path.throughput *= sample.weight;
        path.pdf = if sample.delta { f32::INFINITY } else { sample.pdf };
        path.ray = Ray { origin: hit.point, direction: frame.to_world(sample.wi), departs };
        Outcome::GoesOn
    }

    /// Light from one point of one light, reflected towards `wo`.
    #[inline]
    fn direct<const N: usize>(
        &self,
        bsdf: &Bsdf<N>,
        frame: &Frame,
        wo: Vec3,
        path: &Path<N>,
        hit: &Hit,
        sampler: &mut Sampler,
    ) -> Lanes<N> {
        let (choice, u) = (sampler.next(), sampler.next_2d());
        let world = &self.scene.world;
        let Some(light) = self.scene.lights.sample(world, hit.point, choice, u) else { return Lanes::ZERO };
        let wi = frame.to_local(light.direction);
        if wi.z <= 0.0 {
            return Lanes::ZERO;
        }
        let value = bsdf.eval(wo, wi);
        if value.pdf == 0.0 {
            return Lanes::ZERO;
        }
        let departs = Departure::Surface { shape: hit.shape, side: hit.side };
        let shadow = Ray { origin: hit.point, direction: light.direction, departs };
        if world.occluded(&shadow, light.distance, Some(light.shape)) {
            return Lanes::ZERO;
        }
        let arriving = self.tables.get::<N>(light.radiance, path.offset)
            * self.transmittance(path.media.current(), light.distance, path.offset);
        value.f_cos * arriving * (power_heuristic(light.pdf, value.pdf) / light.pdf)
    }

    /// A smooth dielectric boundary: one of reflection and refraction is followed, all lanes alike.
    #[inline]
    fn interface<const N: usize>(
        &self,
        path: &mut Path<N>,
        hit: &Hit,
        sampler: &mut Sampler,
        radiance: &mut Lanes<N>,
    ) -> Outcome {
        let Surface::Dielectric { medium, model, inside } = self.surface(hit) else { return Outcome::Ended };
        let entering = hit.side == Side::Outside;
        let (from, to) = match entering {
            true => (path.media.current(), medium),
            false => (medium, path.media.without(medium)),
        };
        let (n1, n2) = (self.n(from, path.offset), self.n(to, path.offset));
        let normal = if entering { hit.normal } else { -hit.normal };
        let cos_theta_i = (-path.ray.direction.dot(normal)).clamp(0.0, 1.0);
        let boundary = fresnel::dielectric::fresnel(model, &n1, &n2, &Lanes::splat(cos_theta_i));
        let choice = bsdf::choose(path.throughput, boundary.r, sampler.next());
        path.throughput *= choice.weight;
        path.pdf = f32::INFINITY;
        if choice.reflect {
            let direction = bsdf::reflect(path.ray.direction, normal);
            path.ray = Ray { origin: hit.point, direction, departs: Departure::Surface { shape: hit.shape, side: hit.side } };
            return Outcome::GoesOn;
        }
        match entering {
            true => path.media.enter(medium),
            false => path.media.leave(medium),
        }
        let parts = N > 1 && (self.scene.medium(from).dispersive || self.scene.medium(to).dispersive);
        if entering && inside == Inside::Alone && (parts || N == 1) {
            let directions = bsdf::refract_lanes(path.ray.direction, normal, &n1, &n2, cos_theta_i, &boundary.cos_theta_t);
            return self.through_stone(stone::Entry { hit, directions, medium, model }, path, sampler, radiance);
        }
        let departs = Departure::Surface { shape: hit.shape, side: if entering { Side::Inside } else { Side::Outside } };
        if !parts {
            let eta = n1[0] / n2[0];
            let direction = bsdf::refract(path.ray.direction, normal, eta, cos_theta_i, boundary.cos_theta_t[0]);
            path.ray = Ray { origin: hit.point, direction, departs };
            return Outcome::GoesOn;
        }
        let directions = bsdf::refract_lanes(path.ray.direction, normal, &n1, &n2, cos_theta_i, &boundary.cos_theta_t);
        for lane in 0..N {
            let ray = Ray { origin: hit.point, direction: directions.get(lane), departs };
            self.go_on_alone(path, lane, ray, *sampler, radiance);
        }
        Outcome::Ended
    }
}

impl Kernel<'_> {
    #[inline]
    pub fn n<const N: usize>(&self, medium: MediumId, offset: u32) -> Lanes<N> {
        self.tables.get(self.scene.medium(medium).n, offset)
    }

    /// Follows one lane to the end of its path; a lane that carries nothing costs nothing.
    pub fn go_on_alone<const N: usize>(
        &self,
        path: &Path<N>,
        lane: usize,
        ray: Ray,
        mut sampler: Sampler,
        radiance: &mut Lanes<N>,
    ) {
        let mut alone = path.lane(lane, ray);
        if alone.throughput[0] > 0.0 && alone.survives(&mut sampler) {
            radiance[lane] += self.radiance(alone, &mut sampler)[0];
        }
    }

    fn through_stone<const N: usize>(
        &self,
        entry: stone::Entry<N>,
        path: &mut Path<N>,
        sampler: &mut Sampler,
        radiance: &mut Lanes<N>,
    ) -> Outcome {
        let Some(exits) = self.trace_stone(&entry, path, sampler) else { return Outcome::Ended };
        path.media.leave(entry.medium);
        let departs = Departure::Surface { shape: entry.hit.shape, side: Side::Outside };
        let ray = |lane| Ray { origin: exits.origins.get(lane), direction: exits.directions.get(lane), departs };
        if N == 1 {
            path.ray = ray(0);
            return Outcome::GoesOn;
        }
        for lane in 0..N {
            self.go_on_alone(path, lane, ray(lane), *sampler, radiance);
        }
        Outcome::Ended
    }
}
