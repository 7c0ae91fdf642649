//! A surface as it is where a path meets it: pictures in place of what is said of it as a whole.

use super::Kernel;
use crate::geometry::Hit;
use crate::scene::{Interface, Pattern, Surface};
use crate::spectrum::{Lanes, SpectrumId};
use crate::texture::Texels;
use glam::Vec2;

impl Kernel<'_> {
    /// What light meets at a hit.
    #[inline]
    pub fn surface(&self, hit: &Hit) -> Surface {
        let surface = self.scene.surfaces[self.scene.object(hit.shape).surface as usize];
        if self.needs.textures { self.patterned(surface, hit) } else { surface }
    }

    /// Reflectance at a hit of what reflects so as a whole.
    #[inline]
    pub fn reflectance<const N: usize>(&self, whole: SpectrumId, hit: &Hit, offset: u32) -> Lanes<N> {
        if self.needs.textures { self.printed(whole, hit, offset) } else { self.tables.get(whole, offset) }
    }

    #[inline(never)]
    fn patterned(&self, surface: Surface, hit: &Hit) -> Surface {
        let Some(alphas) = self.pattern(hit).and_then(|pattern| pattern.alpha.as_ref()) else { return surface };
        let alpha = self.value(alphas, hit);
        match surface {
            Surface::Conductor { n, k, model, .. } => Surface::Conductor { n, k, alpha, model },
            Surface::Dielectric(interface) => Surface::Dielectric(Interface { alpha, ..interface }),
            other => other,
        }
    }

    #[inline(never)]
    fn printed<const N: usize>(&self, whole: SpectrumId, hit: &Hit, offset: u32) -> Lanes<N> {
        let Some(tints) = self.pattern(hit).and_then(|pattern| pattern.reflectance.as_ref()) else {
            return self.tables.get(whole, offset);
        };
        let positions = self.tables.positions(offset);
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
