//! A path at a rough dielectric boundary: light sampled directly on both sides, then a new direction on either.
//!
//! All lanes go one way, whatever the index does (`bsdf::rough_dielectric`): nothing parts here, and a lane that has parted
//! elsewhere goes on alone with a density of its own.

use super::Tracer;
use super::media::MediaStack;
use super::path::{Outcome, Path};
use super::scatter::weight;
use crate::bsdf::RoughDielectric;
use crate::geometry::{Hit, Ray, Side};
use crate::light::Receiver;
use crate::math::Frame;
use crate::math::Lanes;
use crate::sampler::Sampler;
use crate::scene::{Interface, MediumId, Physics};
use glam::Vec3;

/// A rough boundary as a path meets it.
pub struct Rough {
    pub interface: Interface,
    /// The medium that the path is in.
    pub from: MediumId,
    /// The medium beyond.
    pub to: MediumId,
    /// The solids beyond.
    pub beyond: MediaStack,
    /// The last of the boundaries that coincide here.
    pub far: Hit,
}

impl<const P: u32> Tracer<'_, P> {
    #[inline(never)]
    pub fn rough_interface<const N: usize>(
        &self,
        rough: &Rough,
        path: &mut Path<N>,
        hit: &Hit,
        sampler: &mut Sampler,
        radiance: &mut Lanes<N>,
    ) -> Outcome {
        let Interface { alpha, model, .. } = rough.interface;
        let frame = Frame::new(hit.facing(-path.ray.direction));
        let wo = frame.to_local(-path.ray.direction);
        let (n1, n2) = (self.n(rough.from, path.offset), self.n(rough.to, path.offset));
        let fresnel = self.boundary(model, rough.from, rough.to, path.offset);
        let bsdf = RoughDielectric::new(fresnel, &n1, &n2, alpha);
        if self.needs(Physics::LIGHT_SAMPLING) {
            *radiance += path.throughput * self.direct_rough(&bsdf, rough, &frame, wo, path.offset, hit, sampler);
        }
        let (choice, u) = (sampler.uniform(), sampler.uniform_2d());
        let Some(sample) = bsdf.sample(wo, u, choice) else { return Outcome::Ended };
        path.throughput *= sample.weight;
        path.pdf = sample.pdf;
        path.normal = None;
        let crosses = sample.wi.z < 0.0;
        let direction = frame.to_world(sample.wi);
        let (leaves, side) = rough.leaves(hit, crosses);
        if !leaves.admits(side, direction) {
            return Outcome::Ended;
        }
        if crosses {
            path.media = rough.beyond;
        }
        path.ray = Ray::leaving(leaves, side, direction);
        Outcome::GoesOn
    }

    /// Light from one point of one light on either side, scattered towards `wo`.
    #[inline]
    #[allow(
        clippy::too_many_arguments,
        reason = "a hit, how it scatters, and a number source: no two of them belong together"
    )]
    fn direct_rough<const N: usize>(
        &self,
        bsdf: &RoughDielectric<N>,
        rough: &Rough,
        frame: &Frame,
        wo: Vec3,
        offset: u32,
        hit: &Hit,
        sampler: &mut Sampler,
    ) -> Lanes<N> {
        let (choice, u) = (sampler.uniform(), sampler.uniform_2d());
        let receiver = Receiver { point: hit.point, normal: None };
        let Some(light) = self.scene.lights.sample(&self.scene.world, &receiver, choice, u) else {
            return Lanes::ZERO;
        };
        let wi = frame.to_local(light.direction);
        let value = bsdf.eval(wo, wi);
        if value.pdf == 0.0 {
            return Lanes::ZERO;
        }
        let crosses = wi.z < 0.0;
        let medium = if crosses { rough.to } else { rough.from };
        let (leaves, side) = rough.leaves(hit, crosses);
        if !leaves.admits(side, light.direction) {
            return Lanes::ZERO;
        }
        let arriving = self.arriving(&light, leaves, side, medium, offset);
        value.f_cos * arriving * weight(&light, value.pdf)
    }
}

impl Rough {
    /// The surface that a ray leaves, and into which side.
    #[inline]
    fn leaves<'a>(&'a self, hit: &'a Hit, crosses: bool) -> (&'a Hit, Side) {
        if crosses { (&self.far, self.far.side.opposite()) } else { (hit, hit.side) }
    }
}
