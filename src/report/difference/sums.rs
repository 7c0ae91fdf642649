//! What a comparison adds up, pixel by pixel: see the head of [`super`] for what it is made of.

use super::super::jackknife::{Estimate, reach};
use super::{DeltaE, Difference, Missed, Verdict, percentile};
use crate::film::View;
use crate::spectrum::{Xyz, ciede2000, ciede2000_metric};

/// Pictures are in single precision: rounding loses or gains less than that, of energy and of mean ΔE2000, always to the same side.
const ROUNDING: f64 = 1e-6;
const ROUNDING_DELTA_E: f64 = 1e-4;

pub fn mean(replicates: &[Xyz]) -> Xyz {
    sum(replicates).map(|c| c / replicates.len() as f64)
}

fn sum(replicates: &[Xyz]) -> Xyz {
    replicates.iter().fold([0.0; 3], |sum, xyz| std::array::from_fn(|i| sum[i] + xyz[i]))
}

/// Σ ±x_r with as many plus as minus signs, scaled to the variance of the mean of all; an odd replicate is left out.
pub fn balanced(replicates: &[Xyz]) -> Xyz {
    let pairs = replicates.chunks_exact(2);
    let scale = 1.0 / ((2 * pairs.len().max(1) * replicates.len()) as f64).sqrt();
    let sum = pairs.fold([0.0; 3], |sum: Xyz, pair| std::array::from_fn(|i| sum[i] + pair[0][i] - pair[1][i]));
    sum.map(|c| c * scale)
}

fn dot(a: Xyz, b: Xyz) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn sum_of_squares(a: [f64; 3]) -> f64 {
    dot(a, a)
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// The part of a vector that goes along another one; nothing along nothing.
fn along(a: [f64; 3], b: [f64; 3]) -> f64 {
    let length = length(b);
    if length > 0.0 { dot(a, b) / length } else { 0.0 }
}

fn minus(a: Xyz, b: Xyz) -> Xyz {
    std::array::from_fn(|i| a[i] - b[i])
}

/// All replicates of one pixel in both pictures, relative to the display's white.
pub struct Pixel {
    reference: Vec<Xyz>,
    picture: Vec<Xyz>,
    /// The means of both.
    means: [Xyz; 2],
}

impl Pixel {
    pub fn new(reference: Vec<Xyz>, picture: Vec<Xyz>) -> Self {
        let means = [mean(&reference), mean(&picture)];
        Self { reference, picture, means }
    }

    fn delta_e(view: &View, [a, b]: [Xyz; 2]) -> f64 {
        if a == b { 0.0 } else { ciede2000(view.lab(a), view.lab(b)) }
    }

    /// The differences of all replicates in the metric of CIEDE2000 about the mean of both pictures, scaled so that their mean is as
    /// long as the ΔE2000 of the pictures, large as it may be.
    fn steps(&self, view: &View, differences: &[Xyz], delta_e: f64) -> Vec<Xyz> {
        let middle = mean(&self.means);
        let metric = ciede2000_metric(view.lab(middle)).after(&view.lab_slope(middle));
        let length = length(metric.apply(minus(self.means[1], self.means[0])));
        let scale = if length > 0.0 { delta_e / length } else { 1.0 };
        differences.iter().map(|difference| metric.apply(*difference).map(|part| part * scale)).collect()
    }

    fn differences(&self) -> Vec<Xyz> {
        self.picture.iter().zip(&self.reference).map(|(p, r)| minus(*p, *r)).collect()
    }
}

/// Sums over pixels.
#[derive(Clone, Debug)]
pub struct Sums {
    pixels: f64,
    delta_e: f64,
    delta_e_noise: f64,
    /// The same without replicate r.
    delta_e_without: Vec<f64>,
    /// Σ_r d_r · u₋ᵣ.
    beyond_noise: f64,
    /// The same without replicate r.
    beyond_noise_without: Vec<f64>,
    square: f64,
    square_noise: f64,
    relative_square: f64,
    /// Luminances of every replicate, of the reference and of the picture.
    energy: Vec<[f64; 2]>,
    /// Whether any replicate differs.
    differs: bool,
}

impl Sums {
    pub fn new(replicates: usize) -> Self {
        Self {
            pixels: 0.0,
            delta_e: 0.0,
            delta_e_noise: 0.0,
            delta_e_without: vec![0.0; replicates],
            beyond_noise: 0.0,
            beyond_noise_without: vec![0.0; replicates],
            square: 0.0,
            square_noise: 0.0,
            relative_square: 0.0,
            energy: vec![[0.0; 2]; replicates],
            differs: false,
        }
    }

    /// Gives the pixel's ΔE2000 and its difference of luminance.
    pub fn add(&mut self, view: &View, pixel: &Pixel) -> [f32; 2] {
        self.pixels += 1.0;
        for (sum, (reference, picture)) in self.energy.iter_mut().zip(pixel.reference.iter().zip(&pixel.picture)) {
            *sum = [sum[0] + reference[1], sum[1] + picture[1]];
        }
        let differences = pixel.differences();
        if differences.iter().all(|difference| *difference == [0.0; 3]) {
            return [0.0; 2];
        }
        self.differs = true;
        let delta_e = Pixel::delta_e(view, pixel.means);
        self.delta_e += delta_e;
        self.add_steps(&pixel.steps(view, &differences, delta_e));
        self.add_squares(view, pixel, balanced(&differences));
        [delta_e as f32, (pixel.means[1][1] - pixel.means[0][1]) as f32]
    }

    fn add_steps(&mut self, steps: &[Xyz]) {
        let total = sum(steps);
        for (r, step) in steps.iter().enumerate() {
            let others = minus(total, *step);
            self.delta_e_without[r] += length(others) / (steps.len() - 1) as f64;
            self.beyond_noise += along(*step, others);
            for (s, other) in steps.iter().enumerate().skip(r + 1) {
                let rest = minus(others, *other);
                self.beyond_noise_without[s] += along(*step, rest);
                self.beyond_noise_without[r] += along(*other, rest);
            }
        }
    }

    fn add_squares(&mut self, view: &View, pixel: &Pixel, noise: Xyz) {
        let [reference, picture] = pixel.means;
        let (base, difference) = (view.rgb(reference), view.rgb(minus(picture, reference)));
        let noisy = std::array::from_fn(|i| reference[i] + noise[i]);
        self.delta_e_noise += Pixel::delta_e(view, [reference, noisy]);
        self.square += sum_of_squares(difference);
        self.square_noise += sum_of_squares(view.rgb(noise));
        self.relative_square += (0..3).map(|i| difference[i] * difference[i] / (base[i] * base[i] + 0.01)).sum::<f64>();
    }

    pub fn merge(&mut self, other: &Self) {
        let add = |mine: &mut Vec<f64>, theirs: &[f64]| mine.iter_mut().zip(theirs).for_each(|(a, b)| *a += b);
        self.pixels += other.pixels;
        self.delta_e += other.delta_e;
        self.delta_e_noise += other.delta_e_noise;
        self.beyond_noise += other.beyond_noise;
        self.square += other.square;
        self.square_noise += other.square_noise;
        self.relative_square += other.relative_square;
        self.differs |= other.differs;
        add(&mut self.delta_e_without, &other.delta_e_without);
        add(&mut self.beyond_noise_without, &other.beyond_noise_without);
        for (a, b) in self.energy.iter_mut().zip(&other.energy) {
            *a = [a[0] + b[0], a[1] + b[1]];
        }
    }

    pub fn difference(&self, delta_e: &[f32]) -> Difference {
        let each = |sum: f64| sum / self.pixels.max(1.0);
        let (measured, energy) = (self.delta_e2000(delta_e), self.energy());
        let differs = measured.interval_95[0] > ROUNDING_DELTA_E
            || (energy.value.abs() > ROUNDING && energy.is_not_zero(self.energy.len()));
        Difference {
            verdict: match (self.differs, differs) {
                (false, _) => Verdict::Identical,
                (true, false) => Verdict::Indistinguishable,
                (true, true) => Verdict::Different,
            },
            delta_e2000: measured,
            rmse: each(self.square / 3.0).sqrt(),
            rmse_noise: each(self.square_noise / 3.0).sqrt(),
            rel_mse: each(self.relative_square / 3.0),
            energy,
            missed: Missed::default(),
        }
    }

    fn delta_e2000(&self, delta_e: &[f32]) -> DeltaE {
        let (pixels, count) = (self.pixels.max(1.0), self.energy.len() as f64);
        let reach =
            |without: &[f64], terms: f64| reach(&without.iter().map(|sum| sum / (terms * pixels)).collect::<Vec<_>>());
        let (mean, beyond_noise) = (self.delta_e / pixels, self.beyond_noise / (count * pixels));
        let low = beyond_noise - reach(&self.beyond_noise_without, count - 1.0);
        let high = mean + reach(&self.delta_e_without, 1.0);
        DeltaE {
            mean,
            percentile_95: percentile(delta_e, 0.95),
            max: delta_e.iter().copied().fold(0.0, f32::max).into(),
            noise: self.delta_e_noise / pixels,
            beyond_noise,
            interval_95: [low.max(0.0), high],
        }
    }

    fn energy(&self) -> Estimate {
        let gain = |[reference, picture]: [f64; 2]| if picture == reference { 0.0 } else { picture / reference - 1.0 };
        let total = self.energy.iter().fold([0.0; 2], |sum, energy| [sum[0] + energy[0], sum[1] + energy[1]]);
        let rest = |energy: &[f64; 2]| gain([total[0] - energy[0], total[1] - energy[1]]);
        Estimate::jackknife(gain(total), &self.energy.iter().map(rest).collect::<Vec<_>>())
    }
}
