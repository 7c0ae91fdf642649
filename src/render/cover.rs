//! Opaque surfaces that lie on faces of clear solids: from either side light meets them first, in
//! the medium on that side.
//!
//! Such a sheet is in optical contact, and where it lies there is no boundary: gold leaf on glass
//! is gold in air from outside and gold in glass from within, whichever of the two rounding puts
//! first. Which pairs there are `scene::resolve` finds out; a scene without them runs nothing of
//! this.

use super::Tracer;
use super::interface::MOST;
use crate::geometry::{Hit, Ray};
use crate::light::LightSample;
use crate::scene::Physics;

impl<const P: u32> Tracer<'_, P> {
    /// Whether something hides a light from a hit that a shadow ray leaves.
    #[inline]
    pub fn hidden(&self, shadow: &Ray, light: &LightSample, hit: &Hit) -> bool {
        let covers = |shape| self.scene.object(shape).covers;
        if Self::runs(Physics::CONTACT)
            && (covers(hit.shape) || light.target.is_some_and(|target| covers(target.shape)))
        {
            return self.hidden_from_cover(shadow, light);
        }
        self.scene.world.occluded(shadow, light.distance, light.target)
    }

    /// The same where a sheet on a clear face is at one end: that face, which rounding may put into
    /// the ray's way, hides nothing.
    #[inline(never)]
    fn hidden_from_cover(&self, shadow: &Ray, light: &LightSample) -> bool {
        let world = &self.scene.world;
        let mut also = Vec::new();
        while let Some(hit) = world.closest_beyond(shadow, &also, light.distance) {
            let is_clear = self.surface(&hit).is_clear();
            if !(is_clear && also.len() < MOST && world.is_at_origin(shadow, &hit)) {
                return !light.target.is_some_and(|target| world.is_at_end(shadow, &hit, light.distance, target));
            }
            also.push(hit.departure(hit.side.opposite()));
        }
        false
    }
}
