//! A sun: a small disk infinitely far away, the same from every point of the scene.
//!
//! It has a size, so that mirrors show it and stones split it. Half-angles are small: 1 − cos is kept, never cos, and whether a
//! direction meets the disk is told from the difference of two unit vectors, which has no cancellation.

use glam::Vec3;

/// Where a sun stands and how wide it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    toward: Vec3,
    across: Vec3,
    along: Vec3,
    /// 1 − cos of the half-angle.
    versine: f32,
}

impl Sun {
    /// A sun in a direction, `half_angle` in radians; `None` without a direction or beyond 0…π/2.
    pub fn new(toward: Vec3, half_angle: f64) -> Option<Self> {
        let toward = toward.as_dvec3().try_normalize()?.as_vec3();
        let sin = libm::sin(half_angle / 2.0);
        let versine = (2.0 * sin * sin) as f32;
        let (across, along) = toward.any_orthonormal_pair();
        (half_angle <= std::f64::consts::FRAC_PI_2 && versine > 1e-12).then_some(Self {
            toward,
            across,
            along,
            versine,
        })
    }

    /// Towards its middle.
    pub fn toward(&self) -> Vec3 {
        self.toward
    }

    /// Radians.
    pub fn half_angle(&self) -> f64 {
        2.0 * libm::asin((0.5 * f64::from(self.versine)).sqrt())
    }

    /// ∫ cos θ dω over the disk for a surface that faces it, sr: illuminance over luminance.
    pub fn projected_solid_angle(&self) -> f64 {
        let versine = f64::from(self.versine);
        std::f64::consts::PI * versine * (2.0 - versine)
    }

    /// Density of [`Self::sample`] in the disk, per steradian.
    #[inline]
    pub fn pdf(&self) -> f32 {
        1.0 / (std::f32::consts::TAU * self.versine)
    }

    /// A direction to a point of the disk, uniform in solid angle.
    #[inline]
    pub fn sample(&self, [u, v]: [f32; 2]) -> Vec3 {
        let versine = v * self.versine;
        let radius = (versine * (2.0 - versine)).max(0.0).sqrt();
        let (sin, cos) = libm::sincosf(u * std::f32::consts::TAU);
        self.toward * (1.0 - versine) + (self.across * cos + self.along * sin) * radius
    }

    /// Whether a direction meets the disk.
    #[inline]
    pub fn meets(&self, direction: Vec3) -> bool {
        0.5 * (direction - self.toward).length_squared() <= self.versine
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_fill_the_disk_and_nothing_else() {
        for half_angle in [0.1f64, 0.265, 5.0, 60.0].map(f64::to_radians) {
            let sun = Sun::new(Vec3::new(0.3, -0.5, 0.7), half_angle).unwrap();
            let n = 200;
            let (mut inner, mut met) = (0, 0);
            for i in 0..n * n {
                let direction = sun.sample([(i % n) as f32 + 0.5, (i / n) as f32 + 0.5].map(|x| x / n as f32));
                assert!((direction.length() - 1.0).abs() < 1e-6);
                met += i32::from(sun.meets(direction));
                let nearer = Sun { versine: 0.25 * sun.versine, ..sun };
                inner += i32::from(nearer.meets(direction));
            }
            // Equal shares of solid angle hold equal shares of samples; rounding may put a few on the rim outside.
            assert!(met >= n * n * 995 / 1000, "{met}");
            assert!((f64::from(inner) / f64::from(n * n) - 0.25).abs() < 0.01, "{inner}");
            let solid_angle = std::f64::consts::TAU * (1.0 - half_angle.cos());
            assert!((f64::from(sun.pdf()) * solid_angle - 1.0).abs() < 1e-4);
        }
    }

    #[test]
    fn impossible_suns_are_none() {
        assert!(Sun::new(Vec3::ZERO, 0.01).is_none());
        assert!(Sun::new(Vec3::Z, 0.0).is_none() && Sun::new(Vec3::Z, 2.0).is_none());
        assert!(Sun::new(Vec3::new(f32::NAN, 0.0, 1.0), 0.01).is_none() && Sun::new(Vec3::Z, f64::NAN).is_none());
    }
}
