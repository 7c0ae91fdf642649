//! How far each model is from the exact equations: in reflectance, in colour, after several bounces and under other lights.
//!
//! - Over the cosines 0, 0.01, … 1. Reflectances and colours are linear sRGB, unclipped; ΔE is CIEDE2000 against a perfect reflector as white.
//! - `max_abs` and `rms` are over all channels and angles, `de_*` over the angles, after one bounce under the first light (D65).
//! - F_avg = 2 ∫ F c dc of each channel, by Simpson's rule over those cosines: within 2e-6 (tested against `fresnel::average`).
//! - After m bounces at equal angle the colour is that of F(λ, c)^m. An RGB model has its channels' powers, whatever the light; exact colours are
//!   adapted from the light's white (Bradford). That is the kindest reading of RGB: of gold's F0 it is off by ΔE 1.0 under A. Were nothing
//!   adapted, and the channels multiplied with those of the light, it would be off by 6.9 (`tests/it/fresnel/errors.rs`).

use super::Subject;
use crate::fresnel::{COSINES, FresnelModel, RgbCurve, Tabulated, Target};
use crate::spectrum::{Colorimeter, ciede2000};
use serde::Serialize;
use std::collections::BTreeMap;

/// Numbers of bounces that errors are given for.
pub const BOUNCES: [i32; 4] = [1, 2, 3, 5];

/// A light that colours are seen under.
#[derive(Clone, Debug)]
pub struct Light {
    pub name: String,
    pub meter: Colorimeter,
}

/// The errors of one model on one material: an object of the JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    pub material: String,
    /// The data set.
    pub ior: String,
    pub model: FresnelModel,
    pub max_abs: f64,
    /// cos θ where it is.
    pub cos_at_max: f64,
    pub rms: f64,
    pub de_mean: f64,
    pub de_max: f64,
    pub cos_at_de_max: f64,
    /// The largest difference of F_avg among the channels.
    pub f_avg_max_abs: f64,
    /// ΔE of the two F_avg.
    pub f_avg_de: f64,
    /// Nanoseconds of one evaluation at a hit, eight wavelengths.
    pub ns: f64,
    /// What was fitted, for red, green and blue.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub fitted: BTreeMap<&'static str, [f64; 3]>,
    /// For each light and each of [`BOUNCES`].
    pub colors: Vec<ColorError>,
}

/// ΔE of the colours under one light after some bounces.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ColorError {
    pub light: String,
    pub bounces: i32,
    pub de_mean: f64,
    pub de_max: f64,
    pub cos_at_de_max: f64,
    /// At normal incidence.
    pub de_normal: f64,
}

impl Row {
    /// Under a light after some bounces, if that was asked.
    pub fn color(&self, light: &str, bounces: i32) -> Option<&ColorError> {
        self.colors.iter().find(|color| color.light == light && color.bounces == bounces)
    }
}

/// What a model reflects at each of the cosines.
enum Reflected {
    /// By wavelength.
    Spectra(Vec<Vec<f64>>),
    Colors(Vec<[f64; 3]>),
}

/// The wavelengths of all lights, and where those of each stand among them.
struct Wavelengths {
    nm: Vec<f64>,
    places: Vec<Vec<usize>>,
}

impl Wavelengths {
    fn new(lights: &[Light]) -> Self {
        let mut nm: Vec<f64> = lights.iter().flat_map(|light| light.meter.wavelengths_nm()).collect();
        nm.sort_by(f64::total_cmp);
        nm.dedup();
        let places = |light: &Light| light.meter.wavelengths_nm().map(|at| nm.partition_point(|&nm| nm < at)).collect();
        let places = lights.iter().map(places).collect();
        Self { nm, places }
    }
}

/// What all models on one material are measured with.
struct Measure<'a> {
    lights: &'a [Light],
    wavelengths: Wavelengths,
    exact: Reflected,
}

/// The errors of models on one material; `ns` tells what each costs. The first light is what RGB models are fitted under.
pub fn rows(
    subject: &Subject,
    models: &[FresnelModel],
    lights: &[Light],
    ns: impl Fn(FresnelModel) -> f64,
) -> Vec<Row> {
    let Some(first) = lights.first() else { return Vec::new() };
    let target = Target::new(subject.specimen, &first.meter);
    let wavelengths = Wavelengths::new(lights);
    let exact = reflected(&Tabulated::new(FresnelModel::EXACT, &target), &wavelengths);
    let measure = Measure { lights, wavelengths, exact };
    let exact = measure.all_colors(&measure.exact);
    let row = |&model: &FresnelModel| {
        let tabulated = Tabulated::new(model, &target);
        let found = measure.all_colors(&reflected(&tabulated, &measure.wavelengths));
        measure.row(subject, model, (&found, &exact), ns(model), fitted(&tabulated))
    };
    models.iter().map(row).collect()
}

fn reflected(tabulated: &Tabulated, wavelengths: &Wavelengths) -> Reflected {
    match tabulated.rgb_curve() {
        Some(curve) => {
            Reflected::Colors(Target::cosines().map(|cos| curve.reflectance(cos as f32).0.map(f64::from)).collect())
        }
        None => {
            let spectrum = |cos| wavelengths.nm.iter().map(|&nm| tabulated.at(nm, cos).unwrap_or(f64::NAN)).collect();
            Reflected::Spectra(Target::cosines().map(spectrum).collect())
        }
    }
}

/// Colours at the cosines.
type Colors = Vec<[f64; 3]>;

impl Measure<'_> {
    /// For each light and each of [`BOUNCES`].
    fn all_colors(&self, reflected: &Reflected) -> Vec<Colors> {
        let cases = (0..self.lights.len()).flat_map(|light| BOUNCES.map(|bounces| (light, bounces)));
        cases.map(|(light, bounces)| self.colors(reflected, light, bounces)).collect()
    }

    fn colors(&self, reflected: &Reflected, light: usize, bounces: i32) -> Colors {
        match reflected {
            Reflected::Colors(colors) => colors.iter().map(|rgb| rgb.map(|value| value.powi(bounces))).collect(),
            Reflected::Spectra(spectra) => spectra.iter().map(|values| self.color(values, light, bounces)).collect(),
        }
    }

    fn color(&self, values: &[f64], light: usize, bounces: i32) -> [f64; 3] {
        let mut places = self.wavelengths.places[light].iter();
        self.lights[light].meter.rgb(|_| places.next().map_or(0.0, |&place| values[place].powi(bounces)))
    }

    fn row(
        &self,
        subject: &Subject,
        model: FresnelModel,
        (found, exact): (&[Colors], &[Colors]),
        ns: f64,
        fitted: BTreeMap<&'static str, [f64; 3]>,
    ) -> Row {
        let meter = &self.lights[0].meter;
        let off = Target::cosines().zip(found[0].iter().zip(&exact[0])).map(|(cos, (a, b))| (largest_gap(a, b), cos));
        let (max_abs, cos_at_max) = largest(off);
        let squares =
            found[0].iter().zip(&exact[0]).flat_map(|(a, b)| [0, 1, 2].map(|i| (a[i] - b[i]) * (a[i] - b[i])));
        let averages = [average(&found[0]), average(&exact[0])];
        let cases = self.lights.iter().flat_map(|light| BOUNCES.map(|bounces| (light, bounces)));
        let cases = cases.zip(found.iter().zip(exact));
        let colors: Vec<_> = cases.map(|((light, bounces), (a, b))| color_error(light, bounces, a, b)).collect();
        Row {
            material: subject.name.clone(),
            ior: subject.data.clone(),
            model,
            max_abs,
            cos_at_max,
            rms: (squares.sum::<f64>() / (3 * COSINES) as f64).sqrt(),
            de_mean: colors[0].de_mean,
            de_max: colors[0].de_max,
            cos_at_de_max: colors[0].cos_at_de_max,
            f_avg_max_abs: largest_gap(&averages[0], &averages[1]),
            f_avg_de: ciede2000(meter.lab(averages[0]), meter.lab(averages[1])),
            ns,
            fitted,
            colors,
        }
    }
}

fn color_error(light: &Light, bounces: i32, found: &[[f64; 3]], exact: &[[f64; 3]]) -> ColorError {
    let de = |a: &[f64; 3], b: &[f64; 3]| ciede2000(light.meter.lab(*a), light.meter.lab(*b));
    let all: Vec<f64> = found.iter().zip(exact).map(|(a, b)| de(a, b)).collect();
    let (de_max, cos_at_de_max) = largest(all.iter().copied().zip(Target::cosines()));
    ColorError {
        light: light.name.clone(),
        bounces,
        de_mean: all.iter().sum::<f64>() / COSINES as f64,
        de_max,
        cos_at_de_max,
        de_normal: all.last().copied().unwrap_or(0.0),
    }
}

/// The largest value and where it is, the first of equals.
fn largest(values: impl Iterator<Item = (f64, f64)>) -> (f64, f64) {
    values.reduce(|a, b| if b.0 > a.0 { b } else { a }).unwrap_or((0.0, 0.0))
}

fn largest_gap(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    [0, 1, 2].map(|i| (a[i] - b[i]).abs()).into_iter().fold(0.0, f64::max)
}

/// F_avg of colours at the cosines.
fn average(colors: &[[f64; 3]]) -> [f64; 3] {
    let step = 1.0 / (COSINES - 1) as f64;
    let mut sum = [0.0; 3];
    for (i, (cos, color)) in Target::cosines().zip(colors).enumerate() {
        let weight = match i {
            0 => 1.0,
            _ if i == COSINES - 1 => 1.0,
            _ if i % 2 == 1 => 4.0,
            _ => 2.0,
        };
        (0..3).for_each(|channel| sum[channel] += weight * step / 3.0 * 2.0 * cos * color[channel]);
    }
    sum
}

fn fitted(tabulated: &Tabulated) -> BTreeMap<&'static str, [f64; 3]> {
    match tabulated.rgb_curve() {
        Some(RgbCurve::Lazanyi(curve)) => {
            [("a", curve.a), ("alpha", curve.alpha)].map(|(name, value)| (name, value.0.map(f64::from))).into()
        }
        Some(RgbCurve::Gulbrandsen(curve)) => [("g", curve.g)].into(),
        _ => BTreeMap::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::{self, exact};

    #[test]
    fn simpson_averages_as_adaptive_integration_does() {
        for (n, k) in [(0.2, 3.0), (1.5, 0.0), (2.4, 0.0), (2.9, 3.1), (1.0, 7.0)] {
            let colors: Vec<_> = Target::cosines().map(|cos| [exact::reflect(1.0, n, k, cos).r; 3]).collect();
            let expected = fresnel::average(|cos| exact::reflect(1.0, n, k, cos).r);
            let error = (average(&colors)[0] - expected).abs();
            println!("n {n}, k {k}: {error:.1e}");
            assert!(error < 2e-6, "n {n}, k {k}: {error:e}");
        }
    }
}
