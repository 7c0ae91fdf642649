//! The colour difference CIEDE2000 (G. Sharma, W. Wu & E. N. Dalal, "The CIEDE2000 color-difference formula:
//! implementation notes, supplementary test data, and mathematical observations", Color Research & Application 30
//! (2005), equations 2–22). 1 is about what an eye can just tell.

use super::Matrix3;
use std::f64::consts::PI;

/// ΔE00 of two colours in L*a*b*, k_L = k_C = k_H = 1.
pub fn ciede2000(first: [f64; 3], second: [f64; 3]) -> f64 {
    let ([l1, a1, b1], [l2, a2, b2]) = (first, second);
    let mean_chroma = 0.5 * (libm::hypot(a1, b1) + libm::hypot(a2, b2));
    let g = 0.5 * (1.0 - seventh_root_ratio(mean_chroma));
    let (a1, a2) = ((1.0 + g) * a1, (1.0 + g) * a2);
    let (c1, c2) = (libm::hypot(a1, b1), libm::hypot(a2, b2));
    let (h1, h2) = (hue(a1, b1), hue(a2, b2));

    let grey = c1 * c2 == 0.0;
    let apart = h2 - h1;
    let d_hue = match () {
        () if grey => 0.0,
        () if apart > PI => apart - 2.0 * PI,
        () if apart < -PI => apart + 2.0 * PI,
        () => apart,
    };
    let d_l = l2 - l1;
    let d_c = c2 - c1;
    let d_h = 2.0 * libm::sqrt(c1 * c2) * libm::sin(0.5 * d_hue);

    let mean_l = 0.5 * (l1 + l2);
    let mean_c = 0.5 * (c1 + c2);
    let sum = h1 + h2;
    let mean_h = match () {
        () if grey => sum,
        () if apart.abs() <= PI => 0.5 * sum,
        () if sum < 2.0 * PI => 0.5 * (sum + 2.0 * PI),
        () => 0.5 * (sum - 2.0 * PI),
    };

    let scales = Scales::at(mean_l, mean_c, mean_h);
    let (l, c, h) = (d_l / scales.lightness, d_c / scales.chroma, d_h / scales.hue);
    libm::sqrt((l * l + c * c + h * h + scales.rotation * c * h).max(0.0))
}

/// The matrix that makes ΔE00 of a small difference about a colour in L*a*b* the length of a vector: its metric there.
///
/// Equations 2–22 to first order: both colours share G, so that a′ is linear; ΔC′ and ΔH′ are along and across the colour's own
/// direction; c² + h² + R_T c h is a sum of two squares.
pub fn ciede2000_metric([l, a, b]: [f64; 3]) -> Matrix3 {
    let g = 0.5 * (1.0 - seventh_root_ratio(libm::hypot(a, b)));
    let a = (1.0 + g) * a;
    let chroma = libm::hypot(a, b);
    let [along_a, along_b] = if chroma > 0.0 { [a / chroma, b / chroma] } else { [1.0, 0.0] };
    let scales = Scales::at(l, chroma, hue(a, b));
    let c = [(1.0 + g) * along_a, along_b].map(|part| part / scales.chroma);
    let h = [-(1.0 + g) * along_b, along_a].map(|part| part / scales.hue);
    let turn = 0.5 * scales.rotation;
    let rest = libm::sqrt(1.0 - turn * turn);
    Matrix3([
        [1.0 / scales.lightness, 0.0, 0.0],
        [0.0, c[0] + turn * h[0], c[1] + turn * h[1]],
        [0.0, rest * h[0], rest * h[1]],
    ])
}

/// What differences are divided by about a colour: S_L, S_C, S_H; and R_T between the last two.
struct Scales {
    lightness: f64,
    chroma: f64,
    hue: f64,
    rotation: f64,
}

impl Scales {
    /// Equations 15–21, at the means of L, C′ and h′ (radians).
    fn at(mean_l: f64, mean_c: f64, mean_h: f64) -> Self {
        let degrees = |value: f64| value * PI / 180.0;
        let t = 1.0 - 0.17 * libm::cos(mean_h - degrees(30.0))
            + 0.24 * libm::cos(2.0 * mean_h)
            + 0.32 * libm::cos(3.0 * mean_h + degrees(6.0))
            - 0.20 * libm::cos(4.0 * mean_h - degrees(63.0));
        let from_blue = (mean_h / degrees(1.0) - 275.0) / 25.0;
        let rotation = degrees(30.0) * libm::exp(-from_blue * from_blue);
        let l50 = (mean_l - 50.0) * (mean_l - 50.0);
        Self {
            lightness: 1.0 + 0.015 * l50 / libm::sqrt(20.0 + l50),
            chroma: 1.0 + 0.045 * mean_c,
            hue: 1.0 + 0.015 * mean_c * t,
            rotation: -libm::sin(2.0 * rotation) * 2.0 * seventh_root_ratio(mean_c),
        }
    }
}

/// √(C⁷ / (C⁷ + 25⁷))
fn seventh_root_ratio(chroma: f64) -> f64 {
    let cube = chroma * chroma * chroma;
    let c7 = cube * cube * chroma;
    libm::sqrt(c7 / (c7 + 6_103_515_625.0))
}

/// Hue angle, 0…2π; 0 for grey.
fn hue(a: f64, b: f64) -> f64 {
    let angle = libm::atan2(b, a);
    if a == 0.0 && b == 0.0 {
        0.0
    } else if angle < 0.0 {
        angle + 2.0 * PI
    } else {
        angle
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_metric_is_that_of_small_differences() {
        let colours =
            [[50.0, 20.0, -70.0], [30.0, -40.0, 5.0], [80.0, 0.1, 0.2], [60.0, 70.0, 40.0], [20.0, 5.0, -30.0]];
        for colour in colours {
            for step in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.3, -0.8, 0.5]] {
                let step = step.map(|part| 1e-4 * part);
                let ends = [-0.5, 0.5].map(|s| std::array::from_fn(|i| colour[i] + s * step[i]));
                let expected = ciede2000(ends[0], ends[1]);
                let found = libm::sqrt(ciede2000_metric(colour).apply(step).iter().map(|part| part * part).sum());
                assert!((found / expected - 1.0).abs() < 1e-6, "{colour:?} {step:?}: {found} {expected}");
            }
        }
    }
}
