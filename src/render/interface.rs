//! A path at a dielectric boundary: reflected or refracted, and parted where a smooth one disperses.

use super::media::MediaStack;
use super::path::{Outcome, Path};
use super::rough::Rough;
use super::stone::{Entry, points};
use super::{Tracer, rays};
use crate::bsdf::dielectric::{reflect, refract, refract_lanes};
use crate::bsdf::{choose, keep_refracted};
use crate::geometry::{Departure, Hit, Ray, Side};
use crate::math::Lanes;
use crate::math::Vectors;
use crate::sampler::Sampler;
use crate::scene::{Filling, Inside, Interface, Object, Physics, Surface};

/// Boundaries that coincide at one place, at most. More than anybody stacks; without an end two
/// faces of one mesh in one place could be met in turn for ever.
pub const MOST: usize = 256;

/// What light meets at one place: one boundary, or several that coincide.
struct Boundary {
    /// Of the highest rank among them.
    interface: Interface,
    rank: u32,
    /// Beyond all of them.
    media: MediaStack,
    /// The last one.
    far: Hit,
}

impl<const P: u32> Tracer<'_, P> {
    /// Boundaries that coincide are one: there is no air between glasses that touch. Goes on through all that are met at once.
    #[inline(never)]
    fn contact(&self, mut boundary: Boundary, ray: &Ray, also: &[Departure]) -> Boundary {
        let mut before = Vec::new();
        while let Some(next) = self.scene.world.beside(ray, also, &boundary.far, &before) {
            let (Surface::Dielectric(interface), true) = (self.surface(&next), before.len() < MOST) else { break };
            let interface = self.boundary_at(interface, &next);
            let rank = self.scene.object(next.shape).rank;
            let entering = next.side == Side::Outside;
            boundary.media = boundary.media.across(Filling { rank, medium: interface.medium }, entering, &self.buried);
            if rank > boundary.rank {
                boundary.interface = interface;
                boundary.rank = rank;
            }
            before.push(std::mem::replace(&mut boundary.far, next));
        }
        boundary
    }

    /// What a path meets next. Where faces coincide the surface just crossed knows itself, but not
    /// that the other one was crossed with it: crossing that again changes nothing, so it is noted
    /// in `also` and left behind. What lies on a boundary comes before it.
    #[inline]
    pub fn next<const N: usize>(&self, path: &Path<N>, also: &mut Vec<Departure>) -> Option<Hit> {
        let hit = self.scene.world.closest(&path.ray, f32::INFINITY)?;
        if self.joins(&hit) { self.next_beyond(path, also, hit) } else { Some(hit) }
    }

    /// Whether other surfaces may coincide with the one that is hit. (A kernel that does not run
    /// this must not look the object up.)
    #[inline]
    fn joins(&self, hit: &Hit) -> bool {
        let joins = |object: &Object| object.touches || object.covers;
        Self::runs(Physics::CONTACT) && joins(self.scene.object(hit.shape))
    }

    #[inline(never)]
    fn next_beyond<const N: usize>(&self, path: &Path<N>, also: &mut Vec<Departure>, mut hit: Hit) -> Option<Hit> {
        while also.len() < MOST && self.scene.world.is_at_origin(&path.ray, &hit) {
            let Surface::Dielectric(interface) = self.surface(&hit) else { break };
            let solid = Filling { rank: self.scene.object(hit.shape).rank, medium: interface.medium };
            if path.media.across(solid, hit.side == Side::Outside, &self.buried) != path.media {
                break;
            }
            also.push(hit.departure(hit.side.opposite()));
            rays::count(1);
            hit = self.scene.world.closest_beyond(&path.ray, also, f32::INFINITY)?;
        }
        Some(self.scene.cover(&path.ray, also, &hit).unwrap_or(hit))
    }

    /// A dielectric boundary: one of reflection and refraction is followed, all lanes alike.
    #[inline]
    pub fn interface<const N: usize>(
        &self,
        interface: &Interface,
        path: &mut Path<N>,
        (hit, also): (&Hit, &[Departure]),
        sampler: &mut Sampler,
        radiance: &mut Lanes<N>,
    ) -> Outcome {
        let rank = self.scene.object(hit.shape).rank;
        let solid = Filling { rank, medium: interface.medium };
        let media = path.media.across(solid, hit.side == Side::Outside, &self.buried);
        if Self::runs(Physics::CONTACT) && self.scene.object(hit.shape).touches {
            let boundary = Boundary { interface: *interface, rank, media, far: *hit };
            return self.cross_together(boundary, path, (hit, also), sampler, radiance);
        }
        self.cross(interface, media, hit, path, hit, sampler, radiance)
    }

    /// Kept apart: boundaries that may coincide are worked out in memory, which took 4 % of the instructions of a sample of glass that
    /// touches nothing.
    #[inline(never)]
    fn cross_together<const N: usize>(
        &self,
        boundary: Boundary,
        path: &mut Path<N>,
        (hit, also): (&Hit, &[Departure]),
        sampler: &mut Sampler,
        radiance: &mut Lanes<N>,
    ) -> Outcome {
        let Boundary { interface, media, far, .. } = self.contact(boundary, &path.ray, also);
        self.cross(&interface, media, &far, path, hit, sampler, radiance)
    }

    /// Across or back: `far` is the last of the boundaries that coincide at `hit`, and beyond it are `media`.
    #[inline(always)]
    #[allow(clippy::too_many_arguments, reason = "a boundary by reference costs nothing where it is one hit")]
    fn cross<const N: usize>(
        &self,
        interface: &Interface,
        media: MediaStack,
        far: &Hit,
        path: &mut Path<N>,
        hit: &Hit,
        sampler: &mut Sampler,
        radiance: &mut Lanes<N>,
    ) -> Outcome {
        let object = self.scene.object(hit.shape);
        let entering = hit.side == Side::Outside;
        let (from, to) = (path.media.current(), media.current());
        if from == to {
            path.media = media;
            // No shadow ray comes through here: a light that this ray meets counts in full.
            path.pdf = f32::INFINITY;
            let from_here = Ray::leaving(far, far.side.opposite(), path.ray.direction);
            // Never back: two solids that share a hair of room would each find the ray before the other's surface, for ever.
            let origin = if far.t > 0.0 { far.point } else { path.ray.origin };
            path.ray = Ray { origin, ..from_here };
            return Outcome::GoesOn;
        }
        if Self::runs(Physics::ROUGH_GLASS) && interface.is_rough() {
            let rough = Rough { interface: *interface, from, to, beyond: media, far: *far };
            return self.rough_interface(&rough, path, hit, sampler, radiance);
        }
        let (n1, n2) = (self.n(from, path.offset), self.n(to, path.offset));
        let normal = hit.facing(-path.ray.direction);
        let cos_theta_i = (-path.ray.direction.dot(normal)).clamp(0.0, 1.0);
        let fresnel = self.boundary(interface.model, from, to, path.offset);
        let boundary = fresnel.at(&n1, &n2, &Lanes::splat(cos_theta_i));
        let choice = choose(&path.throughput, &boundary.r, sampler.uniform());
        path.throughput *= choice.weight;
        path.pdf = f32::INFINITY;
        if choice.reflect {
            path.ray = Ray::leaving(hit, hit.side, reflect(path.ray.direction, normal, cos_theta_i));
            return Outcome::GoesOn;
        }
        if Self::runs(Physics::COMPLEX_INDEX) && !keep_refracted(&mut path.throughput, &boundary.cos_theta_t) {
            return Outcome::Ended;
        }
        let outside = path.media.current();
        path.media = media;
        let parts = N > 1
            && Self::runs(Physics::DISPERSION)
            && (self.scene.medium(from).dispersive || self.scene.medium(to).dispersive);
        let into_stone = entering && (parts || N == 1) && object.inside == Inside::Alone;
        if !parts && !into_stone {
            let direction = refract(path.ray.direction, normal, n1[0] / n2[0], cos_theta_i, boundary.cos_theta_t[0]);
            path.ray = Ray::leaving(far, far.side.opposite(), direction);
            return Outcome::GoesOn;
        }
        let directions = refract_lanes(
            &Vectors::splat(path.ray.direction),
            &Vectors::splat(normal),
            &(n1 / n2),
            &Lanes::splat(cos_theta_i),
            &boundary.cos_theta_t,
        );
        if into_stone {
            let entry = Entry { hit, directions, interface, outside };
            return self.through_stone(&entry, path, sampler, radiance);
        }
        for lane in 0..N {
            let ray = Ray::leaving(far, far.side.opposite(), directions.get(lane));
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
            radiance[lane] += self.radiance(&mut alone, &mut sampler)[0];
        }
    }

    fn through_stone<const N: usize>(
        &self,
        entry: &Entry<N>,
        path: &mut Path<N>,
        sampler: &mut Sampler,
        radiance: &mut Lanes<N>,
    ) -> Outcome {
        let entered = path.depth;
        let exits = self.trace_stone(entry, path, sampler);
        rays::count(N as u64 * u64::from(path.depth - entered));
        let Some(exits) = exits else { return Outcome::Ended };
        let rank = self.scene.object(entry.hit.shape).rank;
        path.media = path.media.across(Filling { rank, medium: entry.interface.medium }, false, &self.buried);
        // The entry's facet: of a convex solid left outwards nobody asks which.
        let departs = entry.hit.departure(Side::Outside);
        let ray = |lane| Ray { origin: exits.origins.get(lane), direction: exits.directions.get(lane), departs };
        if N == 1 {
            path.ray = ray(0);
            return Outcome::GoesOn;
        }
        let escapes = self.scene.world.escape(&exits.origins, &points(&exits.directions), entry.hit.shape);
        for (lane, escapes) in escapes.into_iter().enumerate() {
            if escapes && path.throughput[lane] > 0.0 {
                rays::count(1);
                let offset = path.offset + lane as u32;
                let arriving = self.environment::<1>(exits.directions.get(lane), path.pdf, offset);
                radiance[lane] += path.throughput[lane] * arriving[0];
            } else {
                self.go_on_alone(path, lane, ray(lane), *sampler, radiance);
            }
        }
        Outcome::Ended
    }
}
