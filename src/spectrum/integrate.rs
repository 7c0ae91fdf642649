//! Integrals of products of spectra over the visible range, 360–830 nm.
//!
//! Between the breakpoints of its factors a product is smooth, and for tables a polynomial: Gauss–Legendre with enough
//! points is then exact but for rounding. Formulas, black bodies, bands and sigmoids are not polynomials; their stretches
//! are cut to 2 nm, where four points leave an error below rounding. Emission lines are added as what they are.
//!
//! The other convention here is the rectangle sum at 1 nm that colour tables are made with.

use super::{ColorMatching, LAMBDA_MAX_NM, LAMBDA_MIN_NM, LUMENS_PER_WATT, Line, Spectrum, SpectrumError, Xyz};

/// Longest stretch that is integrated in one go if a factor is no polynomial, nm.
const SMOOTH_STEP_NM: f64 = 2.0;

/// Gauss–Legendre abscissae and weights on −1…1: two points are exact to degree 3, four to degree 7.
const GAUSS_2: [(f64, f64); 2] = [(-0.577_350_269_189_625_8, 1.0), (0.577_350_269_189_625_8, 1.0)];
const GAUSS_4: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

/// ∫ of the product of the factors over 360–830 nm. Where two factors have lines at once, their product has no meaning
/// and is left out.
pub fn integrate(factors: &[&Spectrum]) -> f64 {
    let [integral] = integrate_with(factors, &[], |_| [1.0], 0);
    integral
}

/// ∫ of the product of the factors times (x̄, ȳ, z̄): XYZ without a scale.
pub fn tristimulus(factors: &[&Spectrum], observer: &ColorMatching) -> Xyz {
    integrate_with(factors, observer.y.wavelengths_nm(), |nm| observer.at(nm), 1)
}

/// XYZ of a spectral radiance in W m⁻² sr⁻¹ nm⁻¹, cd/m²: 683 ∫ L (x̄, ȳ, z̄) dλ.
pub fn radiance_xyz(radiance: &Spectrum, observer: &ColorMatching) -> Xyz {
    tristimulus(&[radiance], observer).map(|integral| LUMENS_PER_WATT * integral)
}

/// Luminance of a spectral radiance in W m⁻² sr⁻¹ nm⁻¹, cd/m²: the Y of [`radiance_xyz`].
pub fn luminance(radiance: &Spectrum, observer: &ColorMatching) -> f64 {
    radiance_xyz(radiance, observer)[1]
}

/// XYZ of a perfect reflector under an illuminant, Y = 1, from the exact integral.
pub fn white_xyz(illuminant: &Spectrum, observer: &ColorMatching) -> Result<Xyz, SpectrumError> {
    normalised(tristimulus(&[illuminant], observer))
}

/// ∫ of the product times (x̄, ȳ, z̄) as a rectangle sum over 360, 361, … 830 nm: the convention of colour tables.
/// Lines count in full.
pub fn tristimulus_1nm(factors: &[&Spectrum], observer: &ColorMatching) -> Xyz {
    let mut sum = [0.0; 3];
    for nm in nanometres() {
        add(&mut sum, observer.at(nm), product(factors, nm));
    }
    add_lines(&mut sum, factors, &|nm| observer.at(nm));
    sum
}

/// The terms of a sum at 1 nm over a light: wavelengths, nm, and the light's power there; its lines count in full.
pub(super) fn lines_and_nanometres(light: &Spectrum) -> impl Iterator<Item = (f64, f64)> {
    let visible = |line: &Line| (LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(&line.nm);
    let lines = light.lines().into_iter().filter(visible).map(|line| (line.nm, line.power));
    nanometres().map(|nm| (nm, light.at(nm))).chain(lines)
}

fn nanometres() -> impl Iterator<Item = f64> {
    (LAMBDA_MIN_NM as u32..=LAMBDA_MAX_NM as u32).map(f64::from)
}

/// XYZ of a perfect reflector under an illuminant, Y = 1, from the 1 nm sum.
pub fn white_xyz_1nm(illuminant: &Spectrum, observer: &ColorMatching) -> Result<Xyz, SpectrumError> {
    normalised(tristimulus_1nm(&[illuminant], observer))
}

fn normalised(xyz: Xyz) -> Result<Xyz, SpectrumError> {
    if xyz[1] > 0.0 && xyz.iter().all(|value| value.is_finite()) {
        Ok(xyz.map(|value| value / xyz[1]))
    } else {
        Err(SpectrumError::NoLight)
    }
}

fn product(factors: &[&Spectrum], nm: f64) -> f64 {
    factors.iter().map(|factor| factor.at(nm)).product()
}

fn add<const C: usize>(sum: &mut [f64; C], weights: [f64; C], value: f64) {
    for (sum, weight) in sum.iter_mut().zip(weights) {
        *sum += weight * value;
    }
}

/// ∫ product · weights; the weights are polynomials of `degree` between `breakpoints`.
fn integrate_with<const C: usize>(
    factors: &[&Spectrum],
    breakpoints: &[f64],
    weights: impl Fn(f64) -> [f64; C],
    degree: usize,
) -> [f64; C] {
    let mut sum = [0.0; C];
    quadrature(factors, breakpoints, degree, |nm, weight| add(&mut sum, weights(nm), weight * product(factors, nm)));
    add_lines(&mut sum, factors, &weights);
    sum
}

/// Visits the wavelengths (nm) and weights (nm) whose weighted sum is the integral of the product of the factors with a
/// function that is a polynomial of `degree` between the `breakpoints`.
pub(super) fn quadrature(factors: &[&Spectrum], breakpoints: &[f64], degree: usize, mut visit: impl FnMut(f64, f64)) {
    let polynomial = factors.iter().all(|factor| factor.is_piecewise_linear());
    let degree = factors.len() + degree;
    let rule: &[(f64, f64)] = if polynomial && degree <= 3 { &GAUSS_2 } else { &GAUSS_4 };
    let longest = if polynomial && degree <= 7 { f64::INFINITY } else { SMOOTH_STEP_NM };
    for ends in cuts(factors, breakpoints).windows(2) {
        let (start, end) = (ends[0], ends[1]);
        let pieces = ((end - start) / longest).ceil().max(1.0);
        let half = 0.5 * (end - start) / pieces;
        for piece in 0..pieces as usize {
            let middle = start + half * (2 * piece + 1) as f64;
            for &(x, weight) in rule {
                visit(middle + half * x, weight * half);
            }
        }
    }
}

/// All breakpoints within the visible range, sorted, with its ends.
fn cuts(factors: &[&Spectrum], more: &[f64]) -> Vec<f64> {
    let mut cuts: Vec<f64> = factors.iter().flat_map(|factor| factor.breakpoints_nm()).collect();
    cuts.extend(more);
    cuts.retain(|nm| (LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(nm));
    cuts.extend([LAMBDA_MIN_NM, LAMBDA_MAX_NM]);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    cuts
}

fn add_lines<const C: usize>(sum: &mut [f64; C], factors: &[&Spectrum], weights: &impl Fn(f64) -> [f64; C]) {
    for (i, factor) in factors.iter().enumerate() {
        for Line { nm, power } in factor.lines() {
            if !(LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(&nm) {
                continue;
            }
            let others: f64 =
                factors.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, other)| other.at(nm)).product();
            add(sum, weights(nm), power * others);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Band, Bands, Outside, Table};
    use super::*;

    fn ramp(points: &[(f64, f64)]) -> Spectrum {
        Spectrum::Table(Table::from_points(points, Outside::Zero))
    }

    #[test]
    fn products_of_tables_are_exact() {
        assert!((integrate(&[&Spectrum::Constant(2.0)]) - 940.0).abs() < 1e-10);
        // Over 400…500, t and 1 − t: ∫ t (1 − t) = 100/6; with t²: ∫ t³ (1 − t) = 100/20.
        let (up, down) = (ramp(&[(400.0, 0.0), (500.0, 1.0)]), ramp(&[(400.0, 1.0), (500.0, 0.0)]));
        assert!((integrate(&[&up, &down]) - 100.0 / 6.0).abs() < 1e-12);
        assert!((integrate(&[&up, &up, &up, &down]) - 5.0).abs() < 1e-12);
        let many = [&up; 9];
        assert!((integrate(&many) - 10.0).abs() < 1e-9);
        // Half of a table may lie outside.
        assert!((integrate(&[&ramp(&[(350.0, 1.0), (370.0, 1.0)])]) - 10.0).abs() < 1e-12);
    }

    #[test]
    fn smooth_factors_are_exact_to_rounding() {
        let band = Band { center_nm: 600.0, fwhm_nm: 5.0, peak: 2.0, source: String::new() };
        let bands = Spectrum::Bands(Bands::new(vec![band]).unwrap());
        let area = 2.0 * 5.0 * (std::f64::consts::PI / (4.0 * std::f64::consts::LN_2)).sqrt();
        assert!((integrate(&[&bands]) / area - 1.0).abs() < 1e-9);
    }

    #[test]
    fn lines_count_once_and_meet_the_other_factors() {
        let line = Spectrum::Lines(vec![Line { nm: 450.0, power: 3.0 }, Line { nm: 900.0, power: 3.0 }]);
        let up = ramp(&[(400.0, 0.0), (500.0, 1.0)]);
        assert!((integrate(&[&line, &up]) - 1.5).abs() < 1e-12);
        assert!((integrate(&[&up, &line]) - 1.5).abs() < 1e-12);
    }
}
