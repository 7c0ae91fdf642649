//! A path at a surface that scatters, opaque or clear: light sampled directly, then a new direction for all lanes.

use super::Tracer;
use super::path::Path;
use super::vertex::{Beyond, Vertex};
use crate::bsdf::{Bsdf, Draw, Lobe, RoughDielectric, Scatters, Sides};
use crate::geometry::Ray;
use crate::sampler::Sampler;
use crate::scene::{Interface, Physics};
use std::ops::ControlFlow;

/// Draws no more numbers than the surface uses: a mirror has nothing to choose, and what is seen in it is chosen by the
/// better numbers.
#[inline(always)]
fn draw<const N: usize>(bsdf: &Bsdf<N>, sampler: &mut Sampler) -> Draw {
    let lobe = if bsdf.has_lobes() { sampler.uniform() } else { 0.0 };
    let uv = if bsdf.is_delta() { [0.0; 2] } else { sampler.uniform_2d() };
    Draw { lobe, uv }
}

impl<const P: u32> Tracer<'_, P> {
    /// Sends a path on from a surface; `beyond` is given where it is clear.
    #[inline(always)]
    pub fn scatter<const N: usize>(
        &self,
        bsdf: &Bsdf<N>,
        vertex: &Vertex<N>,
        beyond: Option<&Beyond>,
        path: &mut Path<N>,
    ) -> ControlFlow<()> {
        if self.needs(Physics::LIGHT_SAMPLING) && !bsdf.is_delta() {
            path.radiance += path.throughput * self.direct(bsdf, vertex, beyond, &mut path.sampler);
        }
        let draw = draw(bsdf, &mut path.sampler);
        let Some(sample) = bsdf.sample(vertex.wo, draw) else { return ControlFlow::Break(()) };
        let direction = vertex.frame.to_world(sample.wi);
        let way = vertex.way(beyond, sample.wi);
        let seen = vertex.terminator(bsdf, &way, direction);
        if seen == 0.0 {
            return ControlFlow::Break(());
        }
        path.throughput *= sample.weight * seen;
        path.pdf = if sample.lobe == Lobe::Mirror { f32::INFINITY } else { sample.pdf };
        path.normal = (bsdf.sides() == Sides::One).then(|| vertex.hit.outward());
        if let (Lobe::Transmission, Some(beyond)) = (sample.lobe, beyond) {
            path.media = beyond.media;
        }
        path.ray = Ray::leaving(way.hit, way.side, direction);
        ControlFlow::Continue(())
    }

    /// Sends a path on from a rough boundary of two clear media. All lanes go one way, whatever the index does: nothing
    /// parts here, and a lane that has parted elsewhere goes on alone with a density of its own.
    #[inline(never)]
    pub fn scatter_clear<const N: usize>(
        &self,
        interface: &Interface,
        vertex: Vertex<N>,
        beyond: &Beyond,
        path: &mut Path<N>,
    ) -> ControlFlow<()> {
        let (from, to) = (vertex.medium, beyond.media.current());
        let [n1, n2] = [from, to].map(|medium| self.n(medium, vertex.wavelengths));
        let fresnel = self.boundary(interface.model, from, to, vertex.wavelengths);
        let bsdf = RoughDielectric::new(fresnel, &n1, &n2, interface.alpha).into();
        self.scatter(&bsdf, &vertex, Some(beyond), path)
    }
}
