//! The inside of a cut stone: from facet to facet, all wavelengths at once, each in its own direction.
//!
//! The usual renderers drop all wavelengths but one at a dispersive interface. Here the lanes share every choice instead: at
//! each facet all reflect with the probability p = Σ wᵢRᵢ / Σ wᵢ, else all leave, and lane i is weighted by Rᵢ/p or
//! (1−Rᵢ)/(1−p). The sum of the weights is kept at every choice, so that no lane's weight exceeds N; a lane beyond its
//! critical angle leaves with weight 0. Facets are half-spaces, met without epsilon and without leaks.

use super::Tracer;
use super::path::Path;
use crate::bsdf::dielectric::{reflect_lanes, refract_lanes};
use crate::bsdf::{choose, keep_refracted};
use crate::geometry::{Hit, Shape};
use crate::math::{Lanes, Vectors};
use crate::scene::{Interface, MediumId, Physics};

/// Where lanes enter a stone, already refracted.
pub struct Entry<'a, const N: usize> {
    pub hit: &'a Hit,
    pub directions: Vectors<N>,
    pub interface: &'a Interface,
    /// What the stone stands in.
    pub outside: MediumId,
}

/// Where lanes leave a stone, and whereto.
pub struct Exits<const N: usize> {
    pub origins: Vectors<N>,
    pub directions: Vectors<N>,
}

impl<const P: u32> Tracer<'_, P> {
    /// Follows a path's lanes inside a convex solid until they leave; `None` when the path ends inside.
    pub fn trace_stone<const N: usize>(&self, entry: &Entry<N>, path: &mut Path<N>) -> Option<Exits<N>> {
        let Shape::Convex(solid) = self.scene.world.shape(entry.hit.shape)? else { return None };
        let Interface { medium, model, .. } = *entry.interface;
        let inside = self.n(medium, path.wavelengths);
        let outside = self.n(entry.outside, path.wavelengths);
        let fresnel = self.boundary(model, medium, entry.outside, path.wavelengths);
        let mut origins = Vectors::splat(entry.hit.point);
        let mut directions = entry.directions;
        while path.depth < self.max_depth {
            let exits = solid.exit_lanes(&origins, &directions);
            advance(&mut origins, &directions, &exits.t);
            self.absorb_each(path, medium, &exits.t);
            let normals = Vectors::from_fn(|lane| -solid.normal(exits.facet[lane]));
            let cos_theta_i = directions.dot(&normals).map(|cos| (-cos).clamp(0.0, 1.0));
            let boundary = fresnel.at(&inside, &outside, &cos_theta_i);
            let choice = choose(&path.throughput, &boundary.r, path.sampler.uniform());
            path.throughput *= choice.weight;
            path.depth += 1;
            if !choice.reflect {
                if Self::runs(Physics::COMPLEX_INDEX) && !keep_refracted(&mut path.throughput, &boundary.cos_theta_t) {
                    return None;
                }
                let eta = inside / outside;
                let directions = refract_lanes(&directions, &normals, &eta, &cos_theta_i, &boundary.cos_theta_t);
                return Some(Exits { origins, directions });
            }
            directions = reflect_lanes(&directions, &normals, &cos_theta_i);
            if !path.survives() {
                return None;
            }
        }
        None
    }

    /// Absorption over a length of its own for each lane.
    #[inline]
    fn absorb_each<const N: usize>(&self, path: &mut Path<N>, medium: MediumId, lengths: &[f32; N]) {
        if !self.needs(Physics::ABSORPTION) {
            return;
        }
        let Some(absorption) = self.scene.medium(medium).absorption else { return };
        let optical_depth = path.wavelengths.at(absorption) * Lanes(*lengths);
        path.throughput *= optical_depth.map(|depth| libm::expf(-depth));
    }
}

#[inline]
fn advance<const N: usize>(origins: &mut Vectors<N>, directions: &Vectors<N>, t: &[f32; N]) {
    for (lane, t) in t.iter().enumerate() {
        origins.x[lane] += directions.x[lane] * t;
        origins.y[lane] += directions.y[lane] * t;
        origins.z[lane] += directions.z[lane] * t;
    }
}
