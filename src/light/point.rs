//! A light without size: it shines from one point, in all directions or within a cone.
//!
//! Nothing can meet it by chance: smooth mirrors and glass do not show it, and only surfaces that scatter are lit. What
//! arrives at distance r is I / r², with the intensity I in W sr⁻¹ nm⁻¹ and r in metres.

use glam::{DVec3, Vec3};

/// Half of the narrowest cone, radians: 0.02° wide. Vectors in single precision tell narrower ones from nothing.
pub const NARROWEST: f64 = 1.745e-4;

fn versine(angle: f64) -> f64 {
    let sine = libm::sin(angle / 2.0);
    2.0 * sine * sine
}

/// Where a point light stands and whereto it shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    position: Vec3,
    /// Square metres in a square of scene units.
    square: f32,
    cone: Option<Cone>,
}

/// Full light up to `full`, none beyond `none`; between them it fades as 3t² − 2t³. Both are versines of angles against the axis,
/// 1 − cos, which keep their digits where cones are narrow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    axis: Vec3,
    full: f32,
    none: f32,
}

impl Cone {
    /// Angles in radians from the axis, 0 ≤ `full` ≤ `none` ≤ π; `None` for others, below `NARROWEST` and without a direction.
    pub fn new(axis: DVec3, full: f64, none: f64) -> Option<Self> {
        let axis = axis.try_normalize()?.as_vec3();
        let possible = full >= 0.0 && full <= none && (NARROWEST..=std::f64::consts::PI).contains(&none);
        possible.then(|| Self { axis, full: versine(full) as f32, none: versine(none) as f32 })
    }

    /// ∫ of what it lets through over all directions, sr. In the cosine the fade is symmetric, so its mean is a half.
    pub fn solid_angle(&self) -> f64 {
        let [full, none] = [self.full, self.none].map(f64::from);
        std::f64::consts::TAU * (full + none) / 2.0
    }

    /// Axis, and the angles from it up to which there is full light and any, radians.
    fn angles(&self) -> (DVec3, f64, f64) {
        let angle = |versine: f32| 2.0 * libm::asin(libm::sqrt((0.5 * f64::from(versine)).min(1.0)));
        (self.axis.as_dvec3(), angle(self.full), angle(self.none))
    }

    /// Share of the intensity in a direction away from the light.
    #[inline]
    fn share(&self, direction: Vec3) -> f32 {
        // From the difference of two unit vectors, which has no cancellation.
        let versine = 0.5 * (direction - self.axis).length_squared();
        if versine <= self.full {
            return 1.0;
        }
        let t = ((self.none - versine) / (self.none - self.full)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }
}

impl Point {
    pub fn new(position: Vec3, meters_per_unit: f64, cone: Option<Cone>) -> Self {
        Self { position, square: (meters_per_unit * meters_per_unit) as f32, cone }
    }

    pub fn position(&self) -> Vec3 {
        self.position
    }

    /// Irradiance per intensity at a distance in scene units, m⁻².
    pub fn irradiance(&self, distance: f64) -> f64 {
        1.0 / (distance * distance * f64::from(self.square))
    }

    /// Axis of its cone, and the angles from it up to which there is full light and any, radians.
    pub fn cone(&self) -> Option<(DVec3, f64, f64)> {
        self.cone.map(|cone| cone.angles())
    }

    /// The solid angle that it lights, sr.
    pub fn solid_angle(&self) -> f64 {
        self.cone.map_or(4.0 * std::f64::consts::PI, |cone| cone.solid_angle())
    }

    /// Direction and distance from a point to the light, and irradiance there per intensity, m⁻²; `None` where it does not
    /// shine.
    #[inline]
    pub fn seen_from(&self, from: Vec3) -> Option<(Vec3, f32, f32)> {
        let offset = self.position - from;
        let distance = offset.length();
        let direction = offset / distance;
        let share = self.cone.map_or(1.0, |cone| cone.share(-direction));
        let strength = share / (distance * distance * self.square);
        (strength > 0.0 && strength.is_finite()).then_some((direction, distance, strength))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cones_solid_angle_is_the_integral_of_its_share() {
        for (full, none) in [(0.0f64, 0.3), (0.2, 0.2), (0.4, 1.1), (1.0, 3.0), (3.1, std::f64::consts::PI)] {
            let cone = Cone::new(DVec3::new(0.3, -0.2, -1.0), full, none).unwrap();
            let across = cone.axis.any_orthonormal_vector();
            let n = 200_000;
            let integral: f64 = (0..n)
                .map(|i| {
                    let cosine = 2.0 * (f64::from(i) + 0.5) / f64::from(n) - 1.0;
                    let sine = (1.0 - cosine * cosine).sqrt();
                    let direction = cone.axis.as_dvec3() * cosine + across.as_dvec3() * sine;
                    f64::from(cone.share(direction.as_vec3()))
                })
                .sum::<f64>()
                * 2.0
                / f64::from(n)
                * std::f64::consts::TAU;
            assert!((integral / cone.solid_angle() - 1.0).abs() < 2e-3, "{full} {none}: {integral}");
        }
    }

    /// 0.02° wide: on its rim's plane r² = 2 · versine, and the share of a disk of directions is what the solid angle says.
    #[test]
    fn narrow_cones_keep_their_digits() {
        for none in [NARROWEST, 1e-3, 1e-2] {
            let cone = Cone::new(DVec3::new(0.3, -0.2, -1.0), none, none).unwrap();
            let expected = std::f64::consts::PI * none * none * (1.0 - none * none / 12.0);
            assert!((cone.solid_angle() / expected - 1.0).abs() < 1e-6, "{none}");
            let across = cone.axis.any_orthonormal_vector();
            let at = |angle: f64| (cone.axis.as_dvec3() * angle.cos() + across.as_dvec3() * angle.sin()).as_vec3();
            assert!(cone.share(at(0.99 * none)) == 1.0 && cone.share(at(1.01 * none)) == 0.0, "{none}");
        }
    }

    #[test]
    fn impossible_cones_are_none() {
        assert!(Cone::new(DVec3::ZERO, 0.1, 0.2).is_none());
        assert!(Cone::new(DVec3::X, 0.3, 0.2).is_none() && Cone::new(DVec3::X, f64::NAN, 0.2).is_none());
        assert!(Cone::new(DVec3::X, 0.0, 0.0).is_none() && Cone::new(DVec3::X, 1.0, 4.0).is_none());
    }

    #[test]
    fn nothing_arrives_at_the_light_itself_or_outside_of_its_cone() {
        let cone = Cone::new(DVec3::NEG_Z, 0.1, 0.2);
        let light = Point::new(Vec3::Z, 0.5, cone);
        assert_eq!(light.seen_from(Vec3::Z), None);
        assert_eq!(light.seen_from(Vec3::new(1.0, 0.0, 0.0)), None);
        let (direction, distance, strength) = light.seen_from(Vec3::new(0.0, 0.0, -1.0)).unwrap();
        assert_eq!((direction, distance, strength), (Vec3::Z, 2.0, 1.0));
    }
}
