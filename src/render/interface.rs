//! A path at a dielectric boundary: reflected or refracted, and parted where a smooth one disperses.

use super::Kernel;
use super::path::{Outcome, Path};
use super::rough::Rough;
use super::stone::Entry;
use crate::bsdf::dielectric::{reflect, refract, refract_lanes};
use crate::bsdf::{Directions, choose};
use crate::geometry::{Departure, Hit, Ray, Side};
use crate::sampler::Sampler;
use crate::scene::{Inside, Interface};
use crate::spectrum::Lanes;

impl Kernel<'_> {
    /// A dielectric boundary: one of reflection and refraction is followed, all lanes alike.
    #[inline]
    pub fn interface<const N: usize>(
        &self,
        interface: &Interface,
        path: &mut Path<N>,
        hit: &Hit,
        sampler: &mut Sampler,
        radiance: &mut Lanes<N>,
    ) -> Outcome {
        let &Interface { medium, model, .. } = interface;
        let entering = hit.side == Side::Outside;
        // Where solids overlap the one entered last fills the space: leaving another changes nothing.
        let from = path.media.current();
        let to = if entering { medium } else { path.media.without(medium) };
        if from == to {
            path.media.cross(medium, entering);
            // No shadow ray comes through here: a light that this ray meets counts in full.
            path.pdf = f32::INFINITY;
            path.ray = Ray::leaving(hit, hit.side.opposite(), path.ray.direction);
            return Outcome::GoesOn;
        }
        if interface.is_rough() {
            return self.rough_interface(&Rough { interface, from, to }, path, hit, sampler, radiance);
        }
        let (n1, n2) = (self.n(from, path.offset), self.n(to, path.offset));
        let normal = if entering { hit.normal } else { -hit.normal };
        let cos_theta_i = (-path.ray.direction.dot(normal)).clamp(0.0, 1.0);
        let boundary = model.dielectric(&n1, &n2, &Lanes::splat(cos_theta_i));
        let choice = choose(&path.throughput, &boundary.r, sampler.uniform());
        path.throughput *= choice.weight;
        path.pdf = f32::INFINITY;
        if choice.reflect {
            path.ray = Ray::leaving(hit, hit.side, reflect(path.ray.direction, normal, cos_theta_i));
            return Outcome::GoesOn;
        }
        path.media.cross(medium, entering);
        let parts = N > 1 && (self.scene.medium(from).dispersive || self.scene.medium(to).dispersive);
        let into_stone = entering && (parts || N == 1) && self.scene.object(hit.shape).inside == Inside::Alone;
        if !parts && !into_stone {
            let direction = refract(path.ray.direction, normal, n1[0] / n2[0], cos_theta_i, boundary.cos_theta_t[0]);
            path.ray = Ray::leaving(hit, hit.side.opposite(), direction);
            return Outcome::GoesOn;
        }
        let directions = refract_lanes(
            &Directions::splat(path.ray.direction),
            &Directions::splat(normal),
            &(n1 / n2),
            &Lanes::splat(cos_theta_i),
            &boundary.cos_theta_t,
        );
        if into_stone {
            return self.through_stone(&Entry { hit, directions, interface }, path, sampler, radiance);
        }
        for lane in 0..N {
            let ray = Ray::leaving(hit, hit.side.opposite(), directions.get(lane));
            self.go_on_alone(path, lane, ray, *sampler, radiance);
        }
        Outcome::Ended
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
        entry: &Entry<N>,
        path: &mut Path<N>,
        sampler: &mut Sampler,
        radiance: &mut Lanes<N>,
    ) -> Outcome {
        let Some(exits) = self.trace_stone(entry, path, sampler) else { return Outcome::Ended };
        path.media.leave(entry.interface.medium);
        let departs = Departure::Surface { shape: entry.hit.shape, facet: 0, side: Side::Outside };
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
