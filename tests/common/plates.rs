//! Answers worked out on paper, and what makes a render agree with one.
//!
//! Nothing here calls the renderer's own optics: Fresnel's equations are the textbook's (Born & Wolf, *Principles of Optics*, 1.5.2)
//! for light without polarisation at each interface, which is what the renderer assumes; layers add as incoherent plates do
//! (G. G. Stokes, "On the intensity of the light reflected from or transmitted through a pile of plates", 1862).

use super::compare::{luminances, renders};
use super::{mean_and_error, z_against};
use glam::DVec3;
use spectrel::scene::Scene;

/// |z| beyond which a mean is wrong: 15 degrees of freedom, one failure in ten thousand.
pub const CRITICAL: f64 = 5.2;

/// Renders without noise to speak of may be off by rounding.
const ROUNDING: f64 = 3e-5;

/// Nothing here may be off by more, however large its spread.
const LIMIT: f64 = 5e-3;

/// The head of a scene seen along parallel rays from one point towards another.
pub fn looking(from: DVec3, at: DVec3, samples: u32) -> String {
    let (from, at) = (from.to_array(), at.to_array());
    format!(
        "meters_per_unit = 1\nrender = {{ width = 8, height = 8, filter = \"box\", samples = {samples} }}
        camera = {{ position = {from:?}, look_at = {at:?}, up = [0, 1, 0], orthographic_width = 0.05 }}\n"
    )
}

/// Seen from above, at an angle against the vertical.
pub fn seen(point: DVec3, cos: f64, samples: u32) -> String {
    looking(point + 9.0 * DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos), point, samples)
}

/// Light from below or from above only, 100 cd/m² straight up or down and less by the sine of the elevation.
pub fn half_sky(spectrum: &str, above: bool) -> String {
    let [zenith, nadir] = if above { [100, 0] } else { [0, 100] };
    format!(
        "environment.gradient.zenith = {{ spectrum = {spectrum}, luminance = {zenith} }}
        environment.gradient.horizon = {{ spectrum = {spectrum}, luminance = 0 }}
        environment.gradient.nadir = {{ spectrum = {spectrum}, luminance = {nadir} }}\n"
    )
}

/// Reflectance from n1 to n2 and the cosine beyond; 1 and 0 where all is reflected.
pub fn fresnel(n1: f64, n2: f64, cos: f64) -> (f64, f64) {
    let sin2 = (1.0 - cos * cos) * (n1 / n2).powi(2);
    if sin2 >= 1.0 {
        return (1.0, 0.0);
    }
    let beyond = (1.0 - sin2).sqrt();
    let s = (n1 * cos - n2 * beyond) / (n1 * cos + n2 * beyond);
    let p = (n2 * cos - n1 * beyond) / (n2 * cos + n1 * beyond);
    (0.5 * (s * s + p * p), beyond)
}

/// What a plane-parallel part of a stack reflects from above and from below, and lets through.
#[derive(Clone, Copy, Debug)]
pub struct Plates {
    pub r: f64,
    pub t: f64,
    r_below: f64,
}

impl Plates {
    /// One above the other, with all the light thrown to and fro between them.
    fn on(self, lower: Self) -> Self {
        let between = 1.0 / (1.0 - self.r_below * lower.r);
        Self {
            r: self.r + self.t * self.t * lower.r * between,
            t: self.t * lower.t * between,
            r_below: lower.r_below + lower.t * lower.t * self.r_below * between,
        }
    }
}

/// A layer: index, absorption per length, thickness.
pub type Layer = (f64, f64, f64);

/// A pile of layers seen from above in a medium of index `above` at an angle; what lies below has index `below`.
pub fn pile(above: f64, layers: &[Layer], below: f64, cos: f64) -> Plates {
    let (mut n, mut cos) = (above, cos);
    let mut plates = Plates { r: 0.0, t: 1.0, r_below: 0.0 };
    for &(index, absorption, thickness) in layers.iter().chain(&[(below, 0.0, 0.0)]) {
        let (r, beyond) = fresnel(n, index, cos);
        let tau = if absorption > 0.0 { (-absorption * thickness / beyond).exp() } else { 1.0 };
        plates = plates.on(Plates { r, t: 1.0 - r, r_below: r }).on(Plates { r: 0.0, t: tau, r_below: 0.0 });
        (n, cos) = (index, beyond);
    }
    plates
}

/// Whether independent luminances have this mean, by their own spread.
pub fn agrees(luminances: &[f64], expected: f64) -> bool {
    let (mean, _) = mean_and_error(luminances);
    let each: Vec<[f64; 3]> = luminances.iter().map(|&y| [y; 3]).collect();
    (mean - expected).abs() < ROUNDING * expected.abs() || z_against(&each, [expected; 3]) < CRITICAL
}

/// The mean luminance of a scene, by 16 seeds, must be the expected one and none of the wrong ones.
///
/// Gives back how far it is off, as a share.
pub fn check(name: &str, scene: &mut Scene, expected: f64, wrong: &[f64]) -> f64 {
    check_by(16, name, scene, expected, wrong)
}

/// The same by as many seeds as the wrong ones ask for.
pub fn check_by(seeds: u64, name: &str, scene: &mut Scene, expected: f64, wrong: &[f64]) -> f64 {
    let found = luminances(&renders(scene, 0..seeds));
    let (mean, error) = mean_and_error(&found);
    let off = mean / expected - 1.0;
    println!("{name}: {mean:.5} ± {error:.5}, expected {expected:.5}, off by {off:+.1e}");
    assert!(agrees(&found, expected) && off.abs() < LIMIT, "{name}: {mean} ± {error} against {expected}");
    for &wrong in wrong {
        assert!(!agrees(&found, wrong), "{name}: {mean} ± {error} is not told from {wrong}");
    }
    off
}
