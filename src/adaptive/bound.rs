//! What may be promised of a picture's error: a number that it stays below with 95 %.
//!
//! Errors of pixels are those of [`Noise`]. Three things are added to what they are in the mean:
//!
//! - What their spread leaves open: 1.645 standard errors; pixels that share a covariance count once.
//! - What their skewness leaves open. Where few pixels have most of the noise, the mean is a sum of few: if y are its parts, its
//!   upper end lies (z² + 2)/3 · Σy³/Σy² further off, as it does for a Poisson number (z = 1.645; a compound Poisson sum to the same
//!   order, E. A. Cornish & R. A. Fisher, "Moments and cumulants in the specification of distributions", Revue de l'Institut
//!   International de Statistique 5 (1938)).
//! - What nobody has found yet ([`Unseen`]). Of paths that meet a light by chance, fewer than 3 are missing with 95 %
//!   (e⁻³ = 0.05), whatever they bring. Each brings at most the brightest light that has such a way. In
//!   the mean ΔE it is taken to lie evenly on all pixels, as ΔE grows less than light does; in the 95th percentile where it lifts that
//!   most (`lift`); in the RMSE where it would have been found by the pixels of the fewest samples.
//!
//! The mean ΔE of a pixel is at most √(8/3π) = 0.92 of its root mean square, where errors are normal (the same in three directions; 0.80
//! in one). The 95th percentile is that of pixels whose ΔE is spread like |N(0, 1)|, which has the longest tail of those that normal
//! errors make.

use super::lift::{self, Seen};
use super::noise::Noise;
use crate::film::View;
use crate::film::unseen::{EVENTS, Unseen};
use rayon::prelude::*;

/// One-sided 95 % of a normal distribution, in standard deviations.
const CONFIDENCE: f64 = 1.645;

/// What the skewness of a sum adds to its upper end.
const SKEW: f64 = (CONFIDENCE * CONFIDENCE + 2.0) / 3.0;

/// Mean over root mean square of the length of a normal vector that is the same in three directions.
const MEAN_OF_LENGTH: f64 = 0.9213;

/// Variance of the square of a normal number, over the square of its mean: an error is not its expectation.
const SQUARE_OF_NORMAL: f64 = 2.0;

/// What the 95th percentile is of.
const PERCENTILE: f64 = 0.95;

/// Pixels whose errors are enough to know a percentile by.
const ENOUGH: usize = 1 << 16;

/// |N(0, 1)| at the middles of sixteen equally likely parts.
const HALF_NORMAL: [f64; 16] = [
    0.0392, 0.1178, 0.1971, 0.2777, 0.3601, 0.4451, 0.5334, 0.6261, 0.7245, 0.8305, 0.9468, 1.0775, 1.2299, 1.4178,
    1.6759, 2.1539,
];

/// What a picture's error is, as estimated and as promised: below it with 95 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    pub estimate: f64,
    /// What light that was not found may add to it.
    pub missed: f64,
    pub promised: f64,
}

impl Bound {
    /// Of what nothing is known.
    const UNKNOWN: Self = Self { estimate: f64::INFINITY, missed: f64::INFINITY, promised: f64::INFINITY };

    /// Mean ΔE2000.
    pub fn of_mean_de(noise: &Noise, view: &View, unseen: &Unseen) -> Self {
        let (estimate, upper) = mean_and_upper(&noise.de, noise.sharing, 0.0);
        let [estimate, upper] = [estimate, upper].map(|de| MEAN_OF_LENGTH * de);
        Self::joined(estimate, upper, unseen.mean_de(view, &noise.colors))
    }

    /// 95th percentile of ΔE2000.
    pub fn of_de95(noise: &Noise, view: &View, unseen: &Unseen) -> Self {
        let chosen = spread(noise.de.len());
        let of =
            |(pixel, at): (usize, &usize)| HALF_NORMAL.map(|z| Seen { error: z * f64::from(noise.de[*at]), pixel });
        let mut seen: Vec<Seen> = chosen.iter().enumerate().flat_map(of).collect();
        seen.par_sort_unstable_by(|a, b| a.error.total_cmp(&b.error));
        // The rank of a percentile among as many errors as the picture has.
        let rank = PERCENTILE + CONFIDENCE * (PERCENTILE * (1.0 - PERCENTILE) / unseen.pixels).sqrt();
        let [estimate, upper] =
            [PERCENTILE, rank].map(|rank| place(seen.len(), rank).map_or(f64::INFINITY, |at| seen[at].error));
        if unseen.luminance() == 0.0 || !upper.is_finite() {
            return Self::joined(estimate, upper, 0.0);
        }
        let rises: Vec<_> = chosen.par_iter().map(|at| rise(unseen, view, &noise.colors[*at])).collect();
        let needed = seen.len() - place(seen.len(), PERCENTILE).unwrap_or(0);
        Self::joined(estimate, upper, lift::highest(&seen, &rises, needed) - estimate)
    }

    /// Root mean square error of linear sRGB.
    pub fn of_rmse(noise: &Noise, view: &View, unseen: &Unseen) -> Self {
        let (estimate, upper) = mean_and_upper(&noise.squares, 1.0, SQUARE_OF_NORMAL);
        let light: f64 = view.rgb(unseen.brightest).iter().map(|c| c * c / 3.0).sum();
        let missed = EVENTS * light / (unseen.samples * unseen.samples * unseen.pixels);
        let Self { estimate, missed, promised } = Self::joined(estimate, upper, missed);
        Self { estimate: estimate.sqrt(), missed: missed.sqrt(), promised: promised.sqrt() }
    }

    /// Of an error below `upper` with 95 %, to which light that was not found adds less than `missed` with 95 %: both luckless at once is
    /// rarer. Limits of a sum lie as far off as the root of the squares of what those of its parts do (G. Y. Zou & A. Donner,
    /// "Construction of confidence limits about effect measures", Statistics in Medicine 27 (2008)).
    fn joined(estimate: f64, upper: f64, missed: f64) -> Self {
        let promised = estimate + libm::hypot(upper - estimate, missed);
        // Of no pixels, too.
        if promised.is_finite() { Self { estimate, missed, promised } } else { Self::UNKNOWN }
    }
}

/// ΔE2000 that amounts of light make in a pixel of a colour: more light is taken to make no less.
fn rise(unseen: &Unseen, view: &View, color: &[f32; 3]) -> lift::Rise {
    let mut most: f64 = 0.0;
    lift::AMOUNTS.map(|amount| {
        most = most.max(unseen.delta_e(view, color, amount));
        most
    })
}

/// Indices of at most [`ENOUGH`] of so many pixels, which lie all over the picture and on no grid.
fn spread(pixels: usize) -> Vec<usize> {
    let count = pixels.min(ENOUGH);
    let step = pixels as f64 / count as f64;
    let golden = |i: usize| (0.618_033_988_749_895 * i as f64).fract();
    (0..count).map(|i| (step * (i as f64 + golden(i))) as usize).collect()
}

/// The index among sorted ones that a share of them do not exceed.
fn place(count: usize, share: f64) -> Option<usize> {
    let place = libm::ceil(share * count as f64) as usize;
    (count > 0).then(|| place.clamp(1, count) - 1)
}

/// The mean of values of which `sharing` count as one, and what it is below with 95 %, where what is promised differs from each value by
/// chance, with a variance of `own` times its square. Of no values it is no number.
fn mean_and_upper(values: &[f32], sharing: f64, own: f64) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().copied().map(f64::from).sum::<f64>() / count;
    let moment = |power: i32| values.iter().map(|value| (f64::from(*value) - mean).powi(power)).sum::<f64>();
    let (squares, cubes) = (moment(2), moment(3));
    let skew = if squares > 0.0 { SKEW * sharing * cubes.max(0.0) / (squares * count) } else { 0.0 };
    let realised = own * values.iter().map(|value| f64::from(*value) * f64::from(*value)).sum::<f64>();
    (mean, mean + CONFIDENCE * (sharing * squares + realised).sqrt() / count + skew)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Replicates;
    use crate::spectrum::ciede2000;

    fn view() -> View {
        View::new(0.0, [0.95, 1.0, 1.09])
    }

    fn all(noise: &Noise, unseen: &Unseen) -> [Bound; 3] {
        [Bound::of_mean_de, Bound::of_de95, Bound::of_rmse].map(|of| of(noise, &view(), unseen))
    }

    /// A promise of what nobody has measured would end a render before it has begun.
    #[test]
    fn what_is_not_known_is_not_promised() {
        let mut seen = Replicates::default();
        (0..16).for_each(|i| seen.add(i % 8, [1.0, 1.0, 1.0 + 0.01 * i as f32]));
        let known = Noise::of(&[seen; 4], 2, &view());
        assert!(all(&known, &Unseen::NOTHING).iter().all(|bound| bound.promised > 0.0 && bound.promised < 10.0));
        let unknown = Noise::of(&[seen, seen, seen, Replicates::default()], 2, &view());
        let nobody = Noise::of_half(&[seen], &[16], 1, &view(), 1);
        assert_eq!(all(&unknown, &Unseen::NOTHING), [Bound::UNKNOWN; 3]);
        assert_eq!(all(&nobody, &Unseen::NOTHING), [Bound::UNKNOWN; 3]);
    }

    fn grey(pixels: usize) -> Noise {
        Noise { de: vec![0.0; pixels], squares: vec![0.0; pixels], colors: vec![[0.2; 3]; pixels], sharing: 1.0 }
    }

    /// 3 paths of 4 × white among 100 pixels of 60 samples: 0.002 of white everywhere, all of it in the 81 of 1,600 errors that the
    /// percentile needs, and 3 (4/60)² / 100 if they were to come.
    #[test]
    fn what_may_be_missing_is_added() {
        let view = view();
        let white = view.display([0.95, 1.0, 1.09]);
        let unseen = Unseen { brightest: white.map(|c| 4.0 * c), samples: 60.0, pixels: 100.0 };
        let from = [0.2; 3].map(|c: f32| f64::from(c));
        let with =
            |share: f64| ciede2000(view.lab(from), view.lab(std::array::from_fn(|i| from[i] + share * white[i])));
        let expected =
            [with(0.002), with(0.002 * 1600.0 / 81.0), (3.0_f64 * (4.0 / 60.0) * (4.0 / 60.0) / 100.0).sqrt()];
        for ((found, expected), within) in all(&grey(100), &unseen).iter().zip(expected).zip([1e-5, 0.02, 1e-5]) {
            assert_eq!(found.estimate, 0.0);
            assert!((found.missed / expected - 1.0).abs() < within, "{found:?} {expected}");
            assert!((found.promised / found.missed - 1.0).abs() < 1e-12, "{found:?}");
        }
    }

    /// Sums of few equal parts are Poisson numbers: their upper ends are known.
    #[test]
    fn sums_of_few_have_the_upper_ends_of_poisson_numbers() {
        // Of the mean that 1, 3 and 10 events are too few for with 5 % (chi-squared quantiles, Garwood 1936).
        for (events, upper) in [(1, 4.74), (3, 7.75), (10, 16.96)] {
            let values: Vec<f32> = (0..1000).map(|i| if i < events { 1.0 } else { 0.0 }).collect();
            let (_, found) = mean_and_upper(&values, 1.0, 0.0);
            assert!((1000.0 * found / upper - 1.0).abs() < 0.12, "{events}: {} for {upper}", 1000.0 * found);
        }
    }

    /// The mean square of 100 normal errors is below 1.243 (a chi-squared quantile).
    #[test]
    fn even_noise_is_bounded_by_what_normal_errors_do() {
        let noise = Noise { de: vec![1.0; 100], squares: vec![1.0; 100], colors: vec![[0.2; 3]; 100], sharing: 1.0 };
        let [.., rmse] = all(&noise, &Unseen::NOTHING);
        assert!((rmse.promised / 1.243_f64.sqrt() - 1.0).abs() < 0.01, "{rmse:?}");
    }

    /// Of 100 pixels whose ΔE are spread over 0.01, 0.02 … 1, 95 % are below 1.267, and of 100 draws of them 95 are below the quantile of
    /// 0.95 + 1.645 √(0.95 · 0.05 / 100), which is 1.743 (mixtures of normal distributions, by quadrature).
    #[test]
    fn percentiles_are_promised_by_their_rank() {
        let de = (1..=100).map(|i| 0.01 * i as f32).collect();
        let noise = Noise { de, ..grey(100) };
        let bound = Bound::of_de95(&noise, &view(), &Unseen { pixels: 100.0, ..Unseen::NOTHING });
        assert!((bound.estimate / 1.2665 - 1.0).abs() < 0.02 && bound.missed == 0.0, "{bound:?}");
        assert!((bound.promised / 1.7426 - 1.0).abs() < 0.05, "{bound:?}");
    }
}
