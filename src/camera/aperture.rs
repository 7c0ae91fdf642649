//! The opening of a lens: what is out of focus becomes a disk, or the polygon of the blades.
//!
//! A thin lens (R. Cook, T. Porter, L. Carpenter 1984, "Distributed ray tracing"): all rays of a point of the picture meet in
//! the plane of focus, wherever they pass the opening.

use super::CameraError;

/// The opening, in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aperture {
    pub radius: f32,
    /// Corners of the opening; 0 is round.
    pub blades: u32,
    /// From the camera to the plane of focus, along the direction of view.
    pub focus_distance: f32,
}

impl Aperture {
    /// Fails unless radius and distance are positive and the blades none or 3 to 32.
    pub fn new(radius: f64, blades: u32, focus_distance: f64) -> Result<Self, CameraError> {
        for (name, value) in [("the radius of the aperture", radius), ("focus_distance", focus_distance)] {
            if !(value > 0.0 && (value as f32).is_finite() && value as f32 > 0.0) {
                return Err(CameraError::Length { name, value });
            }
        }
        if !(blades == 0 || (3..=32).contains(&blades)) {
            return Err(CameraError::Blades(blades));
        }
        Ok(Self { radius: radius as f32, blades, focus_distance: focus_distance as f32 })
    }

    /// A point of the opening, uniform over its area, from two uniform numbers.
    #[inline]
    pub fn sample(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        let turn = |part: f32| {
            let (sin, cos) = libm::sincosf(part * std::f32::consts::TAU);
            [cos * self.radius, sin * self.radius]
        };
        if self.blades == 0 {
            let r = v.sqrt();
            return turn(u).map(|x| x * r);
        }
        // One of the triangles from the centre to two corners, then uniform in it.
        let blades = self.blades as f32;
        let blade = (u * blades).min(blades - 1.0) as u32 as f32;
        let (along, out) = (u * blades - blade, v.sqrt());
        let (a, b) = (turn(blade / blades), turn((blade + 1.0) / blades));
        [0, 1].map(|i| out * (a[i] + (b[i] - a[i]) * along))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean of x² + y² over a grid of the unit square, over the square of the radius.
    fn second_moment(aperture: &Aperture) -> f64 {
        let n = 400;
        let at = |i: i32| (i as f32 + 0.5) / n as f32;
        let square = |i: i32| {
            let [x, y] = aperture.sample([at(i % n), at(i / n)]);
            f64::from(x * x + y * y) / f64::from(aperture.radius * aperture.radius)
        };
        (0..n * n).map(square).sum::<f64>() / f64::from(n * n)
    }

    #[test]
    fn openings_are_filled_evenly() {
        // The polar moment over the area: 1/2 for a circle, (2 + cos(2π/n))/6 for n corners.
        let round = Aperture::new(0.3, 0, 1.0).unwrap();
        assert!((second_moment(&round) - 0.5).abs() < 1e-3);
        for blades in [3, 5, 6, 9] {
            let polygon = Aperture::new(0.3, blades, 1.0).unwrap();
            let expected = (2.0 + (std::f64::consts::TAU / f64::from(blades)).cos()) / 6.0;
            assert!((second_moment(&polygon) - expected).abs() < 1e-3, "{blades}");
            assert!((second_moment(&polygon) - second_moment(&round)).abs() > 1e-2, "{blades} differ from a circle");
        }
    }

    #[test]
    fn impossible_openings_are_errors() {
        assert!(Aperture::new(0.0, 0, 1.0).is_err());
        assert!(Aperture::new(0.1, 0, f64::NAN).is_err());
        assert_eq!(Aperture::new(0.1, 2, 1.0).unwrap_err(), CameraError::Blades(2));
    }
}
