//! An axis: its range, the ticks a person would set, and how they read.
//!
//! Linear ticks stand at 1, 2, 2.5 or 5 times a power of ten (P. Heckbert, "Nice numbers for graph labels", *Graphics Gems*, 1990);
//! logarithmic ones at the decades, and at 2 and 5 between them where there are few.

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    Linear,
    Logarithmic,
}

/// A range of values with its ticks.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it measures, with the unit.
    pub label: String,
    pub scale: Scale,
    /// First and last value; above 0 if logarithmic.
    pub range: [f64; 2],
    pub ticks: Vec<f64>,
}

/// Ticks that an axis should not have more of.
const MOST_TICKS: usize = 7;

impl Axis {
    /// Exactly this range, which is widened where it has no width.
    pub fn linear(label: impl Into<String>, range: [f64; 2]) -> Self {
        let range = wide(range);
        let ticks = multiples(range, step(range));
        Self { label: label.into(), scale: Scale::Linear, range, ticks }
    }

    /// A range that begins and ends on ticks around these values.
    pub fn around(label: impl Into<String>, values: impl Iterator<Item = f64>) -> Self {
        let range = wide(extent(values));
        let step = step(range);
        // A rounding above a tick is no reason for another one.
        let range = [(range[0] / step + 1e-6).floor() * step, (range[1] / step - 1e-6).ceil() * step];
        Self { ticks: multiples(range, step), ..Self::linear(label, range) }
    }

    /// Whole decades around the values above 0.
    pub fn logarithmic(label: impl Into<String>, values: impl Iterator<Item = f64>) -> Self {
        let [low, high] =
            extent(values.filter(|value| *value > 0.0)).map(|value| if value > 0.0 { value } else { 1.0 });
        let first = libm::floor(libm::log10(low)) as i32;
        let last = (libm::ceil(libm::log10(high)) as i32).max(first + 1);
        let between: &[f64] = if last - first <= 2 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let power = |exponent: i32| libm::pow(10.0, f64::from(exponent));
        let every = (last - first) as usize / (MOST_TICKS + 1) + 1;
        let decades = (first..last).step_by(every);
        let ticks = decades.flat_map(|decade| between.iter().map(move |mantissa| mantissa * power(decade)));
        let ticks = ticks.chain([power(last)]).collect();
        Self { label: label.into(), scale: Scale::Logarithmic, range: [power(first), power(last)], ticks }
    }

    /// A tick at every multiple of a step.
    pub fn every(self, step: f64) -> Self {
        Self { ticks: multiples(self.range, step), ..self }
    }

    /// 0 at the first value of the range, 1 at the last.
    pub fn place(&self, value: f64) -> f64 {
        let along = |value: f64| match self.scale {
            Scale::Linear => value,
            Scale::Logarithmic => libm::log10(value.max(f64::MIN_POSITIVE)),
        };
        let [first, last] = self.range.map(along);
        (along(value) - first) / (last - first)
    }

    /// The ticks as text, all with the same digits behind the point.
    pub fn labels(&self) -> Vec<String> {
        let label = |tick: &f64| match self.scale {
            Scale::Linear => signed(format!("{tick:.*}", self.decimals())),
            Scale::Logarithmic => logarithmic(*tick),
        };
        self.ticks.iter().map(label).collect()
    }

    fn decimals(&self) -> usize {
        let whole = |decimals: usize| {
            let unit = libm::pow(10.0, decimals as f64);
            let near = |tick: &f64| (tick * unit - (tick * unit).round()).abs() < 1e-6 * (tick * unit).abs().max(1.0);
            self.ticks.iter().all(near)
        };
        (0..12).find(|&decimals| whole(decimals)).unwrap_or(12)
    }
}

/// With a minus sign instead of a hyphen.
fn signed(text: String) -> String {
    text.replace('-', "−")
}

/// Plain within a few digits, else a power of ten.
fn logarithmic(tick: f64) -> String {
    if (0.01..1e4).contains(&tick) {
        return tick.to_string();
    }
    let exponent = libm::floor(libm::log10(tick) + 1e-9) as i32;
    let mantissa = (tick / libm::pow(10.0, f64::from(exponent))).round();
    let raised: String = exponent.to_string().chars().map(superscript).collect();
    if mantissa == 1.0 { format!("10{raised}") } else { format!("{mantissa}·10{raised}") }
}

fn superscript(digit: char) -> char {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    digit.to_digit(10).map_or('⁻', |value| RAISED[value as usize])
}

fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let around = |[low, high]: [f64; 2], value: f64| [low.min(value), high.max(value)];
    let [low, high] = values.filter(|value| value.is_finite()).fold([f64::INFINITY, f64::NEG_INFINITY], around);
    if low <= high { [low, high] } else { [0.0, 1.0] }
}

/// The range, or one of some width around its only value.
fn wide([low, high]: [f64; 2]) -> [f64; 2] {
    let least = 1e-9 * low.abs().max(high.abs()).max(1e-3);
    if high - low > least {
        [low, high]
    } else {
        [low - 0.05 * low.abs().max(1e-3), high + 0.05 * high.abs().max(1e-3)]
    }
}

/// The smallest nice step that needs no more than [`MOST_TICKS`].
fn step([low, high]: [f64; 2]) -> f64 {
    let least = (high - low) / (MOST_TICKS - 1) as f64;
    let power = libm::pow(10.0, libm::floor(libm::log10(least)));
    let nice = [1.0, 2.0, 2.5, 5.0].into_iter().find(|mantissa| mantissa * power >= least * (1.0 - 1e-9));
    nice.unwrap_or(10.0) * power
}

/// Multiples of a step within a range, its ends included to rounding.
fn multiples([low, high]: [f64; 2], step: f64) -> Vec<f64> {
    let (first, last) = ((low / step - 1e-6).ceil() as i64, (high / step + 1e-6).floor() as i64);
    (first..=last).map(|multiple| multiple as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_where_a_person_would_set_them() {
        let labels = |values: [f64; 2]| Axis::around("", values.into_iter()).labels().join(" ");
        assert_eq!(labels([0.0, 100.0]), "0 20 40 60 80 100");
        assert_eq!(labels([93.1, 99.9]), "92 94 96 98 100");
        assert_eq!(labels([1e-9, 100.0 + 1e-9]), "0 20 40 60 80 100");
        assert_eq!(labels([-0.3, 0.2]), "−0.3 −0.2 −0.1 0.0 0.1 0.2");
        assert_eq!(labels([380.0, 780.0]), "300 400 500 600 700 800");
        assert_eq!(Axis::linear("", [0.0, 90.0]).every(15.0).labels().join(" "), "0 15 30 45 60 75 90");
    }

    #[test]
    fn a_range_without_width_or_values_is_still_one() {
        let flat = Axis::around("", [5.0, 5.0].into_iter());
        assert!(flat.range[0] < 5.0 && flat.range[1] > 5.0 && flat.ticks.len() > 1);
        assert_eq!(Axis::around("", std::iter::empty()).range, [0.0, 1.0]);
        assert_eq!(Axis::around("", [f64::NAN, 0.0, 1.0].into_iter()).range, [0.0, 1.0]);
    }

    #[test]
    fn decades_are_evenly_spread() {
        let axis = Axis::logarithmic("", [0.003, 40.0].into_iter());
        assert_eq!(axis.labels().join(" "), "10⁻³ 0.01 0.1 1 10 100");
        let places: Vec<f64> = axis.ticks.iter().map(|&tick| axis.place(tick)).collect();
        assert!(places.iter().enumerate().all(|(i, place)| (place - i as f64 / 5.0).abs() < 1e-12), "{places:?}");
        assert_eq!(Axis::logarithmic("", [1.0, 1e5].into_iter()).labels().join(" "), "1 10 100 1000 10⁴ 10⁵");
        assert_eq!(Axis::logarithmic("", [0.2, 30.0].into_iter()).ticks.len(), 4);
        assert_eq!(Axis::logarithmic("", [2.0, 30.0].into_iter()).labels().join(" "), "1 2 5 10 20 50 100");
    }
}
