//! A glass catalogue of Zemax: text lines, each with a keyword, of many glasses.
//!
//! ```text
//! NM name formula …                  starts a glass; formula is 1 … 13
//! CD coefficients                    of the formula, λ in µm
//! LD shortest longest                wavelengths that it holds for, µm
//! IT wavelength transmittance mm     internal, through so many mm
//! ```
//!
//! Each of the thirteen formulas is one of ours with its coefficients in another order. Glass is
//! told by its name, as `SCHOTT.AGF#N-BK7`. Indices are relative to air, as in every catalogue, and
//! are used as printed.

use super::absorbing::k_of_transmittance;
use super::curve::common_range;
use super::error::Fault;
use super::rows::Separator;
use super::table::{Bound, Number};
use super::words::Word;
use super::{About, Formula, FormulaType, Ior, Outside, Sample, Source, Spectrum, Table, nearest};

/// The lines of one glass.
#[derive(Default)]
struct Glass<'a> {
    name: Option<Word<'a>>,
    formula: Option<Word<'a>>,
    coefficients: Vec<Word<'a>>,
    range: Vec<Word<'a>>,
    transmittances: Vec<Vec<Word<'a>>>,
}

/// The index of a glass of the catalogue; without a name, of its only one.
pub(super) fn read(text: &str, name: &str, glass: Option<&str>) -> Result<Ior, Fault> {
    let glasses = glasses(text);
    let names: Vec<&str> = glasses.iter().filter_map(|glass| glass.name).map(|name| name.text).collect();
    let found = match (glass, glasses.as_slice()) {
        (_, []) => return Err(Fault::new("no glass in the catalogue, expected lines that start with NM, CD and LD")),
        (None, [only]) => only,
        (None, _) => {
            let message = format!("{} glasses: name one, as `{name}#{}`", names.len(), names[0]);
            return Err(Fault::new(message));
        }
        (Some(wanted), all) => {
            let is = |glass: &&Glass| glass.name.is_some_and(|name| name.text.eq_ignore_ascii_case(wanted));
            all.iter().find(is).ok_or_else(|| {
                let hint = nearest(wanted, names.iter().copied());
                let hint = hint.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
                Fault::new(format!("no glass of the catalogue is called `{wanted}`{hint}"))
            })?
        }
    };
    found.ior(name)
}

fn glasses(text: &str) -> Vec<Glass<'_>> {
    let mut glasses: Vec<Glass> = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let words = Separator::Blanks.words(line, start);
        start += line.len();
        let Some((keyword, rest)) = words.split_first() else { continue };
        if keyword.text == "NM" {
            glasses.push(Glass { name: rest.first().copied(), formula: rest.get(1).copied(), ..Glass::default() });
            continue;
        }
        let Some(glass) = glasses.last_mut() else { continue };
        match keyword.text {
            "CD" => glass.coefficients = rest.to_vec(),
            "LD" => glass.range = rest.to_vec(),
            "IT" => glass.transmittances.push(rest.to_vec()),
            _ => {}
        }
    }
    glasses.retain(|glass| glass.name.is_some());
    glasses
}

impl Glass<'_> {
    fn ior(&self, name: &str) -> Result<Ior, Fault> {
        let place = self.name.map_or(0, |name| name.offset);
        let fault = |message: String| Fault::at(place, message);
        let range: Vec<f64> =
            self.range.iter().take(2).map(|word| Ok(word.scaled(3)?.value)).collect::<Result<_, _>>()?;
        let &[low, high] = range.as_slice() else {
            return Err(fault("a glass without a line LD of two wavelengths".to_owned()));
        };
        let given: Vec<f64> =
            self.coefficients.iter().map(|word| Ok(word.number()?.value)).collect::<Result<_, _>>()?;
        let number = self.formula.map(|word| word.number()).transpose()?.map_or(0.0, |number| number.value);
        // A pole without its place is another glass.
        let lacks_one = match number as u32 {
            2 | 6 | 11 => given.len() % 2 == 1,
            9 => given.len().is_multiple_of(2),
            _ => false,
        };
        if given.is_empty() || lacks_one {
            return Err(fault(format!("{} coefficients in its line CD: one is missing", given.len())));
        }
        let Some((kind, coefficients)) = formula(number as u32, &given) else {
            return Err(fault(format!("the dispersion formula {number}, expected 1 to 13")));
        };
        let n = Formula::new(kind, coefficients, (low, high)).map_err(|error| fault(error.message))?;
        let mut notes = Vec::new();
        let k = self.k(&mut notes)?.map_or(Spectrum::Constant(0.0), Spectrum::Table);
        let range_nm = [Some((low, high)), k.range_nm()].into_iter().flatten().reduce(common_range);
        let source = Source { origin: name.to_owned(), ..Source::default() };
        let n = Spectrum::Formula(n);
        Ok(Ior { n, k, about: About { name: name.to_owned(), source, sample: Sample::default(), range_nm, notes } })
    }

    /// k from the lines of transmittance, if there are any that tell one.
    fn k(&self, notes: &mut Vec<String>) -> Result<Option<Table>, Fault> {
        let mut rows: Vec<[Number; 3]> = Vec::new();
        for row in &self.transmittances {
            if let [nm, value, mm, ..] = row.as_slice() {
                let row = [nm.scaled(3)?, value.number()?, mm.number()?];
                // Where nothing passes, no k is told.
                rows.extend(Some(row).filter(|[_, value, mm]| value.value > 0.0 && mm.value > 0.0));
            }
        }
        if rows.is_empty() {
            return Ok(None);
        }
        let column = |i: usize| rows.iter().map(|row| row[i]).collect::<Vec<_>>();
        let (nm, values, mm) = (column(0), column(1), column(2));
        let what = "an internal transmittance";
        let table = Table::from_numbers(&nm, &values, what, Bound::Transmittance, Outside::Hold, notes)?;
        let thickness = Table::from_numbers(&nm, &mm, "a thickness", Bound::Positive, Outside::Hold, &mut Vec::new())?;
        Ok(Some(k_of_transmittance(&table, |nm| thickness.at(nm) * 1e-3)))
    }
}

/// Our formula and its coefficients for one of the catalogue's, by its number.
fn formula(number: u32, given: &[f64]) -> Option<(FormulaType, Vec<f64>)> {
    let c = |i: usize| given.get(i).copied().unwrap_or(0.0);
    // n² = Σ c λ^e
    let powers = |exponents: &[f64]| {
        let terms = exponents.iter().enumerate().flat_map(|(i, &exponent)| [c(i + 1), exponent]);
        (FormulaType::Polynomial, std::iter::once(c(0)).chain(terms).collect())
    };
    // n² − 1 = first + Σ K λ² / (λ² − L)
    let sellmeier = |first: f64, from: usize, terms: usize| {
        let pairs = (0..terms).flat_map(|term| [c(from + 2 * term), c(from + 2 * term + 1)]);
        (FormulaType::Sellmeier2, std::iter::once(first).chain(pairs).collect())
    };
    // n² = A + B λ^e / (λ² − C) − D λ²
    let handbook = |exponent: f64| {
        let own = vec![c(0), c(1), exponent, c(2), 1.0, 0.0, 0.0, 0.0, 0.0, -c(3), 2.0];
        (FormulaType::RefractiveIndexInfo, own)
    };
    Some(match number {
        1 => powers(&[2.0, -2.0, -4.0, -6.0, -8.0]),
        2 => sellmeier(0.0, 0, 3),
        3 => (FormulaType::Herzberger, (0..6).map(c).collect()),
        // n² − 1 = A + B1 λ² / (λ² − λ1²) + B2 / (λ² − λ2²)
        4 => (FormulaType::RefractiveIndexInfo, vec![1.0 + c(0), c(1), 2.0, c(2), 2.0, c(3), 0.0, c(4), 2.0]),
        // n = A + B / λ + C / λ^3.5
        5 => (FormulaType::Cauchy, vec![c(0), c(1), -1.0, c(2), -3.5]),
        6 => sellmeier(0.0, 0, 4),
        7 => handbook(0.0),
        8 => handbook(2.0),
        9 => sellmeier(c(0) - 1.0, 1, 2),
        10 => powers(&[2.0, -2.0, -4.0, -6.0, -8.0, -10.0, -12.0]),
        11 => sellmeier(0.0, 0, 5),
        12 => powers(&[2.0, -2.0, -4.0, -6.0, -8.0, 4.0, 6.0]),
        13 => powers(&[2.0, 4.0, -2.0, -4.0, -6.0, -8.0, -10.0, -12.0]),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const CATALOGUE: &str = "CC made up\nNM N-BK7 2 517642.251 1.5168 64.17 0 1 0\nED 7.1 8.3 2.51 -0.0009 0\n\
        CD 1.03961212 6.00069867E-03 2.31792344E-01 2.00179144E-02 1.01046945 1.03560653E+02 0 0\nLD 0.3 2.5\n\
        IT 0.3 0.05 10\nIT 0.5 9.0E-01 10\nIT 0.9 1.0 25\nNM F2 1 620364 1.62004 36.37\n\
        CD 2.5554063 -0.0088746150 0.022494787 0.00086924972 -2.4011704E-05 4.5365169E-06\nLD 0.4 1.5\n";

    #[test]
    fn a_glass_is_found_by_its_name() {
        let bk7 = read(CATALOGUE, "a.agf", Some("n-bk7")).unwrap();
        // The catalogue's n_d.
        assert!((bk7.n.at(587.5618) - 1.5168).abs() < 1e-5);
        let k = -libm::log(0.9) * 500e-9 / (4.0 * std::f64::consts::PI * 0.01);
        assert!((bk7.k.at(500.0) / k - 1.0).abs() < 1e-14 && bk7.k.at(900.0) == 0.0);
        assert_eq!(bk7.about.range_nm, Some((300.0, 900.0)));
        let f2 = read(CATALOGUE, "a.agf", Some("F2")).unwrap();
        assert!((f2.n.at(587.5618) - 1.62004).abs() < 1e-4, "{}", f2.n.at(587.5618));
        let says = |glass| read(CATALOGUE, "a.agf", glass).unwrap_err().message;
        assert!(says(None).contains("2 glasses: name one, as `a.agf#N-BK7`"), "{}", says(None));
        assert!(says(Some("N-BK8")).contains("did you mean `N-BK7`"), "{}", says(Some("N-BK8")));
        assert!(read("", "a.agf", None).is_err());
        for line in ["CD 1.03961212 6.00069867E-03 2.31792344E-01 2.00179144E-02 1.01046945\n", ""] {
            let text = format!("NM N-BK7 2 517642.251 1.5168 64.17\n{line}LD 0.3 2.5\n");
            assert!(read(&text, "a.agf", None).unwrap_err().message.contains("one is missing"), "{line}");
        }
    }

    #[test]
    fn each_formula_is_its_own_definition() {
        let c = [2.2, 0.01, 0.02, 0.003, 0.0001, 0.00002, 0.000003, 0.0000004, 0.00000005];
        let l: f64 = 0.6;
        let l2 = l * l;
        let pole = |k: usize| c[k] * l2 / (l2 - c[k + 1]);
        let power = |k: usize, exponent: i32| c[k] * l.powi(exponent);
        let squared = |number: u32| {
            let (kind, own) = formula(number, &c).unwrap();
            let n =
                Formula::new(kind, own, (500.0, 700.0)).unwrap_or_else(|fault| panic!("{number}: {}", fault.message));
            n.at(600.0) * n.at(600.0)
        };
        let h = 1.0 / (l2 - 0.028);
        let herzberger = c[0] + c[1] * h + c[2] * h * h + c[3] * l2 + c[4] * l2 * l2 + c[5] * l2 * l2 * l2;
        let schott = c[0] + power(1, 2) + power(2, -2) + power(3, -4) + power(4, -6) + power(5, -8);
        for (number, expected) in [
            (1, schott),
            (2, 1.0 + pole(0) + pole(2) + pole(4)),
            (3, herzberger * herzberger),
            (4, 1.0 + c[0] + c[1] * l2 / (l2 - c[2] * c[2]) + c[3] / (l2 - c[4] * c[4])),
            (5, (c[0] + c[1] / l + c[2] / libm::pow(l, 3.5)).powi(2)),
            (6, 1.0 + pole(0) + pole(2) + pole(4) + pole(6)),
            (7, c[0] + c[1] / (l2 - c[2]) - c[3] * l2),
            (8, c[0] + c[1] * l2 / (l2 - c[2]) - c[3] * l2),
            (9, c[0] + pole(1) + pole(3)),
            (10, schott + power(6, -10) + power(7, -12)),
            (11, 1.0 + pole(0) + pole(2) + pole(4) + pole(6) + c[8]),
            (12, schott + power(6, 4) + power(7, 6)),
            (
                13,
                c[0] + power(1, 2)
                    + power(2, 4)
                    + power(3, -2)
                    + power(4, -4)
                    + power(5, -6)
                    + power(6, -8)
                    + power(7, -10)
                    + power(8, -12),
            ),
        ] {
            assert!(
                (squared(number) / expected - 1.0).abs() < 1e-13,
                "formula {number}: {} {expected}",
                squared(number)
            );
        }
        assert!(formula(14, &c).is_none() && formula(0, &c).is_none());
    }
}
