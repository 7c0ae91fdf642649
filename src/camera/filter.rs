//! Pixel filters by importance sampling.
//!
//! A sample's position is drawn from the filter around the pixel's centre and counts with weight 1 in that pixel alone
//! (Ernst, Stamminger & Greiner 2006, "Filter importance sampling"), so every pixel is an independent sum and no sample is
//! splatted. All filters are separable and nowhere negative.
//!
//! A light smaller than a pixel gives all pixels together the same wherever it stands, if the filter's copies at all
//! pixels sum to a constant. The tent's do; the Blackman–Harris window's, as sharp as it, do not: 0.967 to 1.033 along
//! each axis (docs/notes/02-pixel-filter.md).

/// How the samples of a pixel lie around its centre.
#[derive(Clone, Debug)]
pub enum Filter {
    /// Uniform over the pixel's square.
    Box,
    /// Falls in a straight line to 0 at the centres of the next pixels.
    Tent,
    /// Blackman–Harris window of radius `RADIUS` pixels (Harris 1978, minimum four-term window).
    BlackmanHarris(Inverse),
}

/// Radius in pixels: the window's weight beyond one pixel is small, its frequency response has side lobes of −92 dB.
const RADIUS: f64 = 1.5;

/// Knots of the tabulated inverse distribution; linear between them.
const KNOTS: usize = 256;

/// Inverse of the window's distribution function, in pixels from the centre: for the half of it below the centre, at equal
/// steps of the fourth root of the probability. The window ends in a long faint tail, which equal steps of the probability
/// itself would cut straight.
#[derive(Clone, Debug)]
pub struct Inverse(Box<[f32; KNOTS + 1]>);

/// Integral of the window from −RADIUS to `x`.
fn blackman_harris_integral(x: f64) -> f64 {
    let phase = std::f64::consts::PI * (x / RADIUS + 1.0);
    let wave = 0.35875 * phase - 0.48829 * libm::sin(phase) + 0.14128 / 2.0 * libm::sin(2.0 * phase)
        - 0.01168 / 3.0 * libm::sin(3.0 * phase);
    wave * RADIUS / std::f64::consts::PI
}

impl Inverse {
    fn new() -> Self {
        let half = blackman_harris_integral(0.0);
        Self(Box::new(std::array::from_fn(|i| {
            let root = i as f64 / KNOTS as f64;
            let target = half * root * root * root * root;
            let (mut low, mut high) = (-RADIUS, 0.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if blackman_harris_integral(middle) < target { low = middle } else { high = middle }
            }
            (0.5 * (low + high)) as f32
        })))
    }

    #[inline]
    fn at(&self, u: f32) -> f32 {
        let (probability, side) = if u < 0.5 { (2.0 * u, 1.0) } else { (2.0 * (1.0 - u), -1.0) };
        let position = probability.sqrt().sqrt() * KNOTS as f32;
        let knot = (position as usize).min(KNOTS - 1);
        let fraction = position - knot as f32;
        side * (self.0[knot] * (1.0 - fraction) + self.0[knot + 1] * fraction)
    }
}

/// Inverse of the tent's distribution function.
#[inline]
fn tent(u: f32) -> f32 {
    if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 * (1.0 - u)).sqrt() }
}

impl Filter {
    /// No filter reaches further from a pixel's centre, in pixels.
    pub const REACH: f32 = RADIUS as f32;

    pub fn blackman_harris() -> Self {
        Self::BlackmanHarris(Inverse::new())
    }

    /// How far beyond a pixel's edge its points lie at most, in pixels.
    pub fn overhang(&self) -> f32 {
        match self {
            Self::Box => 0.0,
            Self::Tent => 0.5,
            Self::BlackmanHarris(_) => RADIUS as f32 - 0.5,
        }
    }

    /// A point around the pixel's centre, in pixels, from two uniform numbers.
    #[inline]
    pub fn sample(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        match self {
            Self::Box => [u - 0.5, v - 0.5],
            Self::Tent => [tent(u), tent(v)],
            Self::BlackmanHarris(inverse) => [inverse.at(u), inverse.at(v)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The window at `x` pixels from the centre, not normalised.
    fn blackman_harris(x: f64) -> f64 {
        let phase = std::f64::consts::PI * (x / RADIUS + 1.0);
        let terms = [0.35875, -0.48829, 0.14128, -0.01168];
        terms.iter().zip(0..).map(|(term, order)| term * libm::cos(f64::from(order) * phase)).sum()
    }

    /// χ² of 200,000 independent draws against the window's integral over 30 equal bins.
    fn chi_squared(density_at: impl Fn(f64) -> f64) -> f64 {
        const BINS: usize = 30;
        const SAMPLES: u32 = 200_000;
        let filter = Filter::blackman_harris();
        let mut counts = [0.0f64; BINS];
        let mut state = 1u64;
        for _ in 0..SAMPLES {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let u = (state >> 40) as f32 / (1u32 << 24) as f32;
            let [x, _] = filter.sample([u, 0.5]);
            let bin = (f64::from(x) / RADIUS + 1.0) / 2.0 * BINS as f64;
            counts[(bin as usize).min(BINS - 1)] += 1.0;
        }
        let edge = |i: usize| -RADIUS + 2.0 * RADIUS * i as f64 / BINS as f64;
        let expected: Vec<f64> = (0..BINS)
            .map(|i| {
                let steps = 200;
                let width = (edge(i + 1) - edge(i)) / f64::from(steps);
                (0..steps).map(|s| density_at(edge(i) + (f64::from(s) + 0.5) * width) * width).sum::<f64>()
            })
            .collect();
        let total: f64 = expected.iter().sum();
        let scaled = expected.iter().map(|e| e / total * f64::from(SAMPLES));
        counts.iter().zip(scaled).filter(|(_, e)| *e > 5.0).map(|(c, e)| (c - e) * (c - e) / e).sum()
    }

    /// How much a light as wide as a 32nd of a pixel, at any place, gives to all pixels together: the least and the most, over the mean.
    fn sums_over_pixels(filter: &Filter) -> [f64; 2] {
        const PLACES: usize = 32;
        const SAMPLES: u32 = 1 << 22;
        let mut sums = [0.0; PLACES];
        for i in 0..SAMPLES {
            let [x, _] = filter.sample([(i as f32 + 0.5) / SAMPLES as f32, 0.5]);
            let place = (f64::from(x) + 2.0).fract() * PLACES as f64;
            sums[place as usize] += PLACES as f64 / f64::from(SAMPLES);
        }
        [sums.iter().copied().fold(f64::INFINITY, f64::min), sums.iter().copied().fold(0.0, f64::max)]
    }

    #[test]
    fn a_small_light_is_as_bright_wherever_it_stands() {
        for filter in [Filter::Box, Filter::Tent] {
            let sums = sums_over_pixels(&filter);
            assert!(sums.iter().all(|sum| (sum - 1.0).abs() < 1e-4), "{filter:?}: {sums:?}");
        }
        let [least, most] = sums_over_pixels(&Filter::blackman_harris());
        assert!(least < 0.97 && most > 1.03, "the test must see what a Blackman–Harris window does: {least} {most}");
    }

    #[test]
    fn samples_follow_the_tent() {
        for x in [-1.0, -0.75, -0.3, 0.0, 0.1, 0.999f32] {
            let below = if x < 0.0 { 0.5 * (1.0 + x) * (1.0 + x) } else { 1.0 - 0.5 * (1.0 - x) * (1.0 - x) };
            let [found, _] = Filter::Tent.sample([below, 0.5]);
            assert!((found - x).abs() < 1e-4, "{found} for {x}");
        }
    }

    #[test]
    fn samples_follow_the_window() {
        // 99.9 % quantile of χ² with 29 degrees of freedom.
        let critical = 58.3;
        assert!(chi_squared(blackman_harris) < critical);
        assert!(chi_squared(|x| blackman_harris(x * 1.02)) > critical, "the test must see a window 2 % too narrow");
    }

    #[test]
    fn the_ends_of_the_unit_interval_stay_in_the_window() {
        let filter = Filter::blackman_harris();
        let last = 1.0 - f32::EPSILON / 2.0;
        for u in [0.0, last] {
            let [x, y] = filter.sample([u, u]);
            assert!(x.abs() <= RADIUS as f32 && y.abs() <= RADIUS as f32);
        }
        assert!(filter.sample([0.5, 0.5]).iter().all(|x| x.abs() < 1e-6));
        assert_eq!(Filter::Box.sample([0.5, 0.0]), [0.0, -0.5]);
    }
}
