//! From RGB to a reflectance: the sigmoid of `sigmoid` whose colour under D65 is the one given.
//!
//! W. Jakob & J. Hanika (2019) tabulate the fit, as `upsample_table` does for pictures; a scene itself names few colours, so
//! each of those is fitted when it is read, by Levenberg–Marquardt on linear RGB, from grey to the colour in steps. Colours that a reflectance can have come back
//! to 1e-6; near the corners of the sRGB cube nothing smooth reaches the colour, and [`Upsampler::rgb`] tells how far.

use std::path::Path;

use super::color::{Matrix3, bradford};
use super::integrate::quadrature;
use super::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, Library, Observer, RgbSpace, Sigmoid, Spectrum, SpectrumError};

/// Fits reflectances to colours under D65 for the CIE 1931 observer.
pub struct Upsampler {
    /// A wavelength, nm, and what a reflectance of 1 there adds to linear sRGB.
    samples: Vec<(f64, [f64; 3])>,
}

impl Upsampler {
    /// For linear sRGB.
    pub fn new(library: &Library) -> Result<Self, SpectrumError> {
        Self::for_space(library, RgbSpace::Srgb)
    }

    /// For linear RGB of a space; its white is the reflectance 1.
    pub fn for_space(library: &Library, space: RgbSpace) -> Result<Self, SpectrumError> {
        let observer = library.observer(Observer::Cie1931)?;
        let d65 = library.illuminant("D65", Path::new(""))?;
        let light = &d65.spectrum;
        let white = super::white_xyz(light, &observer)?;
        let y = super::tristimulus(&[light], &observer)[1];
        let rgb_from_xyz = space.rgb_from_xyz().after(&bradford(white, space.white_xyz()));
        let mut samples = Vec::new();
        quadrature(&[light], observer.y.wavelengths_nm(), 1, |nm, weight| {
            let scale = weight * light.at(nm) / y;
            if scale > 0.0 {
                samples.push((nm, rgb_from_xyz.apply(observer.at(nm).map(|value| value * scale))));
            }
        });
        Ok(Self { samples })
    }

    /// The same integral by few wavelengths, for thousands of fits: each of the many is shared among the four nearest of
    /// those every [`COARSE_NM`], such that cubics keep their integral.
    pub(super) fn coarse(&self) -> Self {
        let count = libm::round((LAMBDA_MAX_NM - LAMBDA_MIN_NM) / COARSE_NM) as usize + 1;
        let mut samples: Vec<_> = (0..count).map(|i| (LAMBDA_MIN_NM + COARSE_NM * i as f64, [0.0; 3])).collect();
        for (nm, weights) in &self.samples {
            let position = (nm - LAMBDA_MIN_NM) / COARSE_NM;
            let first = (position as usize).saturating_sub(1).min(count - 4);
            let x = position - first as f64;
            for (i, share) in cubic_shares(x).into_iter().enumerate() {
                (0..3).for_each(|channel| samples[first + i].1[channel] += share * weights[channel]);
            }
        }
        Self { samples }
    }

    /// The linear RGB of a reflectance under D65, white being (1, 1, 1).
    pub fn rgb(&self, reflectance: &Spectrum) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (nm, weights) in &self.samples {
            let value = reflectance.at(*nm);
            (0..3).for_each(|i| sum[i] += weights[i] * value);
        }
        sum
    }

    /// A reflectance of a colour in linear RGB, each channel 0…1. Grey is constant.
    pub fn reflectance(&self, rgb: [f64; 3]) -> Result<Spectrum, SpectrumError> {
        if let Some(&value) = rgb.iter().find(|value| !(0.0..=1.0).contains(*value)) {
            let what = "a channel of a reflectance's colour (linear sRGB)";
            return Err(SpectrumError::OutOfRange { what, value, expected: "0 to 1" });
        }
        let [r, g, b] = rgb;
        if r == g && g == b {
            return Ok(Spectrum::Constant(r));
        }
        let grey = ((r + g + b) / 3.0).clamp(0.01, 0.99);
        let mut fit = Sigmoid::grey(grey);
        for step in 1..=STEPS {
            let t = f64::from(step) / f64::from(STEPS);
            fit = self.fit(fit, rgb.map(|value| grey + (value - grey) * t), CLOSE);
        }
        Ok(Spectrum::Sigmoid(fit))
    }

    /// Levenberg–Marquardt from a start to the sigmoid nearest to a colour, or one whose error, squared, is below `close`.
    pub(super) fn fit(&self, mut fit: Sigmoid, target: [f64; 3], close: f64) -> Sigmoid {
        let mut damping = 1e-6;
        let (mut error, mut jacobian) = self.linearise(&fit, target);
        for _ in 0..ITERATIONS {
            if squares(error) < close {
                break;
            }
            let gradient = jacobian.transposed().apply(error);
            let mut normal = jacobian.transposed().after(&jacobian);
            (0..3).for_each(|i| normal.0[i][i] *= 1.0 + damping);
            let next = normal.inverse().map(|inverse| {
                let step = inverse.apply(gradient);
                Sigmoid(std::array::from_fn(|i| fit.0[i] - step[i]))
            });
            let better = next.map(|next| (next, self.linearise(&next, target)));
            match better {
                Some((next, (next_error, next_jacobian))) if squares(next_error) < squares(error) => {
                    (fit, error, jacobian) = (next, next_error, next_jacobian);
                    damping *= 0.1;
                }
                _ if damping > 1e12 => break,
                _ => damping = (damping * 10.0).max(1e-12),
            }
        }
        fit
    }

    /// rgb − target, and its derivatives with respect to the three numbers.
    fn linearise(&self, sigmoid: &Sigmoid, target: [f64; 3]) -> ([f64; 3], Matrix3) {
        let mut error = target.map(|value| -value);
        let mut jacobian = [[0.0; 3]; 3];
        for (nm, weights) in &self.samples {
            let x = sigmoid.argument(*nm);
            let root = libm::sqrt(1.0 + x * x);
            let value = 0.5 + 0.5 * x / root;
            let slope = 0.5 / (root * root * root);
            let t = Sigmoid::position(*nm);
            for i in 0..3 {
                error[i] += weights[i] * value;
                let by_x = weights[i] * slope;
                jacobian[i][0] += by_x * t * t;
                jacobian[i][1] += by_x * t;
                jacobian[i][2] += by_x;
            }
        }
        (error, Matrix3(jacobian))
    }
}

const STEPS: u32 = 4;
const ITERATIONS: usize = 40;
const CLOSE: f64 = 1e-24;
const COARSE_NM: f64 = 5.0;

/// Lagrange's weights of the points 0, 1, 2, 3 at x.
fn cubic_shares(x: f64) -> [f64; 4] {
    let [a, b, c, d] = [x, x - 1.0, x - 2.0, x - 3.0];
    [-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0]
}

fn squares(v: [f64; 3]) -> f64 {
    let sum: f64 = v.iter().map(|value| value * value).sum();
    if sum.is_nan() { f64::INFINITY } else { sum }
}
