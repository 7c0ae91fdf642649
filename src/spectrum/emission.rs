//! Light of a temperature: Planck's law and the CIE daylight series, and light of single wavelengths.

use super::Table;
use super::error::SpectrumError;

/// Planck constant, J s; speed of light, m/s; Boltzmann constant, J/K: exact since the SI of 2019 (CODATA 2018).
const PLANCK: f64 = 6.626_070_15e-34;
const LIGHT_SPEED: f64 = 299_792_458.0;
const BOLTZMANN: f64 = 1.380_649e-23;

/// Spectral radiance of a black body, W m⁻² sr⁻¹ nm⁻¹ (M. Planck 1901): 2hc²/λ⁵ / (exp(hc/λkT) − 1).
/// 0 where wavelength or temperature are not positive.
pub fn planck(kelvin: f64, nm: f64) -> f64 {
    if !(kelvin > 0.0 && nm > 0.0) {
        return 0.0;
    }
    let m = nm * 1e-9;
    let exponent = PLANCK * LIGHT_SPEED / (m * BOLTZMANN * kelvin);
    let per_metre = 2.0 * PLANCK * LIGHT_SPEED * LIGHT_SPEED / (m * m * m * m * m) / libm::expm1(exponent);
    per_metre * 1e-9
}

/// Lowest and highest correlated colour temperature of the daylight series, K.
const DAYLIGHT_KELVIN: (f64, f64) = (4000.0, 25000.0);

/// A phase of daylight of the CIE D series, by its correlated colour temperature.
///
/// CIE 15:2004, section 3.1, equations 3.2–3.5 (after Judd, MacAdam & Wyszecki 1964): S0 + M1 S1 + M2 S2, M1 and M2
/// rounded to three decimals as printed there, linear between the 10 nm points, nothing outside 300–830 nm.
/// Relative power, 100 at 560 nm. The temperature is that of today's second radiation constant: D65 is 6504 K.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Daylight {
    kelvin: f64,
    m1: f64,
    m2: f64,
}

impl Daylight {
    /// For 4000–25000 K.
    pub fn new(kelvin: f64) -> Result<Self, SpectrumError> {
        let (low, high) = DAYLIGHT_KELVIN;
        if !(low..=high).contains(&kelvin) {
            let what = "the temperature of daylight";
            return Err(SpectrumError::OutOfRange { what, value: kelvin, expected: "4000 to 25000 K" });
        }
        let t = 1e3 / kelvin;
        let x = if kelvin <= 7000.0 {
            ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
        } else {
            ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040
        };
        let y = (-3.000 * x + 2.870) * x - 0.275;
        let m = 0.0241 + 0.2562 * x - 0.7341 * y;
        let three_decimals = |value: f64| libm::round(value * 1000.0) / 1000.0;
        let m1 = three_decimals((-1.3515 - 1.7703 * x + 5.9114 * y) / m);
        let m2 = three_decimals((0.0300 - 31.4424 * x + 30.0717 * y) / m);
        Ok(Self { kelvin, m1, m2 })
    }

    /// The daylight that the CIE calls D50, D55, D65 or D75, in either case: their nominal temperatures are those of an older
    /// second radiation constant.
    pub(super) fn of_name(name: &str) -> Option<Self> {
        let nominal = match name.to_ascii_lowercase().as_str() {
            "d50" => 5000.0,
            "d55" => 5500.0,
            "d65" => 6500.0,
            "d75" => 7500.0,
            _ => return None,
        };
        Self::new(nominal * 1.4388 / 1.438).ok()
    }

    /// A published table of this daylight that ends early, continued to the end of the series in the table's own measure.
    pub(super) fn continued(&self, table: &Table) -> Table {
        let points = table.wavelengths_nm().iter().copied().zip(table.values().iter().copied());
        let mut points: Vec<(f64, f64)> = points.collect();
        let Some(&(end, last)) = points.last() else { return table.clone() };
        let at_end = self.at(end);
        if at_end > 0.0 {
            let beyond = Self::breakpoints_nm().filter(|nm| *nm > end);
            points.extend(beyond.map(|nm| (nm, last * self.at(nm) / at_end)));
        }
        Table::from_points(&points, table.outside())
    }

    pub fn kelvin(&self) -> f64 {
        self.kelvin
    }

    /// Relative spectral power; never negative.
    pub fn at(&self, nm: f64) -> f64 {
        let position = (nm - FIRST_NM) / STEP_NM;
        let last = S0.len() - 1;
        if !(0.0..=last as f64).contains(&position) {
            return 0.0;
        }
        let i = (position as usize).min(last - 1);
        let t = position - i as f64;
        let point = |i: usize| S0[i] + self.m1 * S1[i] + self.m2 * S2[i];
        let value = point(i) * (1.0 - t) + point(i + 1) * t;
        value.max(0.0)
    }

    /// The points between which it is linear, nm.
    pub(super) fn breakpoints_nm() -> impl Iterator<Item = f64> {
        (0..S0.len()).map(|i| FIRST_NM + STEP_NM * i as f64)
    }

    pub(super) fn range_nm() -> (f64, f64) {
        (FIRST_NM, FIRST_NM + STEP_NM * (S0.len() - 1) as f64)
    }
}

/// An emission line: all its power at one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Vacuum wavelength, nm.
    pub nm: f64,
    /// The integral over the line, in the spectrum's unit times nm.
    pub power: f64,
}

const FIRST_NM: f64 = 300.0;
const STEP_NM: f64 = 10.0;

/// Components of daylight (CIE 15:2004, table T.2): the mean, yellow–blue, pink–green.
const S0: [f64; 54] = [
    0.04, 6.0, 29.6, 55.3, 57.3, 61.8, 61.5, 68.8, 63.4, 65.8, 94.8, 104.8, 105.9, 96.8, 113.9, 125.6, 125.5, 121.3,
    121.3, 113.5, 113.1, 110.8, 106.5, 108.8, 105.3, 104.4, 100.0, 96.0, 95.1, 89.1, 90.5, 90.3, 88.4, 84.0, 85.1,
    81.9, 82.6, 84.9, 81.3, 71.9, 74.3, 76.4, 63.3, 71.7, 77.0, 65.2, 47.7, 68.6, 65.0, 66.0, 61.0, 53.3, 58.9, 61.9,
];
const S1: [f64; 54] = [
    0.02, 4.5, 22.4, 42.0, 40.6, 41.6, 38.0, 42.4, 38.5, 35.0, 43.4, 46.3, 43.9, 37.1, 36.7, 35.9, 32.6, 27.9, 24.3,
    20.1, 16.2, 13.2, 8.6, 6.1, 4.2, 1.9, 0.0, -1.6, -3.5, -3.5, -5.8, -7.2, -8.6, -9.5, -10.9, -10.7, -12.0, -14.0,
    -13.6, -12.0, -13.3, -12.9, -10.6, -11.6, -12.2, -10.2, -7.8, -11.2, -10.4, -10.6, -9.7, -8.3, -9.3, -9.8,
];
const S2: [f64; 54] = [
    0.0, 2.0, 4.0, 8.5, 7.8, 6.7, 5.3, 6.1, 3.0, 1.2, -1.1, -0.5, -0.7, -1.2, -2.6, -2.9, -2.8, -2.6, -2.6, -1.8, -1.5,
    -1.3, -1.2, -1.0, -0.5, -0.3, 0.0, 0.2, 0.5, 2.1, 3.2, 4.1, 4.7, 5.1, 6.7, 7.3, 8.6, 9.8, 10.2, 8.3, 9.6, 8.5, 7.0,
    7.6, 8.0, 6.7, 5.2, 7.4, 6.8, 7.0, 6.4, 5.5, 6.1, 6.5,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planck_integrates_to_stefan_boltzmann() {
        // ∫ L dλ = σ T⁴ / π; substitute λ = e^u, Simpson over ten decades.
        for kelvin in [300.0, 2856.0, 6500.0] {
            let (low, high, steps) = (libm::log(1e-3 * 2.9e6 / kelvin * 10.0), libm::log(1e5 * 2.9e6 / kelvin), 20_000);
            let h = (high - low) / f64::from(steps);
            let integral: f64 = (0..=steps)
                .map(|i| {
                    let nm = libm::exp(low + h * f64::from(i));
                    let weight = if i == 0 || i == steps { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
                    weight * nm * planck(kelvin, nm)
                })
                .sum::<f64>()
                * h
                / 3.0;
            let sigma = 5.670_374_419e-8;
            let expected = sigma * kelvin.powi(4) / std::f64::consts::PI;
            assert!((integral / expected - 1.0).abs() < 1e-9, "{kelvin} K: {integral} against {expected}");
        }
    }

    #[test]
    fn cold_and_odd_bodies_are_dark() {
        assert_eq!(planck(0.0, 500.0), 0.0);
        assert_eq!(planck(-5.0, 500.0), 0.0);
        assert_eq!(planck(f64::NAN, 500.0), 0.0);
        assert_eq!(planck(1.0, 500.0), 0.0);
    }

    #[test]
    fn daylight_knows_its_range() {
        assert!(Daylight::new(3999.0).is_err() && Daylight::new(f64::NAN).is_err());
        let d65 = Daylight::new(6500.0 * 1.4388 / 1.438).unwrap();
        assert!((d65.at(560.0) - 100.0).abs() < 1e-12);
        assert!((d65.at(460.0) - 117.812).abs() < 1e-3);
        assert_eq!((d65.at(299.0), d65.at(831.0), d65.at(f64::NAN)), (0.0, 0.0, 0.0));
        assert!(d65.at(830.0) > 0.0);
    }
}
