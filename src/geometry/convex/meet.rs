//! A convex solid and a ray that comes from elsewhere.

use glam::Vec3;

use super::Convex;
use super::planes::BLOCK;
use crate::geometry::ray::{Crossing, Probe, Side, sum_abs};

const EPSILON: f32 = f32::EPSILON;

impl Convex {
    /// The exit of a ray that sets off from the surface inwards.
    #[inline]
    pub(in crate::geometry) fn exit(&self, origin: Vec3, direction: Vec3) -> Crossing {
        let (t, facet) = self.exit_one(origin, direction);
        let error = 4.0 * EPSILON * (sum_abs(origin) + self.radius);
        Crossing { t, slack: self.slack(error, t, facet, direction), side: Side::Inside, facet, place: 0 }
    }

    /// A ray from elsewhere: where it enters, or if it begins truly inside where it leaves.
    ///
    /// Inside means behind every plane by more than rounding can explain. At the surface to within rounding, the ray
    /// belongs to something that touches the solid there: moving in, it has yet to enter (t = 0); moving out, it is gone.
    #[inline]
    pub(in crate::geometry) fn meet(&self, probe: &Probe) -> Option<Crossing> {
        let o = probe.ray.origin - self.center;
        let d = probe.ray.direction;
        // Most rays pass by: the sphere around the solid is a quarter of the work of the planes or less.
        let along = o.dot(d);
        let error = probe.origin_error + 4.0 * EPSILON * (sum_abs(o) + self.radius);
        let reach = self.radius + 2.0 * error;
        if (o - d * along).length_squared() > reach * reach * (1.0 + 8.0 * EPSILON) {
            return None;
        }
        let mut enter = [f32::NEG_INFINITY; BLOCK];
        let mut enter_block = [0u32; BLOCK];
        let mut leave = [f32::INFINITY; BLOCK];
        let mut outside = [false; BLOCK];
        let mut missed = [false; BLOCK];
        for (number, block) in self.blocks.iter().enumerate() {
            for k in 0..BLOCK {
                let rate = block.x[k] * d.x + block.y[k] * d.y + block.z[k] * d.z;
                let room = block.offset[k] - (block.x[k] * o.x + block.y[k] * o.y + block.z[k] * o.z);
                let t = room / rate;
                let behind = room > error;
                let entering = rate < 0.0;
                outside[k] |= !behind;
                missed[k] |= !behind & !entering;
                let later = entering & (t > enter[k]);
                enter[k] = if later { t } else { enter[k] };
                enter_block[k] = if later { number as u32 } else { enter_block[k] };
                // (Not `!entering`: room / −0 is −∞.)
                leave[k] = if (rate > 0.0) & (t < leave[k]) { t } else { leave[k] };
            }
        }
        if !outside.contains(&true) {
            let (t, facet) = self.exit_one(probe.ray.origin, d);
            return Some(Crossing { t, slack: self.slack(error, t, facet, d), side: Side::Inside, facet, place: 0 });
        }
        if missed.contains(&true) {
            return None;
        }
        let mut best = (f32::NEG_INFINITY, 0u32);
        let mut last = f32::INFINITY;
        for k in 0..BLOCK {
            let facet = enter_block[k] * BLOCK as u32 + k as u32;
            if enter[k] > best.0 || (enter[k] == best.0 && facet < best.1) {
                best = (enter[k], facet);
            }
            last = if leave[k] < last { leave[k] } else { last };
        }
        let (t, facet) = (best.0.max(0.0), best.1);
        let facet = *self.order.get(facet as usize)?;
        if !(t <= last) {
            return None;
        }
        Some(Crossing { t, slack: self.slack(error, t, facet, d), side: Side::Outside, facet, place: 0 })
    }

    #[inline]
    fn slack(&self, error: f32, t: f32, facet: u32, direction: Vec3) -> f32 {
        error / self.normal(facet).dot(direction).abs() + 4.0 * EPSILON * t
    }
}
