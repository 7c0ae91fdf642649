//! A path at a dielectric boundary: reflected or refracted, and parted where a smooth one disperses.

use super::media::MediaStack;
use super::path::Path;
use super::stone::Entry;
use super::vertex::{Beyond, Vertex};
use super::{Tracer, rays};
use crate::bsdf::dielectric::{reflect, refract, refract_lanes};
use crate::bsdf::{choose, keep_refracted};
use crate::geometry::{Departure, Hit, Ray, Side};
use crate::math::{Lanes, Vectors};
use crate::scene::{Filling, Inside, Interface, Object, Physics};
use std::ops::ControlFlow;

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
            let (Some(interface), true) = (self.surface(&next).interface(), before.len() < MOST) else { break };
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
            let Some(interface) = self.surface(&hit).interface() else { break };
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

    /// Sends a path on from a dielectric boundary: one of reflection and refraction is followed, all lanes alike.
    #[inline]
    pub fn interface<const N: usize>(
        &self,
        interface: &Interface,
        vertex: Vertex<N>,
        path: &mut Path<N>,
    ) -> ControlFlow<()> {
        let hit = vertex.hit;
        let rank = self.scene.object(hit.shape).rank;
        let solid = Filling { rank, medium: interface.medium };
        let media = path.media.across(solid, hit.side == Side::Outside, &self.buried);
        if Self::runs(Physics::CONTACT) && self.scene.object(hit.shape).touches {
            let boundary = Boundary { interface: *interface, rank, media, far: *hit };
            return self.cross_together(boundary, vertex, path);
        }
        self.cross(interface, &vertex, &Beyond { media, far: hit }, path)
    }

    /// Kept apart: boundaries that may coincide are worked out in memory, which took 4 % of the instructions of a sample of glass that
    /// touches nothing.
    #[inline(never)]
    fn cross_together<const N: usize>(
        &self,
        boundary: Boundary,
        vertex: Vertex<N>,
        path: &mut Path<N>,
    ) -> ControlFlow<()> {
        let Boundary { interface, media, far, .. } = self.contact(boundary, &path.ray, vertex.also);
        self.cross(&interface, &vertex, &Beyond { media, far: &far }, path)
    }

    /// Across or back.
    #[inline(always)]
    fn cross<const N: usize>(
        &self,
        interface: &Interface,
        vertex: &Vertex<N>,
        beyond: &Beyond,
        path: &mut Path<N>,
    ) -> ControlFlow<()> {
        let &Vertex { hit, wavelengths, medium: from, .. } = vertex;
        let to = beyond.media.current();
        if from == to {
            path.pass(beyond);
            return ControlFlow::Continue(());
        }
        if Self::runs(Physics::ROUGH_GLASS) && interface.is_rough() {
            return self.scatter_clear(interface, *vertex, beyond, path);
        }
        let (n1, n2) = (self.n(from, wavelengths), self.n(to, wavelengths));
        let normal = vertex.frame.z;
        let cos_theta_i = vertex.wo.z.clamp(0.0, 1.0);
        let fresnel = self.boundary(interface.model, from, to, wavelengths);
        let boundary = fresnel.at(&n1, &n2, &Lanes::splat(cos_theta_i));
        let choice = choose(&path.throughput, &boundary.r, path.sampler.uniform());
        path.throughput *= choice.weight;
        path.pdf = f32::INFINITY;
        if choice.reflect {
            path.ray = Ray::leaving(hit, hit.side, reflect(path.ray.direction, normal, cos_theta_i));
            return ControlFlow::Continue(());
        }
        if Self::runs(Physics::COMPLEX_INDEX) && !keep_refracted(&mut path.throughput, &boundary.cos_theta_t) {
            return ControlFlow::Break(());
        }
        path.media = beyond.media;
        let parts = N > 1
            && Self::runs(Physics::DISPERSION)
            && (self.scene.medium(from).dispersive || self.scene.medium(to).dispersive);
        let inside = self.scene.object(hit.shape).inside;
        let into_stone = hit.side == Side::Outside && (parts || N == 1) && inside == Inside::Alone;
        let (far, side) = (beyond.far, beyond.far.side.opposite());
        if !parts && !into_stone {
            let direction = refract(path.ray.direction, normal, n1[0] / n2[0], cos_theta_i, boundary.cos_theta_t[0]);
            path.ray = Ray::leaving(far, side, direction);
            return ControlFlow::Continue(());
        }
        let directions = refract_lanes(
            &Vectors::splat(path.ray.direction),
            &Vectors::splat(normal),
            &(n1 / n2),
            &Lanes::splat(cos_theta_i),
            &boundary.cos_theta_t,
        );
        if into_stone {
            return self.through_stone(&Entry { hit, directions, interface, outside: from }, path);
        }
        for lane in 0..N {
            self.go_on_alone(path, lane, Ray::leaving(far, side, directions.get(lane)));
        }
        ControlFlow::Break(())
    }

    /// Follows one lane to the end of its path; a lane that carries nothing costs nothing.
    pub fn go_on_alone<const N: usize>(&self, path: &mut Path<N>, lane: usize, ray: Ray) {
        let mut alone = path.lane(lane, ray);
        if alone.throughput[0] > 0.0 && alone.survives() {
            self.follow(&mut alone);
            path.radiance[lane] += alone.radiance[0];
        }
    }

    fn through_stone<const N: usize>(&self, entry: &Entry<N>, path: &mut Path<N>) -> ControlFlow<()> {
        let entered = path.depth;
        let exits = self.trace_stone(entry, path);
        rays::count(N as u64 * u64::from(path.depth - entered));
        let Some(exits) = exits else { return ControlFlow::Break(()) };
        let rank = self.scene.object(entry.hit.shape).rank;
        path.media = path.media.across(Filling { rank, medium: entry.interface.medium }, false, &self.buried);
        // The entry's facet: of a convex solid left outwards nobody asks which.
        let departs = entry.hit.departure(Side::Outside);
        let ray = |lane| Ray { origin: exits.origins.get(lane), direction: exits.directions.get(lane), departs };
        if N == 1 {
            path.ray = ray(0);
            return ControlFlow::Continue(());
        }
        let escapes = self.scene.world.escape(&exits.origins, &exits.directions, entry.hit.shape);
        for (lane, escapes) in escapes.into_iter().enumerate() {
            if escapes && path.throughput[lane] > 0.0 {
                rays::count(1);
                let arriving = self.environment(exits.directions.get(lane), path.pdf, path.wavelengths.lane(lane));
                path.radiance[lane] += path.throughput[lane] * arriving[0];
            } else {
                self.go_on_alone(path, lane, ray(lane));
            }
        }
        ControlFlow::Break(())
    }
}

impl<const N: usize> Path<'_, N> {
    /// Goes straight on through a boundary of equal media.
    #[inline]
    fn pass(&mut self, beyond: &Beyond) {
        self.media = beyond.media;
        // No shadow ray comes through here: a light that this ray meets counts in full.
        self.pdf = f32::INFINITY;
        let far = beyond.far;
        let from_here = Ray::leaving(far, far.side.opposite(), self.ray.direction);
        // Never back: two solids that share a hair of room would each find the ray before the other's surface, for ever.
        let origin = if far.t > 0.0 { far.point } else { self.ray.origin };
        self.ray = Ray { origin, ..from_here };
    }
}
