//! Random directions and numbers for proptest, their corners included.

use glam::{DVec3, Vec3};
use proptest::prelude::*;

/// Above the horizon, straight up and next to level among them.
pub fn upper() -> impl Strategy<Value = Vec3> {
    let height = prop_oneof![0.0f32..1.0, Just(1.0f32), (-7.0f32..0.0).prop_map(|x| 10f32.powf(x))];
    (height, 0.0f64..6.3).prop_map(|(z, phi)| {
        let sin = (1.0 - z as f64 * z as f64).sqrt();
        DVec3::new(sin * phi.cos(), sin * phi.sin(), z as f64).as_vec3()
    })
}

/// Off the horizon by at least `height`, where a rounding of ωo does not change the answer.
pub fn above(height: f32) -> impl Strategy<Value = Vec3> {
    upper().prop_map(move |direction| Vec3::new(direction.x, direction.y, direction.z.max(height)).normalize())
}

/// In [0, 1), both ends among them.
pub fn unit() -> impl Strategy<Value = f32> {
    prop_oneof![0.0f32..1.0, Just(0.0f32), Just(0.999_999_94f32)]
}
