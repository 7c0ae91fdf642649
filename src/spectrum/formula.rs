//! Dispersion formulas: n as a function of wavelength with published coefficients.
//!
//! The nine formulas of the refractiveindex.info database (M. N. Polyanskiy, "Refractiveindex.info database of optical
//! constants", Scientific Data 11, 94 (2024), and its file "dispersion formulas"), with wavelength in µm and
//! coefficients numbered from 1. A formula stays a formula: it is evaluated at the wavelength asked, never resampled.
//! Beyond its range it is extrapolated, which `About::covers_nm` tells; where that is no longer a number (a pole, a
//! root of a negative number), the value at the nearer end of the range is held.

use serde::Deserialize;

use super::error::Fault;
use super::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, SpectrumError};

/// Which of the nine formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum FormulaType {
    /// 1: n² − 1 = c1 + Σ c2 λ² / (λ² − c3²)
    #[serde(rename = "sellmeier")]
    Sellmeier,
    /// 2: n² − 1 = c1 + Σ c2 λ² / (λ² − c3)
    #[serde(rename = "sellmeier-2")]
    Sellmeier2,
    /// 3: n² = c1 + Σ c2 λ^c3
    #[serde(rename = "polynomial")]
    Polynomial,
    /// 4: n² = c1 + c2 λ^c3 / (λ² − c4^c5) + c6 λ^c7 / (λ² − c8^c9) + Σ c10 λ^c11
    #[serde(rename = "rii")]
    RefractiveIndexInfo,
    /// 5: n = c1 + Σ c2 λ^c3
    #[serde(rename = "cauchy")]
    Cauchy,
    /// 6: n − 1 = c1 + Σ c2 / (c3 − λ⁻²)
    #[serde(rename = "gases")]
    Gases,
    /// 7: n = c1 + c2 / (λ² − 0.028) + c3 / (λ² − 0.028)² + c4 λ² + c5 λ⁴ + c6 λ⁶
    #[serde(rename = "herzberger")]
    Herzberger,
    /// 8: (n² − 1) / (n² + 2) = c1 + c2 λ² / (λ² − c3) + c4 λ²
    #[serde(rename = "retro")]
    Retro,
    /// 9: n² = c1 + c2 / (λ² − c3) + c4 (λ − c5) / ((λ − c5)² + c6)
    #[serde(rename = "exotic")]
    Exotic,
}

impl FormulaType {
    const ALL: [Self; 9] = [
        Self::Sellmeier,
        Self::Sellmeier2,
        Self::Polynomial,
        Self::RefractiveIndexInfo,
        Self::Cauchy,
        Self::Gases,
        Self::Herzberger,
        Self::Retro,
        Self::Exotic,
    ];

    /// By its number in the database, 1…9.
    pub fn from_number(number: usize) -> Option<Self> {
        number.checked_sub(1).and_then(|index| Self::ALL.get(index)).copied()
    }

    /// How many coefficients it takes: those of whole terms, so that one that was lost is not taken for 0.
    fn takes(self, count: usize) -> bool {
        match self {
            Self::RefractiveIndexInfo => matches!(count, 1 | 5 | 9 | 11 | 13 | 15 | 17),
            Self::Herzberger => (3..=6).contains(&count),
            Self::Exotic => matches!(count, 3 | 6),
            Self::Retro => count == 4,
            // A constant and pairs.
            _ => count % 2 == 1 && count < 99,
        }
    }

    fn expected(self) -> &'static str {
        match self {
            Self::RefractiveIndexInfo => "1, 5, 9, 11, 13, 15 or 17",
            Self::Herzberger => "3 to 6",
            Self::Exotic => "3 or 6",
            Self::Retro => "4",
            _ => "an odd number: a constant and pairs",
        }
    }
}

/// A dispersion formula with its coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    kind: FormulaType,
    coefficients: Vec<f64>,
    range_nm: (f64, f64),
}

impl Formula {
    pub(super) fn new(kind: FormulaType, coefficients: Vec<f64>, range_nm: (f64, f64)) -> Result<Self, Fault> {
        if !kind.takes(coefficients.len()) {
            let message = format!("{} coefficients of this formula, expected {}", coefficients.len(), kind.expected());
            return Err(Fault::new(message));
        }
        if let Some(bad) = coefficients.iter().find(|c| !c.is_finite()) {
            return Err(Fault::new(format!("coefficient {bad}, expected a number")));
        }
        let (low, high) = range_nm;
        if !(low > 0.0 && low < high && high.is_finite()) {
            let message = format!("range {low} to {high} nm, expected two positive, increasing wavelengths");
            return Err(Fault::new(message));
        }
        let formula = Self { kind, coefficients, range_nm };
        for i in 0..=16 {
            let nm = low + (high - low) * f64::from(i) / 16.0;
            let n = formula.evaluate(nm);
            if !(n > 0.0 && n.is_finite()) {
                return Err(Fault::new(format!("the formula gives n = {n} at {nm} nm, expected n > 0")));
            }
        }
        Ok(formula)
    }

    /// A formula that is to hold in the visible.
    pub fn visible(kind: FormulaType, coefficients: Vec<f64>) -> Result<Self, SpectrumError> {
        let formula = Self::new(kind, coefficients, (LAMBDA_MIN_NM, LAMBDA_MAX_NM));
        formula.map_err(|fault| SpectrumError::Formula(fault.message))
    }

    /// n at a vacuum wavelength.
    pub fn at(&self, nm: f64) -> f64 {
        let n = self.evaluate(nm);
        if n > 0.0 && n.is_finite() {
            return n;
        }
        let (low, high) = self.range_nm;
        // A NaN wavelength lands on an end as well.
        self.evaluate(if nm > high { high } else { low })
    }

    /// The range that the authors state, nm.
    pub fn range_nm(&self) -> (f64, f64) {
        self.range_nm
    }

    pub fn kind(&self) -> FormulaType {
        self.kind
    }

    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    fn evaluate(&self, nm: f64) -> f64 {
        let um = nm / 1000.0;
        let um2 = um * um;
        // c(1) is the first, as in the formulas; those that a file leaves out are 0.
        let c = |number: usize| self.coefficients.get(number - 1).copied().unwrap_or(0.0);
        // Σ over pairs (a, b) of coefficients from a number on; a = 0 means that there is no such term.
        let pairs = |from: usize, term: &dyn Fn(f64, f64) -> f64| {
            let rest = self.coefficients.get(from - 1..).unwrap_or(&[]);
            rest.chunks(2)
                .filter(|pair| pair[0] != 0.0)
                .map(|pair| term(pair[0], pair.get(1).copied().unwrap_or(0.0)))
                .sum::<f64>()
        };
        let power = |a: f64, b: f64| a * libm::pow(um, b);
        match self.kind {
            FormulaType::Sellmeier => libm::sqrt(1.0 + c(1) + pairs(2, &|a, b| a * um2 / (um2 - b * b))),
            FormulaType::Sellmeier2 => libm::sqrt(1.0 + c(1) + pairs(2, &|a, b| a * um2 / (um2 - b))),
            FormulaType::Polynomial => libm::sqrt(c(1) + pairs(2, &power)),
            FormulaType::RefractiveIndexInfo => {
                let resonance = |first: usize| {
                    let pole = libm::pow(c(first + 2), c(first + 3));
                    if c(first) == 0.0 { 0.0 } else { power(c(first), c(first + 1)) / (um2 - pole) }
                };
                libm::sqrt(c(1) + resonance(2) + resonance(6) + pairs(10, &power))
            }
            FormulaType::Cauchy => c(1) + pairs(2, &power),
            FormulaType::Gases => 1.0 + c(1) + pairs(2, &|a, b| a / (b - 1.0 / um2)),
            FormulaType::Herzberger => {
                let l = 1.0 / (um2 - 0.028);
                c(1) + c(2) * l + c(3) * l * l + um2 * (c(4) + um2 * (c(5) + um2 * c(6)))
            }
            FormulaType::Retro => {
                let ratio = c(1) + c(2) * um2 / (um2 - c(3)) + c(4) * um2;
                libm::sqrt((1.0 + 2.0 * ratio) / (1.0 - ratio))
            }
            FormulaType::Exotic => {
                let shift = um - c(5);
                let line = if c(4) == 0.0 { 0.0 } else { c(4) * shift / (shift * shift + c(6)) };
                let pole = if c(2) == 0.0 { 0.0 } else { c(2) / (um2 - c(3)) };
                libm::sqrt(c(1) + pole + line)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn schott_bk7_at_the_d_line() {
        let coefficients = vec![0.0, 1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653];
        let bk7 = Formula::new(FormulaType::Sellmeier2, coefficients, (300.0, 2500.0)).unwrap();
        assert!((bk7.at(587.5618) - 1.5168).abs() < 1e-5);
    }

    /// One coefficient lost gives another glass: n was 1.821 for 1.517.
    #[test]
    fn a_lost_coefficient_is_told() {
        let all = [0.0, 1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653];
        let message = |kind: FormulaType, count: usize| {
            let coefficients = all.iter().chain(&all).chain(&all).copied().take(count).collect();
            Formula::new(kind, coefficients, (300.0, 2500.0)).err().map(|fault| fault.message).unwrap_or_default()
        };
        let told = "6 coefficients of this formula, expected an odd number: a constant and pairs";
        assert_eq!(message(FormulaType::Sellmeier2, 6), told);
        for (kind, wrong) in [
            (FormulaType::Sellmeier, 4),
            (FormulaType::Polynomial, 10),
            (FormulaType::RefractiveIndexInfo, 10),
            (FormulaType::Cauchy, 2),
            (FormulaType::Gases, 2),
            (FormulaType::Herzberger, 7),
            (FormulaType::Retro, 3),
            (FormulaType::Exotic, 5),
            (FormulaType::Sellmeier, 0),
        ] {
            assert!(message(kind, wrong).contains("coefficients of this formula"), "{kind:?}");
        }
    }

    #[test]
    fn beyond_a_pole_the_end_of_the_range_is_held() {
        let strange = Formula::new(FormulaType::Sellmeier, vec![0.0, 1.0, 0.4], (500.0, 800.0)).unwrap();
        assert_eq!(strange.at(399.0), strange.at(500.0));
        assert!(strange.at(f64::NAN) > 0.0);
        assert!(Formula::new(FormulaType::Sellmeier, vec![0.0, 1.0, 0.4], (300.0, 800.0)).is_err());
        assert!(Formula::new(FormulaType::Retro, vec![0.0; 5], (300.0, 800.0)).is_err());
        assert!(Formula::new(FormulaType::Cauchy, vec![1.5], (800.0, 300.0)).is_err());
    }
}
