//! Radiances as a display shows them: XYZ in cd/m² × 2^−EV, Bradford from the picture's white to the display's (D65).
//!
//! Nothing is clipped: what is brighter than white has L* > 100, and noise may be below 0, where L*a*b* is linear.

use crate::spectrum::{Matrix3, RgbSpace, Xyz, bradford, lab_from_xyz};

/// How pictures are looked at: the same way for all that are compared.
#[derive(Clone, Debug)]
pub struct View {
    /// From XYZ in cd/m² to XYZ relative to the display's white.
    display: Matrix3,
    rgb: Matrix3,
    white: Xyz,
}

impl View {
    /// Display white is 2^`ev` cd/m² of the chromaticity of `white`.
    pub fn new(ev: f64, white: Xyz) -> Self {
        let space = RgbSpace::Srgb;
        let adapt = bradford(white.map(|c| c / white[1]), space.white_xyz());
        Self {
            display: adapt.after(&Matrix3::diagonal([libm::exp2(-ev); 3])),
            rgb: space.rgb_from_xyz(),
            white: space.white_xyz(),
        }
    }

    /// XYZ relative to the display's white (its Y is 1).
    pub fn display(&self, xyz: [f32; 3]) -> Xyz {
        self.display.apply(xyz.map(f64::from))
    }

    /// The same of more digits.
    pub fn display_f64(&self, xyz: Xyz) -> Xyz {
        self.display.apply(xyz)
    }

    /// L*a*b* of XYZ relative to the display's white.
    pub fn lab(&self, display: Xyz) -> [f64; 3] {
        lab_from_xyz(display, self.white)
    }

    /// Linear sRGB of XYZ relative to the display's white.
    pub fn rgb(&self, display: Xyz) -> [f64; 3] {
        self.rgb.apply(display)
    }

    /// The matrix of [`Self::rgb`].
    pub fn rgb_from_display(&self) -> Matrix3 {
        self.rgb
    }

    /// The matrix from small differences of XYZ, relative to the display's white, to those of L*a*b*, at a colour.
    pub fn lab_slope(&self, display: Xyz) -> Matrix3 {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|i| root_slope(display[i] / self.white[i]) / self.white[i]);
        Matrix3([[0.0, 116.0 * y, 0.0], [500.0 * x, -500.0 * y, 0.0], [0.0, 200.0 * y, -200.0 * z]])
    }
}

/// Derivative of the cube root with its linear part, of which CIE 1976 L*a*b* is made (CIE 15:2004, equations 8.6–8.8).
fn root_slope(t: f64) -> f64 {
    if t > 216.0 / 24389.0 { 1.0 / (3.0 * libm::cbrt(t * t)) } else { 24389.0 / 27.0 / 116.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: Xyz = [1.0985, 1.0, 0.3558];

    #[test]
    fn the_pictures_white_is_the_displays() {
        let view = View::new(3.0, A);
        let white = view.display(A.map(|c| (8.0 * c) as f32));
        assert!(view.lab(white).iter().zip([100.0, 0.0, 0.0]).all(|(a, b)| (a - b).abs() < 1e-4));
        assert!(view.rgb(white).iter().all(|c| (c - 1.0).abs() < 1e-6));
    }

    #[test]
    fn slopes_are_those_of_lab() {
        let view = View::new(0.0, A);
        for colour in [[0.3, 0.2, 0.4], [0.9, 1.2, 1.0], [0.001, 0.002, 0.0005], [-0.01, 0.0, 0.02]] {
            let step = [1e-6, -2e-6, 3e-6];
            let linear = view.lab_slope(colour).apply(step);
            let ends = [-0.5, 0.5].map(|s| view.lab(std::array::from_fn(|i| colour[i] + s * step[i])));
            for i in 0..3 {
                assert!((ends[1][i] - ends[0][i] - linear[i]).abs() < 1e-9, "{colour:?}");
            }
        }
    }
}
