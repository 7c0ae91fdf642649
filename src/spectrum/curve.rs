//! What a function of wavelength can be.

use std::sync::Arc;

use super::{Bands, Daylight, Formula, Line, Outside, Sigmoid, Table, planck, visible_nm};

/// A function of vacuum wavelength. Its unit is what its use says: an index, a reflectance, m⁻¹, W m⁻² sr⁻¹ nm⁻¹, or
/// relative power.
#[derive(Clone, Debug, PartialEq)]
pub enum Spectrum {
    Constant(f64),
    Table(Table),
    Formula(Formula),
    /// Planck's spectral radiance, W m⁻² sr⁻¹ nm⁻¹.
    Blackbody {
        kelvin: f64,
    },
    Daylight(Daylight),
    Bands(Bands),
    /// Emission lines: 0 at every wavelength, yet of finite integral; `lines` tells them, integrals and nodes count them.
    Lines(Vec<Line>),
    /// A smooth reflectance fitted to a colour.
    Sigmoid(Sigmoid),
    /// Another spectrum times a factor.
    Scaled {
        factor: f64,
        of: Arc<Spectrum>,
    },
    /// A continuum and lines, or a mixture of lights.
    Sum(Vec<Spectrum>),
}

impl Spectrum {
    /// The value at a vacuum wavelength; lines are not part of it.
    pub fn at(&self, nm: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Table(table) => table.at(nm),
            Self::Formula(formula) => formula.at(nm),
            Self::Blackbody { kelvin } => planck(*kelvin, nm),
            Self::Daylight(daylight) => daylight.at(nm),
            Self::Bands(bands) => bands.at(nm),
            Self::Lines(_) => 0.0,
            Self::Sigmoid(sigmoid) => sigmoid.at(nm),
            Self::Scaled { factor, of } => factor * of.at(nm),
            Self::Sum(parts) => parts.iter().map(|part| part.at(nm)).sum(),
        }
    }

    /// This spectrum times a factor, sharing the data.
    pub fn scaled(self, factor: f64) -> Self {
        match self {
            Self::Constant(value) => Self::Constant(value * factor),
            Self::Scaled { factor: inner, of } => Self::Scaled { factor: inner * factor, of },
            other => Self::Scaled { factor, of: Arc::new(other) },
        }
    }

    /// The spectrum but for a factor: of two lamps of one kind the same.
    pub fn unscaled(&self) -> &Self {
        match self {
            Self::Scaled { of, .. } => of,
            other => other,
        }
    }

    /// The factor that [`Self::unscaled`] leaves out.
    pub fn factor(&self) -> f64 {
        match self {
            Self::Scaled { factor, .. } => *factor,
            _ => 1.0,
        }
    }

    /// The absorption coefficient of an extinction coefficient: α = 4πk/λ, m⁻¹ and natural base; at every nanometre of the
    /// visible and at every breakpoint, linear between.
    pub fn absorption_from_k(&self) -> Self {
        self.tabulated(|nm, k| 4.0 * std::f64::consts::PI * k / (nm * 1e-9))
    }

    /// The extinction coefficient of an absorption coefficient in m⁻¹: k = αλ/4π.
    pub fn k_from_absorption(&self) -> Self {
        self.tabulated(|nm, alpha| alpha * (nm * 1e-9) / (4.0 * std::f64::consts::PI))
    }

    fn tabulated(&self, of: impl Fn(f64, f64) -> f64) -> Self {
        let points: Vec<_> = visible_nm().chain(self.breakpoints_nm()).map(|nm| (nm, of(nm, self.at(nm)))).collect();
        Self::Table(Table::from_points(&points, Outside::Hold))
    }

    /// The wavelengths that the data cover, nm; `None`: everywhere. For a sum, what all its parts cover.
    pub fn range_nm(&self) -> Option<(f64, f64)> {
        match self {
            Self::Table(table) => table.range_nm(),
            Self::Formula(formula) => Some(formula.range_nm()),
            Self::Daylight(_) => Some(Daylight::range_nm()),
            Self::Scaled { of, .. } => of.range_nm(),
            Self::Sum(parts) => parts.iter().filter_map(Self::range_nm).reduce(common_range),
            Self::Constant(_) | Self::Blackbody { .. } | Self::Bands(_) | Self::Lines(_) | Self::Sigmoid(_) => None,
        }
    }

    /// Whether the data cover a range, nm.
    pub fn covers_nm(&self, low: f64, high: f64) -> bool {
        self.range_nm().is_none_or(|(first, last)| first <= low && high <= last)
    }

    /// Wavelengths where it bends or jumps, in no order, nm: between them it is smooth.
    pub fn breakpoints_nm(&self) -> Vec<f64> {
        match self {
            Self::Table(table) => table.wavelengths_nm().to_vec(),
            Self::Formula(formula) => vec![formula.range_nm().0, formula.range_nm().1],
            Self::Daylight(_) => Daylight::breakpoints_nm().collect(),
            Self::Bands(bands) => bands.breakpoints_nm().collect(),
            Self::Scaled { of, .. } => of.breakpoints_nm(),
            Self::Sum(parts) => parts.iter().flat_map(Self::breakpoints_nm).collect(),
            Self::Constant(_) | Self::Blackbody { .. } | Self::Lines(_) | Self::Sigmoid(_) => Vec::new(),
        }
    }

    /// Whether it is a straight line between its breakpoints.
    pub fn is_piecewise_linear(&self) -> bool {
        match self {
            Self::Constant(_) | Self::Table(_) | Self::Daylight(_) | Self::Lines(_) => true,
            Self::Formula(_) | Self::Blackbody { .. } | Self::Bands(_) | Self::Sigmoid(_) => false,
            Self::Scaled { of, .. } => of.is_piecewise_linear(),
            Self::Sum(parts) => parts.iter().all(Self::is_piecewise_linear),
        }
    }

    /// Its emission lines.
    pub fn lines(&self) -> Vec<Line> {
        match self {
            Self::Lines(lines) => lines.clone(),
            Self::Scaled { factor, of } => {
                of.lines().into_iter().map(|line| Line { power: line.power * factor, ..line }).collect()
            }
            Self::Sum(parts) => parts.iter().flat_map(Self::lines).collect(),
            _ => Vec::new(),
        }
    }
}

/// What two ranges have in common; where that is nothing, an empty range.
pub(super) fn common_range(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (a.0.max(b.0), a.1.min(b.1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_and_factors_reach_the_lines() {
        let continuum = Spectrum::Table(Table::from_points(&[(400.0, 1.0), (700.0, 1.0)], Outside::Zero));
        let lines = Spectrum::Lines(vec![Line { nm: 589.3, power: 4.0 }]);
        let lamp = Spectrum::Sum(vec![continuum, lines.scaled(0.5)]).scaled(3.0);
        assert_eq!(lamp.at(589.3), 3.0);
        assert_eq!(lamp.lines(), [Line { nm: 589.3, power: 6.0 }]);
        assert_eq!(lamp.range_nm(), Some((400.0, 700.0)));
        assert!(lamp.is_piecewise_linear() && lamp.covers_nm(450.0, 650.0) && !lamp.covers_nm(360.0, 650.0));
    }
}
