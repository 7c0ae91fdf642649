//! How far a picture is from a reference, and a render from its variant's mean.

use super::super::difference::Image;
use crate::film::View;
use crate::spectrum::{Xyz, ciede2000};
use rayon::prelude::*;

/// Means over a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Error {
    /// Of linear sRGB, over pixels and channels.
    pub mse: f64,
    pub rel_mse: f64,
    pub delta_e2000: f64,
}

/// Keeps dark pixels from counting without end.
const DARK: f64 = 0.01;

/// Of a picture, from a reference of as many pixels.
pub fn error(view: &View, reference: &Image, picture: &Image) -> Error {
    let of = |r: &[f32; 3], x: &[f32; 3]| {
        let [r, x] = [r, x].map(|xyz| view.display(*xyz));
        let squares: [f64; 3] = {
            let [r, x] = [r, x].map(|display| view.rgb(display));
            std::array::from_fn(|i| (x[i] - r[i]) * (x[i] - r[i]))
        };
        let base = view.rgb(r);
        let relative = (0..3).map(|i| squares[i] / (base[i] * base[i] + DARK)).sum::<f64>();
        [squares.iter().sum::<f64>() / 3.0, relative / 3.0, delta_e(view, r, x)]
    };
    let [mse, rel_mse, delta_e2000] = mean(reference, |i| of(&reference[i], &picture[i]));
    Error { mse, rel_mse, delta_e2000 }
}

/// Mean ΔE2000 of one render's noise: of a mean `m` and m + (a − b)/√2, with `a` and `b` two independent renders of it, whose
/// difference has twice the variance of either.
pub fn noise(view: &View, m: &Image, [a, b]: [&Image; 2]) -> f64 {
    let [noise] = mean(m, |i| {
        let [m, a, b] = [m[i], a[i], b[i]].map(|xyz| view.display(xyz));
        let noisy = std::array::from_fn(|c| m[c] + (a[c] - b[c]) * std::f64::consts::FRAC_1_SQRT_2);
        [delta_e(view, m, noisy)]
    });
    noise
}

/// The MSE of a reference that is known by its file alone, from two renders `a`, `b` of the same scene: the mean of (a − r)(b − r),
/// for what is noise in a and in b has nothing in common. As an estimate it may fall below 0.
pub fn common_square(view: &View, reference: &Image, [a, b]: [&Image; 2]) -> f64 {
    let [square] = mean(reference, |i| {
        let [r, a, b] = [reference[i], a[i], b[i]].map(|xyz| view.rgb(view.display(xyz)));
        [(0..3).map(|c| (a[c] - r[c]) * (b[c] - r[c])).sum::<f64>() / 3.0]
    });
    square
}

fn delta_e(view: &View, a: Xyz, b: Xyz) -> f64 {
    if a == b { 0.0 } else { ciede2000(view.lab(a), view.lab(b)) }
}

/// Pixels that are summed up at a time, whatever the number of threads.
const CHUNK: usize = 1024;

fn mean<const N: usize>(image: &Image, of: impl Fn(usize) -> [f64; N] + Sync) -> [f64; N] {
    let add = |sum: [f64; N], more: [f64; N]| std::array::from_fn(|i| sum[i] + more[i]);
    let chunk = |first: usize| (first..(first + CHUNK).min(image.len())).fold([0.0; N], |sum, i| add(sum, of(i)));
    let chunks: Vec<_> = (0..image.len()).into_par_iter().step_by(CHUNK).map(chunk).collect();
    chunks.into_iter().fold([0.0; N], add).map(|sum| sum / image.len().max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::RgbSpace;

    fn view() -> View {
        View::new(0.0, RgbSpace::Srgb.white_xyz())
    }

    fn image(pixels: &[[f64; 3]]) -> Image {
        pixels.iter().map(|rgb| RgbSpace::Srgb.xyz_from_rgb().apply(*rgb).map(|c| c as f32)).collect()
    }

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() < 2e-6 * (1.0 + b.abs())
    }

    #[test]
    fn errors_are_those_by_hand() {
        let (reference, picture) = (image(&[[0.5; 3], [0.2; 3]]), image(&[[0.5, 0.6, 0.5], [0.2, 0.2, 0.5]]));
        let found = error(&view(), &reference, &picture);
        assert!(near(found.mse, (0.01 + 0.09) / 6.0), "{found:?}");
        assert!(near(found.rel_mse, (0.01 / 0.26 + 0.09 / 0.05) / 6.0), "{found:?}");
        let lab = |rgb| view().lab(RgbSpace::Srgb.xyz_from_rgb().apply(rgb));
        let expected = ciede2000(lab([0.5; 3]), lab([0.5, 0.6, 0.5])) + ciede2000(lab([0.2; 3]), lab([0.2, 0.2, 0.5]));
        assert!(near(found.delta_e2000, expected / 2.0), "{found:?}");
        assert_eq!(error(&view(), &reference, &reference), Error::default());
    }

    /// Renders 0.5 ± 0.1 are 0.2 apart, as two of a standard deviation of 0.2 / √2 are.
    #[test]
    fn noise_is_that_of_one_render() {
        let [a, b, m] = [0.6, 0.4, 0.5].map(|grey| image(&[[grey; 3]]));
        let lab = |grey: f64| view().lab(RgbSpace::Srgb.xyz_from_rgb().apply([grey; 3]));
        let expected = ciede2000(lab(0.5), lab(0.5 + 0.2 / 2.0_f64.sqrt()));
        assert!(near(noise(&view(), &m, [&a, &b]), expected));
    }

    /// Of renders whose noise has nothing in common, only what the reference has wrong is left.
    #[test]
    fn a_file_is_judged_by_what_renders_agree_on() {
        let reference = image(&[[0.5; 3]; 4]);
        let a = image(&[[0.7; 3], [0.7; 3], [0.5; 3], [0.5; 3]]);
        let b = image(&[[0.7; 3], [0.5; 3], [0.7; 3], [0.5; 3]]);
        // Both 0.1 above in the mean, each ± 0.1.
        assert!(near(common_square(&view(), &reference, [&a, &b]), 0.01));
    }
}
