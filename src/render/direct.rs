//! Light that a path finds by aiming at a lamp from a surface (next-event estimation).

use super::vertex::{Beyond, Vertex, Way};
use super::{Tracer, mis, rays};
use crate::bsdf::{Bsdf, Scatters, Sides};
use crate::geometry::Ray;
use crate::light::{LightSample, Receiver};
use crate::math::Lanes;
use crate::sampler::Sampler;
use crate::scene::MediumId;
use crate::spectrum::Wavelengths;

impl<const P: u32> Tracer<'_, P> {
    /// Returns the light from one point of one lamp, scattered towards ωo.
    #[inline(always)]
    pub fn direct<const N: usize>(
        &self,
        bsdf: &Bsdf<N>,
        vertex: &Vertex<N>,
        beyond: Option<&Beyond>,
        sampler: &mut Sampler,
    ) -> Lanes<N> {
        let (choice, u) = (sampler.uniform(), sampler.uniform_2d());
        let one_sided = bsdf.sides() == Sides::One;
        let receiver = Receiver { point: vertex.hit.point, normal: one_sided.then(|| vertex.hit.outward()) };
        let Some(light) = self.scene.lights.sample(&self.scene.world, &receiver, choice, u) else {
            return Lanes::ZERO;
        };
        let wi = vertex.frame.to_local(light.direction);
        let value = bsdf.eval(vertex.wo, wi);
        if value.pdf == 0.0 {
            return Lanes::ZERO;
        }
        let way = vertex.way(beyond, wi);
        let seen = vertex.terminator(bsdf, &way, light.direction);
        if seen == 0.0 {
            return Lanes::ZERO;
        }
        let arriving = self.arriving(&light, &way, vertex.wavelengths);
        value.f_cos * arriving * (seen * mis::weight(&light, value.pdf))
    }

    /// Returns what a point of a light sends to a surface on a way from there, in the measure of a path's throughput.
    #[inline]
    fn arriving<const N: usize>(&self, light: &LightSample, way: &Way, wavelengths: Wavelengths<N>) -> Lanes<N> {
        // What comes from infinity is outside of all solids, as it is for a ray that escapes.
        let medium = if light.distance == f32::INFINITY { MediumId::OUTSIDE } else { way.medium };
        let shadow = Ray::leaving(way.hit, way.side, light.direction);
        rays::count(1);
        if self.hidden(&shadow, light, way.hit) {
            return Lanes::ZERO;
        }
        light.radiance.at(wavelengths)
            * self.transmittance(medium, light.distance, wavelengths)
            * self.compression(medium, wavelengths)
    }
}
