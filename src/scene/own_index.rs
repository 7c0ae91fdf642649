//! An index of refraction that a material's file gives by itself: by numbers of a catalogue, a
//! formula or a table.

use super::numbers::{Exactly, Finite};
use crate::spectrum::{About, Confidence, Formula, FormulaType, HELIUM_D_NM, Ior, Outside, Sample, Spectrum, Table};
use serde::Deserialize;

/// An index of refraction by its own numbers: one of `n` (with `k`), `n_d` with `abbe`, `cauchy`,
/// `sellmeier` and `table`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OwnIndex {
    /// The same at all wavelengths; or three for red, green and blue, which is approximate: they
    /// are taken for 650, 550 and 450 nm, with straight lines between.
    pub n: Option<OneOrThree>,
    /// Beside `n`; 0 unless given.
    pub k: Option<OneOrThree>,
    /// Index at 587.56 nm, beside `abbe`.
    pub n_d: Option<f64>,
    /// Abbe's number V_d = (n_d − 1) / (n_F − n_C); the curve is Cauchy's with two terms.
    pub abbe: Option<f64>,
    /// [A, B, C, …] with n = A + B/λ² + C/λ⁴ …, λ in µm.
    pub cauchy: Option<Vec<f64>>,
    /// [B1, C1, B2, C2, …] with n² = 1 + B1 λ²/(λ² − C1) + …, λ in µm, C in µm².
    pub sellmeier: Option<Vec<f64>>,
    pub table: Option<IndexTable>,
}

/// A measured index, linear between its points; beyond them the ends are held.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IndexTable {
    /// In increasing order.
    pub wavelength_nm: Vec<f64>,
    pub n: Vec<f64>,
    /// 0 unless given.
    pub k: Option<Vec<f64>>,
}

/// A number, or three of red, green and blue.
#[derive(Clone, Copy, Debug)]
pub enum OneOrThree {
    One(f64),
    Three(Exactly<Finite, 3>),
}

/// For which wavelengths three numbers stand, nm, as `rgb-exact-650-550-450` takes them.
const RGB_NM: [f64; 3] = [650.0, 550.0, 450.0];

/// Fraunhofer's F and C, nm, between which Abbe's number is taken (ISO 7944).
const F_NM: f64 = 486.13;
const C_NM: f64 = 656.27;

impl OwnIndex {
    /// Whether nothing but `n` and `k` is given.
    pub fn is_plain(&self) -> bool {
        let Self { n: _, k: _, n_d, abbe, cauchy, sellmeier, table } = self;
        n_d.is_none() && abbe.is_none() && cauchy.is_none() && sellmeier.is_none() && table.is_none()
    }

    /// What is meant, or what is wrong with it.
    pub fn ior(&self, name: &str) -> Result<Ior, String> {
        let own = (&self.n, self.n_d.or(self.abbe), &self.cauchy, &self.sellmeier, &self.table);
        if self.k.is_some() && self.n.is_none() {
            return Err("`k` without `n`: a formula's k stands in a data file".into());
        }
        let formula = |kind, coefficients| {
            let formula = Formula::visible(kind, coefficients).map_err(|error| error.to_string())?;
            Ok(Ior { n: Spectrum::Formula(formula), k: Spectrum::Constant(0.0), about: about(name) })
        };
        match own {
            (Some(n), None, None, None, None) => Ok(of_numbers(*n, self.k, name)),
            (None, Some(_), None, None, None) => match (self.n_d, self.abbe) {
                (Some(n_d), Some(abbe)) if abbe > 0.0 => formula(FormulaType::Cauchy, cauchy_of_abbe(n_d, abbe)),
                (Some(_), Some(abbe)) => Err(format!("`abbe` is {abbe}: it must be above 0")),
                _ => Err("`n_d` and `abbe` belong together: { n_d = 1.5168, abbe = 64.2 }".into()),
            },
            (None, None, Some(terms), None, None) => match terms.split_first() {
                Some((first, rest)) => {
                    let pairs = rest.iter().zip(1..).flat_map(|(term, i)| [*term, -2.0 * f64::from(i)]);
                    formula(FormulaType::Cauchy, std::iter::once(*first).chain(pairs).collect())
                }
                None => Err("`cauchy` is empty: it holds A, B, … of n = A + B/λ² + …".into()),
            },
            (None, None, None, Some(terms), None) => {
                let pairs = std::iter::once(0.0).chain(terms.iter().copied()).collect();
                formula(FormulaType::Sellmeier2, pairs)
                    .map_err(|error| format!("{error}; `sellmeier` is [B1, C1, B2, C2, …] with λ in µm and C in µm²"))
            }
            (None, None, None, None, Some(table)) => table.ior(name),
            (None, None, None, None, None) => {
                Err("this table is empty: give `n`, `n_d` and `abbe`, or a formula".into())
            }
            _ => Err("more than one of `n`, `n_d`, `cauchy`, `sellmeier` and `table`: they all say the same".into()),
        }
    }
}

fn about(name: &str) -> About {
    About { name: name.to_owned(), ..About::default() }
}

fn of_numbers(n: OneOrThree, k: Option<OneOrThree>, name: &str) -> Ior {
    let k = k.unwrap_or(OneOrThree::One(0.0));
    let mut about = about(name);
    if [n, k].iter().any(|numbers| matches!(numbers, OneOrThree::Three(_))) {
        let description = "three numbers for red, green and blue, taken for 650, 550 and 450 nm";
        about.sample = Sample { description: description.into(), confidence: Confidence::Low, ..Sample::default() };
        about.notes.push(format!("n and k are approximate: {description}"));
    }
    Ior { n: n.spectrum(), k: k.spectrum(), about }
}

impl OneOrThree {
    fn spectrum(self) -> Spectrum {
        match self {
            Self::One(value) => Spectrum::Constant(value),
            Self::Three(values) => {
                let points: Vec<_> = RGB_NM.into_iter().zip(values.values()).collect();
                Spectrum::Table(Table::from_points(&points, Outside::Hold))
            }
        }
    }
}

/// A + B/λ² through n_d, with n_F − n_C = (n_d − 1) / V_d; λ in µm.
fn cauchy_of_abbe(n_d: f64, abbe: f64) -> Vec<f64> {
    let per_square = |nm: f64| 1e6 / (nm * nm);
    let b = (n_d - 1.0) / abbe / (per_square(F_NM) - per_square(C_NM));
    vec![n_d - b * per_square(HELIUM_D_NM), b, -2.0]
}

impl IndexTable {
    fn ior(&self, name: &str) -> Result<Ior, String> {
        let Self { wavelength_nm, n, k } = self;
        let column = |values: &[f64], what: &str, least: f64| {
            if values.len() != wavelength_nm.len() || values.is_empty() {
                return Err(format!("{} wavelengths and {} values of {what}", wavelength_nm.len(), values.len()));
            }
            let points: Vec<_> = wavelength_nm.iter().copied().zip(values.iter().copied()).collect();
            match points.iter().find(|(nm, value)| !(value.is_finite() && *value >= least && *nm > 0.0)) {
                Some((nm, value)) => Err(format!("{what} is {value} at {nm} nm")),
                None => Ok(Spectrum::Table(Table::from_points(&points, Outside::Hold))),
            }
        };
        if let Some([before, after]) = wavelength_nm.array_windows().find(|[before, after]| before >= after) {
            return Err(format!("wavelengths must grow: {before} nm is followed by {after} nm"));
        }
        let n = column(n, "n", f64::MIN_POSITIVE)?;
        let k = k.as_ref().map_or(Ok(Spectrum::Constant(0.0)), |k| column(k, "k", 0.0))?;
        let range_nm = n.range_nm();
        Ok(Ior { n, k, about: About { range_nm, ..about(name) } })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Ior, String> {
        toml::from_str::<OwnIndex>(text).map_err(|error| error.to_string())?.ior("own")
    }

    #[test]
    fn catalogues_and_formulas_give_their_glass() {
        let crown = read("n_d = 1.5168\nabbe = 64.2").unwrap();
        assert!((crown.n.at(HELIUM_D_NM) - 1.5168).abs() < 1e-12);
        let v = (crown.n.at(HELIUM_D_NM) - 1.0) / (crown.n.at(F_NM) - crown.n.at(C_NM));
        assert!((v - 64.2).abs() < 1e-9, "{v}");
        let cauchy = read("cauchy = [1.5, 0.004, 1e-5]").unwrap();
        assert!((cauchy.n.at(500.0) - (1.5 + 0.004 / 0.25 + 1e-5 / 0.0625)).abs() < 1e-12);
        let bk7 = read("sellmeier = [1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653]");
        assert!((bk7.unwrap().n.at(587.5618) - 1.5168).abs() < 1e-5);
    }

    #[test]
    fn tables_and_three_numbers_are_linear_between() {
        let gold = read("table = { wavelength_nm = [400, 600], n = [1.5, 0.2], k = [2, 3] }").unwrap();
        assert_eq!((gold.n.at(500.0), gold.k.at(500.0), gold.about.range_nm), (0.85, 2.5, Some((400.0, 600.0))));
        let rgb = read("n = [0.143, 0.375, 1.442]\nk = [3.983, 2.386, 1.603]").unwrap();
        assert_eq!((rgb.at(650.0), rgb.at(550.0), rgb.at(450.0)), ((0.143, 3.983), (0.375, 2.386), (1.442, 1.603)));
        assert_eq!(rgb.about.sample.confidence, Confidence::Low);
        assert!(rgb.about.notes[0].contains("approximate"));
        assert_eq!(read("n = 1.5\nk = 0.25").unwrap().at(500.0), (1.5, 0.25));
    }

    #[test]
    fn what_is_no_index_is_told() {
        for (text, says) in [
            ("n_d = 1.5", "belong together"),
            ("n_d = 1.5\nabbe = 0", "`abbe` is 0"),
            ("cauchy = []", "`cauchy` is empty"),
            ("n = 1.5\ncauchy = [1.5]", "more than one"),
            ("k = 1.5", "`k` without `n`"),
            ("", "empty"),
            // In the order of some catalogues, B1, B2, B3, C1, C2, C3.
            (
                "sellmeier = [1.03961212, 0.231792344, 1.01046945, 0.00600069867, 0.0200179144, 103.560653]",
                "[B1, C1, B2, C2",
            ),
            ("sellmeier = [1.0, 0.1, 1.0]", "expected an odd number"),
            ("table = { wavelength_nm = [500, 400], n = [1, 1] }", "400 nm"),
            ("table = { wavelength_nm = [400, 500], n = [1] }", "2 wavelengths and 1 values"),
            ("table = { wavelength_nm = [400], n = [0] }", "n is 0 at 400 nm"),
            ("abbey = 3", "unknown field"),
        ] {
            let message = read(text).unwrap_err();
            assert!(message.contains(says), "{text}: {message}");
        }
    }
}
