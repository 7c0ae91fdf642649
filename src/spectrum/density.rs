//! How densely wavelengths are chosen from the visible range.
//!
//! For smooth lights by M. Radziszewski, K. Boryczko & W. Alda, "An improved technique for full spectral rendering", Journal of WSCG 17
//! (2009): p(λ) ∝ sech²(0.0072 (λ − 538)) on 360–830 nm. Where the lights of a scene have lines, or bands as narrow, half of the
//! wavelengths follow what the observer sees of them,
//!
//! ```text
//! p = D · visible + (1 − D) · S v / ∫ S v,   v = (x̄/∫x̄ + ȳ/∫ȳ + z̄/∫z̄)/3
//! ```
//!
//! with D = 1/2, which keeps the rest of the range: light over density is at most twice what it is without, whatever a filter lets
//! through (eight times where exact lines have boxes, which may take up to 7/8 of the visible density's share). S v is kept as a polygon with a corner at every nanometre, of which the distribution is the exact integral. Exact lines, of
//! which a spectrum has no value, get narrow boxes of their own.
//!
//! Measured on seven reflectances (flat, red, green, blue, gold, with a notch, a narrow band): the mean square error of one set of eight
//! wavelengths by the visible density over that by this one is 5–16 under FL1…FL12 (FL2 7, FL11 16), 98 and 81 under FL2 and FL11
//! with five mercury lines, 4–10 under LED-B3…5; it would be 1.2 and 2.4 under LED-B1 and B2, 0.3–1 under A, D65 and E. D = 1/4 would
//! gain up to 1.7 times as much under FL1…FL12 and lose 1.4–3 under LED-B3…5.

use super::{ColorMatching, LAMBDA_MAX_NM, LAMBDA_MIN_NM, Line, Spectrum, tristimulus};

/// Half the width that an emission line is given, nm. XYZ of FL2 with five mercury lines is then within 1e-6, of a laser on 532 nm,
/// where x̄, ȳ and z̄ bend, within 3.2e-5; wider would shift colours in proportion, because they bend at every nm and a line on a
/// bend is wrong by half its width times it.
const LINE_HALF_WIDTH_NM: f64 = 0.05;

/// Half the width of the narrowest box, nm: a line on an end of the range stands so far within it, where x̄, ȳ and z̄ are 6e-5 larger.
const LEAST_HALF_WIDTH_NM: f64 = 5e-4;

/// Strong lines get what is seen of them in multiples of this part of all wavelengths (so that each set of eight holds them as often), and
/// all lines get at most so much.
const PART_OF_LINE: f64 = 0.125;
const PART_OF_LINES: f64 = 0.5;

/// The part that follows the lights, if any does.
const PART_OF_LIGHT: f64 = 0.5;

/// A weak line gets at least this, for its box to hold some nodes.
const LEAST_OF_LINE: f64 = 1.0 / 128.0;

/// Points within a nanometre at which light is looked at.
const FINENESS: usize = 8;

const STEEPNESS: f64 = 0.0072;
const CENTRE_NM: f64 = 538.0;

/// How densely the wavelengths of the visible range are sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct Density {
    /// The probability of the visible density.
    visible: f64,
    /// What follows the continuum of a light.
    polygon: Option<Polygon>,
    boxes: Vec<LineBox>,
    /// tanh at the ends of the range, between which the visible density is normalised.
    tanh_ends: (f64, f64),
}

/// The place of a line and its probability.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LineBox {
    width: LineWidth,
    part: f64,
}

/// The wavelengths that a line is spread over, nm: centred on it, and narrower next to an end of the range, so that none of its light
/// comes from elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LineWidth {
    pub nm: f64,
    pub half_width: f64,
}

impl LineWidth {
    /// Of a line within the range.
    pub fn of(nm: f64) -> Self {
        let to_end = (nm - LAMBDA_MIN_NM).min(LAMBDA_MAX_NM - nm);
        let half_width = to_end.clamp(LEAST_HALF_WIDTH_NM, LINE_HALF_WIDTH_NM);
        Self { nm: nm.clamp(LAMBDA_MIN_NM + half_width, LAMBDA_MAX_NM - half_width), half_width }
    }
}

/// A density that is straight between whole nanometres.
#[derive(Clone, Debug, PartialEq)]
struct Polygon {
    /// From 360 nm on, nm⁻¹.
    pdf: Vec<f64>,
    cdf: Vec<f64>,
}

impl Density {
    /// For smooth lights.
    pub fn visible() -> Self {
        let tanh_ends = (tanh(LAMBDA_MIN_NM), tanh(LAMBDA_MAX_NM));
        Self { visible: 1.0, polygon: None, boxes: Vec::new(), tanh_ends }
    }

    /// For a light with lines or narrow bands: half of the wavelengths where an observer sees it.
    pub fn following(light: &Spectrum, observer: &ColorMatching) -> Self {
        let sight = Sight::new(observer);
        let lines = lines_of(light);
        let seen: Vec<f64> = lines.iter().map(|line| line.power * sight.at(line.nm)).collect();
        let (mut pdf, continuum) = sight.of(light);
        let total = continuum + seen.iter().sum::<f64>();
        if total <= 0.0 {
            return Self::visible();
        }
        let part = PART_OF_LIGHT * continuum / total;
        pdf.iter_mut().for_each(|value| *value *= part / continuum.max(f64::MIN_POSITIVE));
        let parts = parts_of_lines(&seen.iter().map(|seen| PART_OF_LIGHT * seen / total).collect::<Vec<_>>());
        let boxes: Vec<_> =
            lines.iter().zip(parts).map(|(line, part)| LineBox { width: LineWidth::of(line.nm), part }).collect();
        let visible = 1.0 - part - boxes.iter().map(|line| line.part).sum::<f64>();
        let polygon = (part > 0.0).then(|| Polygon::new(pdf));
        Self { visible, polygon, boxes, ..Self::visible() }
    }

    /// How many lines have a box of their own.
    pub fn lines(&self) -> usize {
        self.boxes.len()
    }

    /// Probability density at a wavelength, nm⁻¹.
    pub fn pdf(&self, nm: f64) -> f64 {
        if !(LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(&nm) {
            return 0.0;
        }
        let sech = 1.0 / libm::cosh(STEEPNESS * (nm - CENTRE_NM));
        let (low, high) = self.tanh_ends;
        let visible = STEEPNESS * sech * sech / (high - low);
        let light = self.polygon.as_ref().map_or(0.0, |polygon| polygon.pdf(nm));
        let here = self.boxes.iter().filter(|line| (nm - line.width.nm).abs() <= line.width.half_width);
        self.visible * visible + light + here.map(|line| line.part / (2.0 * line.width.half_width)).sum::<f64>()
    }

    /// Probability of a shorter wavelength.
    pub fn cdf(&self, nm: f64) -> f64 {
        let nm = nm.clamp(LAMBDA_MIN_NM, LAMBDA_MAX_NM);
        let (low, high) = self.tanh_ends;
        let visible = (tanh(nm) - low) / (high - low);
        let light = self.polygon.as_ref().map_or(0.0, |polygon| polygon.cdf(nm));
        let share = |width: &LineWidth| ((nm - width.nm) / (2.0 * width.half_width) + 0.5).clamp(0.0, 1.0);
        let below = |line: &LineBox| share(&line.width) * line.part;
        self.visible * visible + light + self.boxes.iter().map(below).sum::<f64>()
    }

    /// The wavelength with a probability below it: the inverse of `cdf`, between two wavelengths that enclose it.
    pub(super) fn quantile(&self, u: f64, mut low: f64, mut high: f64) -> f64 {
        if self.boxes.is_empty() && self.polygon.is_none() {
            let (first, last) = self.tanh_ends;
            let nm = CENTRE_NM + libm::atanh(first + u * (last - first)) / STEEPNESS;
            return nm.clamp(low, high);
        }
        let mut nm = 0.5 * (low + high);
        for _ in 0..80 {
            let excess = self.cdf(nm) - u;
            if excess > 0.0 {
                high = nm
            } else {
                low = nm
            }
            // Newton where it stays inside, halves where it does not (the density jumps at the boxes).
            let newton = nm - excess / self.pdf(nm);
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - nm).abs() < 1e-11 {
                break;
            }
            nm = next;
        }
        nm
    }
}

/// Lines within the range; those in one place as one, sorted.
fn lines_of(light: &Spectrum) -> Vec<Line> {
    let inside = LAMBDA_MIN_NM..=LAMBDA_MAX_NM;
    let mut lines: Vec<Line> = light.lines().into_iter().filter(|line| inside.contains(&line.nm)).collect();
    lines.sort_by(|a, b| a.nm.total_cmp(&b.nm));
    lines.dedup_by(|line, kept| {
        let same = line.nm == kept.nm;
        kept.power += if same { line.power } else { 0.0 };
        same
    });
    lines
}

/// What lines get if they should get so much: strong ones whole eighths, so that every set of eight holds them equally often.
fn parts_of_lines(wanted: &[f64]) -> Vec<f64> {
    let least = LEAST_OF_LINE.min(PART_OF_LINE / wanted.len() as f64);
    let rounded = |&part: &f64| match part {
        part if part >= 0.5 * PART_OF_LINE => libm::round(part / PART_OF_LINE) * PART_OF_LINE,
        part => part.max(least),
    };
    let parts: Vec<f64> = wanted.iter().map(rounded).collect();
    if parts.iter().sum::<f64>() <= PART_OF_LINES {
        return parts;
    }
    let parts: Vec<f64> = wanted.iter().map(|part| part.max(least)).collect();
    let scale = (PART_OF_LINES / parts.iter().sum::<f64>()).min(1.0);
    parts.into_iter().map(|part| part * scale).collect()
}

/// How much an observer sees of each wavelength: the mean of x̄, ȳ and z̄, each over its integral.
struct Sight<'a> {
    observer: &'a ColorMatching,
    integrals: [f64; 3],
}

impl<'a> Sight<'a> {
    fn new(observer: &'a ColorMatching) -> Self {
        Self { observer, integrals: tristimulus(&[&Spectrum::Constant(1.0)], observer) }
    }

    fn at(&self, nm: f64) -> f64 {
        let value = self.observer.at(nm);
        (0..3).map(|c| value[c] / self.integrals[c]).sum::<f64>() / 3.0
    }

    /// What is seen of the continuum of a light around each whole nanometre, in the mean over the triangle of its neighbours, and all of it.
    fn of(&self, light: &Spectrum) -> (Vec<f64>, f64) {
        let whole = (LAMBDA_MAX_NM - LAMBDA_MIN_NM) as usize;
        let mut seen = vec![0.0; whole + 1];
        for i in 0..whole * FINENESS {
            let place = (i as f64 + 0.5) / FINENESS as f64;
            let nm = LAMBDA_MIN_NM + place;
            let value = light.at(nm) * self.at(nm) / FINENESS as f64;
            let (below, t) = (i / FINENESS, place - (i / FINENESS) as f64);
            seen[below] += value * (1.0 - t);
            seen[below + 1] += value * t;
        }
        // Half a triangle stands at either end.
        seen[0] *= 2.0;
        seen[whole] *= 2.0;
        let total = seen.iter().sum::<f64>() - 0.5 * (seen[0] + seen[whole]);
        (seen, total)
    }
}

impl Polygon {
    fn new(pdf: Vec<f64>) -> Self {
        let mut sum = 0.0;
        let steps = pdf.array_windows().map(|[a, b]| 0.5 * (a + b));
        let cdf = std::iter::once(0.0).chain(steps).map(|step| {
            sum += step;
            sum
        });
        Self { cdf: cdf.collect(), pdf }
    }

    /// The corner below a wavelength within the range, and how far it lies beyond it, nm.
    fn place(&self, nm: f64) -> (usize, f64) {
        let place = nm - LAMBDA_MIN_NM;
        let below = (place as usize).min(self.pdf.len() - 2);
        (below, place - below as f64)
    }

    fn pdf(&self, nm: f64) -> f64 {
        let (below, t) = self.place(nm);
        self.pdf[below] + (self.pdf[below + 1] - self.pdf[below]) * t
    }

    fn cdf(&self, nm: f64) -> f64 {
        let (below, t) = self.place(nm);
        self.cdf[below] + t * (self.pdf[below] + 0.5 * t * (self.pdf[below + 1] - self.pdf[below]))
    }
}

/// The integral of sech², but for a factor.
fn tanh(nm: f64) -> f64 {
    libm::tanh(STEEPNESS * (nm - CENTRE_NM))
}

/// For equal lines.
#[cfg(test)]
pub(super) fn of_lines(nm: &[f64]) -> Density {
    let lines = nm.iter().map(|&nm| Line { nm, power: 1.0 }).collect();
    Density::following(&Spectrum::Lines(lines), &test_observer())
}

#[cfg(test)]
fn test_observer() -> std::sync::Arc<ColorMatching> {
    super::Library::new(Vec::new()).observer(super::Observer::Cie1931).unwrap()
}

#[cfg(test)]
mod tests {
    use super::super::Library;
    use super::*;
    use std::path::Path;

    fn lamp(name: &str) -> Spectrum {
        Library::new(Vec::new()).illuminant(name, Path::new("")).unwrap().spectrum.clone()
    }

    #[test]
    fn pdf_is_the_slope_of_cdf() {
        let mercury = Spectrum::Lines([435.833, 546.074].map(|nm| Line { nm, power: 100.0 }).to_vec());
        let both = Spectrum::Sum(vec![lamp("FL2"), mercury]);
        for density in [Density::visible(), of_lines(&[546.074]), Density::following(&both, &test_observer())] {
            for nm in [360.1, 435.833, 450.2, 546.05, 546.074, 611.7, 700.3, 829.9] {
                let slope = (density.cdf(nm + 1e-4) - density.cdf(nm - 1e-4)) / 2e-4;
                assert!((slope / density.pdf(nm) - 1.0).abs() < 1e-5, "{nm}");
            }
            assert_eq!((density.cdf(0.0), density.pdf(0.0), density.pdf(900.0)), (0.0, 0.0, 0.0));
            assert!((density.cdf(900.0) - 1.0).abs() < 1e-13);
        }
    }

    /// So that light over density is bounded, whatever comes between light and eye.
    #[test]
    fn the_visible_range_keeps_its_part_beside_any_light() {
        let many = Spectrum::Lines((0..80).map(|i| Line { nm: 400.0 + 3.0 * f64::from(i), power: 1.0 }).collect());
        let weak = Spectrum::Lines((0..80).map(|i| Line { nm: 400.0 + 3.0 * f64::from(i), power: 1e-3 }).collect());
        let few = Spectrum::Lines([450.0, 546.0, 611.0].map(|nm| Line { nm, power: 500.0 }).to_vec());
        let lights = [
            lamp("FL11"),
            many,
            few.clone(),
            Spectrum::Sum(vec![lamp("FL2"), weak]),
            Spectrum::Sum(vec![lamp("A"), few]),
        ];
        for light in lights {
            let density = Density::following(&light, &test_observer());
            let least = if light.lines().is_empty() { 0.5 } else { 0.125 };
            assert!(density.visible >= least - 1e-12, "{}", density.visible);
            for nm in 360..=830 {
                let (all, visible) = (density.pdf(f64::from(nm)), Density::visible().pdf(f64::from(nm)));
                assert!(all >= 0.125 * visible, "{nm}");
            }
        }
    }

    #[test]
    fn what_is_not_seen_is_not_followed() {
        let dark = Spectrum::Lines(vec![Line { nm: 900.0, power: 1.0 }]);
        for light in [Spectrum::Constant(0.0), dark, Spectrum::Sum(Vec::new())] {
            assert_eq!(Density::following(&light, &test_observer()), Density::visible());
        }
    }

    /// A line as strong as all the rest gets a quarter of all wavelengths, and each set of eight holds it twice.
    #[test]
    fn strong_lines_get_whole_eighths() {
        assert_eq!(parts_of_lines(&[0.24]), [0.25]);
        assert_eq!(parts_of_lines(&[0.11, 0.11, 0.14, 0.1]), [0.125; 4]);
        // There is no room for both.
        assert_eq!(parts_of_lines(&[0.45, 0.001]), [0.45, 0.0078125]);
    }
}
