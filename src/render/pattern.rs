//! A surface as it is where a path meets it: pictures in place of what is said of it as a whole.

use super::Tracer;
use super::vertex::Vertex;
use crate::geometry::Hit;
use crate::math::Lanes;
use crate::scene::{Interface, Pattern, Physics, Surface};
use crate::spectrum::SpectrumId;
use crate::texture::Texels;
use glam::Vec2;

impl<const P: u32> Tracer<'_, P> {
    /// What light meets at a hit, but for what pictures say of it.
    #[inline]
    pub fn surface(&self, hit: &Hit) -> &Surface {
        &self.scene.surfaces[self.scene.object(hit.shape).surface as usize]
    }

    /// Roughness α at a hit of what is so rough as a whole.
    ///
    /// Plain numbers go in and out, so that a scene without pictures pays for one test: a whole surface handed on took 2 % of the
    /// instructions of a sample of metals.
    #[inline]
    pub fn alpha(&self, whole: f32, hit: &Hit) -> f32 {
        if self.needs(Physics::TEXTURES) { self.printed_alpha(whole, hit) } else { whole }
    }

    #[inline]
    pub fn alpha_of_metal(&self, whole: f32, hit: &Hit) -> f32 {
        if Self::runs(Physics::ROUGH_METAL) { self.alpha(whole, hit) } else { 0.0 }
    }

    /// Reflectance at a hit of what reflects so as a whole.
    #[inline]
    pub fn reflectance<const N: usize>(&self, whole: SpectrumId, vertex: &Vertex<N>) -> Lanes<N> {
        if self.needs(Physics::TEXTURES) { self.printed(whole, *vertex) } else { vertex.wavelengths.at(whole) }
    }

    /// A clear boundary as it is at a hit.
    #[inline]
    pub fn boundary_at(&self, interface: &Interface, hit: &Hit) -> Interface {
        Interface { alpha: self.alpha(interface.alpha, hit), ..*interface }
    }

    #[inline(never)]
    fn printed_alpha(&self, whole: f32, hit: &Hit) -> f32 {
        let alphas = self.pattern(hit).and_then(|pattern| pattern.alpha.as_ref());
        alphas.map_or(whole, |alphas| self.value(alphas, hit))
    }

    #[inline(never)]
    fn printed<const N: usize>(&self, whole: SpectrumId, vertex: Vertex<N>) -> Lanes<N> {
        let Vertex { hit, wavelengths, .. } = vertex;
        let Some(tints) = self.pattern(hit).and_then(|pattern| pattern.reflectance.as_ref()) else {
            return wavelengths.at(whole);
        };
        let positions = wavelengths.positions();
        let around = tints.around(self.uv(hit));
        around.iter().fold(Lanes::ZERO, |sum, (tint, weight)| sum + tint.at(positions) * *weight)
    }

    #[inline]
    fn pattern(&self, hit: &Hit) -> Option<&Pattern> {
        self.scene.patterns.get(&self.scene.object(hit.shape).surface)
    }

    /// Shapes with pictures on them have texture coordinates: the scene has seen to it.
    #[inline]
    fn uv(&self, hit: &Hit) -> Vec2 {
        self.scene.world.uv(hit).unwrap_or_default()
    }

    /// As differences from one texel, so that equal ones give their value to the bit.
    #[inline]
    fn value(&self, texels: &Texels<f32>, hit: &Hit) -> f32 {
        let around = texels.around(self.uv(hit));
        let (first, _) = around[0];
        first + around.iter().map(|(value, weight)| (value - first) * weight).sum::<f32>()
    }
}
