//! A page of the refractiveindex.info database: YAML with a list DATA of tables and formulas, wavelengths in µm.
//!
//! ```yaml
//! REFERENCES: "who published it"
//! DATA:
//!   - type: tabulated nk          # or `tabulated n`, `tabulated k`, `formula 1` … `formula 9`
//!     data: |
//!         0.400 1.47 1.95
//!   - type: formula 2
//!     wavelength_range: 0.3 2.5   # `range` in older pages
//!     coefficients: 0 1.0396 0.0060
//! ```
//!
//! Some pages repeat a wavelength: values that agree are averaged, otherwise the first counts. Other keys (conditions,
//! properties) are not read.

use serde::Deserialize;
use serde_saphyr::Spanned;

use super::curve::common_range;
use super::error::Fault;
use super::noise::agree;
use super::table::{Bound, Number};
use super::words::Word;
use super::{About, Formula, FormulaType, Ior, Outside, Sample, Source, Spectrum, Table};

#[derive(Deserialize)]
struct Page {
    #[serde(rename = "REFERENCES")]
    references: Option<String>,
    #[serde(rename = "COMMENTS")]
    comments: Option<String>,
    #[serde(rename = "DATA")]
    data: Vec<Entry>,
}

#[derive(Deserialize)]
struct Entry {
    r#type: Spanned<String>,
    data: Option<Spanned<String>>,
    #[serde(alias = "range")]
    wavelength_range: Option<Spanned<String>>,
    coefficients: Option<Spanned<String>>,
}

/// Reads a page as an index of refraction. A page with k alone has no n and is refused, but see [`read_k`].
pub(super) fn read(text: &str, name: &str) -> Result<Ior, Fault> {
    let page = parse(text)?;
    let mut notes = Vec::new();
    let (n, k) = page.spectra(text, &mut notes)?;
    let n = n.ok_or_else(|| Fault::new("the page has no n, expected `tabulated nk`, `tabulated n` or `formula N`"))?;
    let k = k.unwrap_or(Spectrum::Constant(0.0));
    let range_nm = [n.range_nm(), k.range_nm()].into_iter().flatten().reduce(common_range);
    Ok(Ior { n, k, about: About { range_nm, notes, ..page.about(name) } })
}

/// Reads the extinction coefficient alone.
pub(super) fn read_k(text: &str, name: &str) -> Result<(Table, About), Fault> {
    let page = parse(text)?;
    let mut notes = Vec::new();
    match page.spectra(text, &mut notes)?.1 {
        Some(Spectrum::Table(k)) => {
            let about = About { range_nm: k.range_nm(), notes, ..page.about(name) };
            Ok((k, about))
        }
        _ => Err(Fault::new("the page has no k, expected `tabulated nk` or `tabulated k`")),
    }
}

fn parse(text: &str) -> Result<Page, Fault> {
    serde_saphyr::from_str(text).map_err(|error| {
        let error = error.without_snippet();
        let full = error.to_string();
        let message = full.lines().next().unwrap_or_default();
        match error.location() {
            Some(place) => Fault::at_line(place.line() as usize, place.column() as usize, message),
            None => Fault::new(message),
        }
    })
}

impl Page {
    fn about(&self, name: &str) -> About {
        let references = self.references.as_deref().unwrap_or_default();
        // The DOI hides in a link, before the tags are dropped.
        let doi = references.split("doi.org/").nth(1).and_then(|rest| rest.split(['"', '\'', '<', ' ', '\n']).next());
        let source = Source {
            doi: doi.map(|doi| doi.trim_end_matches(['.', ')', ',']).to_owned()),
            title: plain_text(references),
            origin: name.to_owned(),
            ..Source::default()
        };
        let description = plain_text(self.comments.as_deref().unwrap_or_default());
        About { name: name.to_owned(), source, sample: Sample { description, ..Sample::default() }, ..About::default() }
    }

    /// (n, k), as far as the page has them.
    fn spectra(&self, text: &str, notes: &mut Vec<String>) -> Result<(Option<Spectrum>, Option<Spectrum>), Fault> {
        let (mut n, mut k) = (None, None);
        for entry in &self.data {
            let place = &entry.r#type.referenced;
            let fault = |message: String| Fault::at_line(place.line() as usize, place.column() as usize, message);
            let kind = entry.r#type.value.trim();
            let (new_n, new_k) = match kind {
                "tabulated nk" => {
                    let [nm, n, k] = entry.columns(text, kind)?;
                    (Some(table(&nm, &n, "n", notes)?), Some(table(&nm, &k, "k", notes)?))
                }
                "tabulated n" => {
                    let [nm, n] = entry.columns(text, kind)?;
                    (Some(table(&nm, &n, "n", notes)?), None)
                }
                "tabulated k" => {
                    let [nm, k] = entry.columns(text, kind)?;
                    (None, Some(table(&nm, &k, "k", notes)?))
                }
                _ => {
                    let number = kind.strip_prefix("formula ").and_then(|number| number.trim().parse().ok());
                    let Some(formula) = number.and_then(FormulaType::from_number) else {
                        let message = format!(
                            "the type `{kind}`, expected `tabulated nk`, `tabulated n`, `tabulated k` or `formula 1` to `formula 9`"
                        );
                        return Err(fault(message));
                    };
                    (Some(Spectrum::Formula(entry.formula(text, formula)?)), None)
                }
            };
            if (new_n.is_some() && n.is_some()) || (new_k.is_some() && k.is_some()) {
                return Err(fault("the page gives n or k twice, expected each once".to_owned()));
            }
            n = n.or(new_n);
            k = k.or(new_k);
        }
        Ok((n, k))
    }
}

fn table(nm: &[Number], values: &[Number], what: &str, notes: &mut Vec<String>) -> Result<Spectrum, Fault> {
    let bound = if what == "n" { Bound::Positive } else { Bound::NonNegative };
    Table::from_numbers(nm, values, what, bound, Outside::Hold, notes).map(Spectrum::Table)
}

impl Entry {
    /// The rows of a table as columns, the first in nm.
    fn columns<const N: usize>(&self, text: &str, kind: &str) -> Result<[Vec<Number>; N], Fault> {
        let data = self.data.as_ref().ok_or_else(|| {
            let place = &self.r#type.referenced;
            Fault::at_line(place.line() as usize, place.column() as usize, format!("`{kind}` without `data`"))
        })?;
        let mut columns = std::array::from_fn(|_| Vec::new());
        for row in Words::of(data, text).rows() {
            if row.len() != N {
                let offset = row.first().map_or(0, |word| word.offset);
                let message = format!("{} numbers in a row, expected {N} for `{kind}`", row.len());
                return Err(Fault::at(offset, message));
            }
            let nm = row[0].scaled(3)?;
            let values = row[1..].iter().map(|word| word.number()).collect::<Result<Vec<_>, _>>()?;
            let repeats = columns[0].last().is_some_and(|last: &Number| last.value == nm.value);
            let agrees = |(column, value): (&Vec<Number>, &Number)| {
                column.last().is_some_and(|last| agree(last.value, value.value))
            };
            if repeats && !columns[1..].iter().zip(&values).all(agrees) {
                continue;
            }
            for (column, number) in columns.iter_mut().zip(std::iter::once(nm).chain(values)) {
                column.push(number);
            }
        }
        Ok(columns)
    }

    fn formula(&self, text: &str, kind: FormulaType) -> Result<Formula, Fault> {
        let place = &self.r#type.referenced;
        let fault = |message: &str| Fault::at_line(place.line() as usize, place.column() as usize, message);
        let coefficients = self.coefficients.as_ref().ok_or_else(|| fault("a formula without `coefficients`"))?;
        let range = self.wavelength_range.as_ref().ok_or_else(|| fault("a formula without `wavelength_range`"))?;
        let coefficients: Result<Vec<_>, _> =
            Words::of(coefficients, text).iter().map(|word| word.number().map(|number| number.value)).collect();
        let range: Result<Vec<_>, _> =
            Words::of(range, text).iter().map(|word| word.scaled(3).map(|number| number.value)).collect();
        let &[low, high] = range?.as_slice() else {
            return Err(fault("`wavelength_range` is not two numbers"));
        };
        Formula::new(kind, coefficients?, (low, high)).map_err(|error| fault(&error.message))
    }
}

/// The words of a YAML string with their places in the file.
struct Words<'a> {
    lines: Vec<Vec<Word<'a>>>,
}

impl<'a> Words<'a> {
    /// YAML hands a block over without its indentation, so each word is found again in the file, in order.
    fn of(string: &'a Spanned<String>, file: &str) -> Self {
        let line = (string.referenced.line() as usize).saturating_sub(1);
        let start: usize = file.split_inclusive('\n').take(line).map(str::len).sum();
        let mut offset = start;
        let lines = string.value.lines().map(|line| {
            line.split_whitespace()
                .map(|text| {
                    let found = file.get(offset..).and_then(|rest| rest.find(text)).map(|place| offset + place);
                    let at = found.unwrap_or(offset);
                    offset = found.map_or(offset, |at| at + text.len());
                    Word { text, offset: at }
                })
                .collect::<Vec<_>>()
        });
        Self { lines: lines.filter(|line| !line.is_empty()).collect() }
    }

    fn rows(&self) -> &[Vec<Word<'a>>] {
        &self.lines
    }

    fn iter(&self) -> impl Iterator<Item = Word<'a>> {
        self.lines.iter().flatten().copied()
    }
}

/// Citations in the database carry HTML tags; provenance is plain text.
fn plain_text(html: &str) -> String {
    let mut text = String::new();
    let mut rest = html;
    while let Some(start) = rest.find('<') {
        text.push_str(&rest[..start]);
        rest = rest[start..].split_once('>').map_or("", |(_, rest)| rest);
    }
    text.push_str(rest);
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "REFERENCES: \"<a href='https://doi.org/10.1/ab'>Doe</a>, 2001\"\nCOMMENTS: thick film\nDATA:\n  - type: tabulated nk\n    data: |\n        0.0517 1.5 0\n        0.4 1.6 1e-3\n\n        0.5 1.7 0.2\n";

    #[test]
    fn reads_a_table_in_exact_nm() {
        let ior = read(PAGE, "own.yml").unwrap();
        let Spectrum::Table(n) = &ior.n else { panic!("no table") };
        assert_eq!(n.wavelengths_nm(), [51.7, 400.0, 500.0]);
        assert_eq!(ior.at(400.0), (1.6, 1e-3));
        assert_eq!(ior.about.source.doi.as_deref(), Some("10.1/ab"));
        assert_eq!(ior.about.sample.description, "thick film");
        assert_eq!(ior.about.range_nm, Some((51.7, 500.0)));
    }

    #[test]
    fn reads_a_formula_and_a_k_table() {
        let page = "DATA:\n  - type: formula 5\n    wavelength_range: 0.35 0.8\n    coefficients: 1.5 0.004 -2\n  - type: tabulated k\n    data: |\n      0.4 1e-7\n      0.7 2e-7\n";
        let ior = read(page, "glass.yml").unwrap();
        assert!((ior.n.at(500.0) - (1.5 + 0.004 / 0.25)).abs() < 1e-12);
        assert_eq!(ior.about.range_nm, Some((400.0, 700.0)));
        assert_eq!(read_k(page, "glass.yml").unwrap().0.at(400.0), 1e-7);
        let one = "DATA:\n  - type: formula 5\n    range: 0.35 0.8\n    coefficients: 1.5\n";
        assert_eq!(read(one, "glass.yml").unwrap().n.at(500.0), 1.5);
    }

    #[test]
    fn errors_have_their_place() {
        let place = |page: &str| read(page, "own.yml").unwrap_err().in_file("own.yml", page).to_string();
        let bad = PAGE.replace("1.6 1e-3", "1.6 -1e-3");
        assert!(place(&bad).starts_with("own.yml:7:17: k is -0.001 at 400 nm"), "{}", place(&bad));
        let bad = PAGE.replace("0.5 1.7 0.2", "0.5 1.7");
        assert!(place(&bad).starts_with("own.yml:9:9: 2 numbers in a row"), "{}", place(&bad));
        let bad = PAGE.replace("tabulated nk", "tabulated mk");
        assert!(place(&bad).starts_with("own.yml:4:11: the type `tabulated mk`"), "{}", place(&bad));
        let bad = PAGE.replace("0.4 1.6", "0.4 soft");
        assert!(place(&bad).starts_with("own.yml:7:13: `soft`, expected a number"), "{}", place(&bad));
        assert!(place("DATA: [").starts_with("own.yml:1:"), "{}", place("DATA: ["));
        assert!(place("A: 1\n").contains("DATA"), "{}", place("A: 1\n"));
    }
}
