//! A function given by points, linear between them.
//!
//! Linear interpolation in wavelength, n and k separately: it is what integrates exactly (see `integrate`), never
//! overshoots, and is what comparisons with published tables use.

use super::error::Fault;
use super::noise::{Point, cleaned};

/// What a table is worth outside its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// The value of the nearer end: materials, whose properties do not stop where a measurement stops.
    Hold,
    /// Nothing: lights, and eyes.
    Zero,
}

/// A number read from a file, with its place there (bytes from the start), so that an error can name it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Number {
    pub value: f64,
    pub offset: usize,
}

/// What values a quantity may have.
#[derive(Clone, Copy, Debug)]
pub(super) enum Bound {
    Positive,
    NonNegative,
    /// Of a light, as instruments tell it.
    Power,
    Fraction,
    /// What passes through something, whose logarithm is taken.
    Transmittance,
    Any,
}

/// How far below 0 a k is noise, and a spectral power in shares of its peak.
const K_NOISE: f64 = 1e-6;
const POWER_NOISE: f64 = 1e-3;

/// Where reflectances and transmittances are still noise.
const FRACTION_NOISE: (f64, f64) = (-0.001, 1.01);

impl Bound {
    /// The value itself if it is possible, the nearest possible one if it is off by noise; `peak` is the largest of all.
    pub fn nearest(self, value: f64, peak: f64) -> Option<f64> {
        let (low, high) = FRACTION_NOISE;
        let above = |floor: f64| (value >= -floor).then_some(value.max(0.0));
        let nearest = match self {
            Self::Positive => (value > 0.0).then_some(value),
            Self::NonNegative => above(K_NOISE),
            Self::Power => above(POWER_NOISE * peak),
            Self::Fraction => (low..=high).contains(&value).then_some(value.clamp(0.0, 1.0)),
            Self::Transmittance => (value > 0.0 && value <= high).then_some(value.min(1.0)),
            Self::Any => Some(value),
        };
        nearest.filter(|value| value.is_finite())
    }

    pub fn expected(self) -> &'static str {
        match self {
            Self::Positive => "a number above 0",
            Self::NonNegative | Self::Power => "a number of 0 or more",
            Self::Fraction => "a number from 0 to 1",
            Self::Transmittance => "a number above 0, up to 1",
            Self::Any => "a finite number",
        }
    }
}

/// A piecewise linear function of wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    nm: Vec<f64>,
    value: Vec<f64>,
    outside: Outside,
}

impl Table {
    /// From wavelengths (nm, positive, up or down) and as many values within a bound, but for noise, of which `notes` tells
    /// what became. `what` names the values.
    pub(super) fn from_numbers(
        nm: &[Number],
        values: &[Number],
        what: &str,
        bound: Bound,
        outside: Outside,
        notes: &mut Vec<String>,
    ) -> Result<Self, Fault> {
        let Some(first) = nm.first() else {
            return Err(Fault::new("the table is empty, expected at least one wavelength"));
        };
        if nm.len() != values.len() {
            let message =
                format!("{} wavelengths but {} values of {what}, expected as many of each", nm.len(), values.len());
            return Err(Fault::at(first.offset, message));
        }
        if let Some(bad) = nm.iter().find(|number| Bound::Positive.nearest(number.value, 0.0).is_none()) {
            let message = format!("the wavelength {} nm, expected {}", bad.value, Bound::Positive.expected());
            return Err(Fault::at(bad.offset, message));
        }
        let points = nm.iter().zip(values).map(|(&nm, &value)| Point { nm, value }).collect();
        let (nm, value) =
            cleaned(points, what, bound, notes)?.iter().map(|point| (point.nm.value, point.value.value)).unzip();
        Ok(Self { nm, value, outside })
    }

    /// From points (nm, value) in any order; later ones of equal wavelength and ones that are not finite are dropped.
    pub fn from_points(points: &[(f64, f64)], outside: Outside) -> Self {
        let mut points: Vec<_> =
            points.iter().copied().filter(|(nm, value)| nm.is_finite() && value.is_finite()).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.dedup_by(|later, first| later.0 == first.0);
        let (nm, value) = points.into_iter().unzip();
        Self { nm, value, outside }
    }

    pub fn at(&self, nm: f64) -> f64 {
        let next = self.nm.partition_point(|&point| point <= nm);
        let (Some(&first), Some(&last)) = (self.value.first(), self.value.last()) else { return 0.0 };
        if next == self.nm.len() {
            let on_the_end = self.nm.last() == Some(&nm);
            return if self.outside == Outside::Hold || on_the_end { last } else { 0.0 };
        }
        if next == 0 {
            return if self.outside == Outside::Hold { first } else { 0.0 };
        }
        let (left, right) = (self.nm[next - 1], self.nm[next]);
        let t = (nm - left) / (right - left);
        self.value[next - 1] * (1.0 - t) + self.value[next] * t
    }

    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.nm
    }

    pub fn values(&self) -> &[f64] {
        &self.value
    }

    pub fn outside(&self) -> Outside {
        self.outside
    }

    /// First and last wavelength, nm; `None` for a table without points.
    pub fn range_nm(&self) -> Option<(f64, f64)> {
        Some((*self.nm.first()?, *self.nm.last()?))
    }

    /// The same table with every value changed.
    pub fn map(&self, f: impl Fn(f64) -> f64) -> Self {
        Self { nm: self.nm.clone(), value: self.value.iter().map(|&value| f(value)).collect(), outside: self.outside }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(nm: &[f64], value: &[f64], outside: Outside) -> Result<Table, Fault> {
        let numbers = |values: &[f64]| -> Vec<_> {
            values.iter().enumerate().map(|(offset, &value)| Number { value, offset }).collect()
        };
        Table::from_numbers(&numbers(nm), &numbers(value), "k", Bound::NonNegative, outside, &mut Vec::new())
    }

    fn table(outside: Outside) -> Table {
        read(&[400.0, 500.0, 700.0], &[1.0, 3.0, 2.0], outside).unwrap()
    }

    #[test]
    fn interpolates_and_holds_or_ends() {
        let held = table(Outside::Hold);
        assert_eq!(held.at(450.0), 2.0);
        assert_eq!(held.at(600.0), 2.5);
        assert_eq!((held.at(400.0), held.at(500.0), held.at(700.0)), (1.0, 3.0, 2.0));
        assert_eq!((held.at(300.0), held.at(900.0)), (1.0, 2.0));
        let light = table(Outside::Zero);
        assert_eq!((light.at(399.999), light.at(700.001)), (0.0, 0.0));
        assert_eq!((light.at(400.0), light.at(700.0)), (1.0, 2.0));
        assert_eq!(light.at(f64::NAN), 0.0);
    }

    #[test]
    fn refuses_what_is_no_table() {
        let refuse = |nm: &[f64], value: &[f64]| read(nm, value, Outside::Hold).unwrap_err().message;
        assert!(refuse(&[], &[]).contains("empty"));
        assert!(refuse(&[1.0], &[]).contains("as many"));
        assert!(refuse(&[400.0, 600.0, 500.0, 700.0], &[0.0; 4]).contains("increasing"));
        assert!(refuse(&[500.0, 500.0], &[0.0, 1.0]).contains("increasing"));
        assert!(refuse(&[-1.0], &[0.0]).contains("above 0"));
        assert!(refuse(&[1.0], &[f64::NAN]).contains("0 or more"));
        assert!(refuse(&[1.0], &[-0.5]).contains("k is -0.5 at 1 nm"));
        assert_eq!(Table::from_points(&[], Outside::Hold).at(500.0), 0.0);
    }
}
