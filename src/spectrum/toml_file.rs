//! A data set of this project: one TOML file with its quantity, source, sample and numbers.
//!
//! ```toml
//! quantity = "ior"            # "reflectance", "absorption", "illuminant", "observer"
//! [source]                    # title, authors, journal?, year?, doi?, licence, origin
//! [sample]                    # description, method?, temperature_k?, thickness_nm?, confidence, remarks?
//! [table]                     # wavelength_nm with n, k? | value | x, y, z
//! [formula]                   # instead of a table of n: type, coefficients, range_nm
//! [k_table]                   # beside a formula: wavelength_nm, k
//! [absorption]                # unit = "1/m" | "1/cm" | "1/mm", base = "e" | "10"; then [table] or [[bands]]
//! [[bands]]                   # center_nm, fwhm_nm, peak, source
//! [[lines]]                   # illuminant, with or instead of a table: nm, power
//! ```

use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::Spanned;

use super::curve::common_range;
use super::error::Fault;
use super::noise::note_likely_um;
use super::table::{Bound, Number};
use super::{
    About, Band, Bands, ColorMatching, Dataset, Formula, FormulaType, Ior, Line, Outside, Quantity, Sample, Source,
    Spectrum, Table, nearest,
};

/// The content of a data file.
#[derive(Debug)]
pub(super) enum Loaded {
    Ior(Ior),
    Curve(Dataset),
    Observer(ColorMatching),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    quantity: Spanned<Quantity>,
    source: Source,
    sample: Sample,
    table: Option<Spanned<Columns>>,
    formula: Option<Spanned<FormulaKeys>>,
    k_table: Option<Columns>,
    absorption: Option<AbsorptionKeys>,
    bands: Option<Spanned<Vec<Band>>>,
    lines: Option<Spanned<Vec<LineKeys>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Columns {
    wavelength_nm: Vec<Spanned<f64>>,
    n: Option<Vec<Spanned<f64>>>,
    k: Option<Vec<Spanned<f64>>>,
    value: Option<Vec<Spanned<f64>>>,
    x: Option<Vec<Spanned<f64>>>,
    y: Option<Vec<Spanned<f64>>>,
    z: Option<Vec<Spanned<f64>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FormulaKeys {
    r#type: FormulaType,
    coefficients: Vec<f64>,
    range_nm: (f64, f64),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct AbsorptionKeys {
    unit: LengthUnit,
    base: Base,
}

#[derive(Clone, Copy, Deserialize)]
pub(super) enum LengthUnit {
    #[serde(rename = "1/m")]
    Metre,
    #[serde(rename = "1/cm")]
    Centimetre,
    #[serde(rename = "1/mm")]
    Millimetre,
}

impl LengthUnit {
    /// How many of it make one m⁻¹ … the factor to m⁻¹.
    pub fn per_metre(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Centimetre => 100.0,
            Self::Millimetre => 1000.0,
        }
    }
}

#[derive(Clone, Copy, Deserialize)]
enum Base {
    #[serde(rename = "e")]
    Natural,
    #[serde(rename = "10")]
    Decadic,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LineKeys {
    nm: f64,
    power: f64,
}

/// Reads a data set that should be of a quantity.
pub(super) fn read(text: &str, name: &str, expected: Quantity) -> Result<Loaded, Fault> {
    let file: File = parse(text)?;
    let quantity = *file.quantity.get_ref();
    if quantity != expected {
        let message = format!("this is a data set of `{quantity}`, expected one of `{expected}`");
        return Err(Fault::at(file.quantity.span().start, message));
    }
    file.check_sections(quantity)?;
    let (source, sample) = (file.source.clone(), file.sample.clone());
    let mut about = About { name: name.to_owned(), source, sample, ..About::default() };
    match quantity {
        Quantity::Ior => file.ior(about).map(Loaded::Ior),
        Quantity::Observer => file.observer(about).map(Loaded::Observer),
        Quantity::Reflectance => {
            let table = file.value_table("a reflectance", Bound::Fraction, Outside::Hold, &mut about.notes)?;
            Ok(curve(Spectrum::Table(table), about))
        }
        Quantity::Absorption => file.absorption(about),
        Quantity::Illuminant => file.illuminant(about),
    }
}

/// Parses TOML; an unknown key gets the place and the nearest known key.
pub(super) fn parse<T: DeserializeOwned>(text: &str) -> Result<T, Fault> {
    toml::from_str(text).map_err(|error: toml::de::Error| {
        let message = with_suggestion(error.message());
        error.span().map_or_else(|| Fault::new(&message), |span| Fault::at(span.start, &message))
    })
}

/// Serde says "unknown field `a`, expected one of `b`, `c`"; say which of them is meant.
fn with_suggestion(message: &str) -> String {
    let mut quoted = message.split('`').skip(1).step_by(2);
    let suggestion = match (message.starts_with("unknown "), quoted.next()) {
        (true, Some(found)) => nearest(found, quoted),
        _ => None,
    };
    match suggestion {
        Some(name) => format!("{message}; did you mean `{name}`?"),
        None => message.to_owned(),
    }
}

fn curve(spectrum: Spectrum, about: About) -> Loaded {
    let about = About { range_nm: spectrum.range_nm(), ..about };
    Loaded::Curve(Dataset { spectrum, about })
}

fn numbers(values: &[Spanned<f64>]) -> Vec<Number> {
    values.iter().map(|value| Number { value: *value.get_ref(), offset: value.span().start }).collect()
}

impl Columns {
    fn table(
        &self,
        what: &str,
        values: &Option<Vec<Spanned<f64>>>,
        bound: Bound,
        outside: Outside,
        notes: &mut Vec<String>,
    ) -> Result<Table, Fault> {
        let values =
            values.as_ref().ok_or_else(|| Fault::new(format!("the table has no {what}, expected a list of it")))?;
        let nm = numbers(&self.wavelength_nm);
        note_likely_um(&nm, "wavelength_nm", notes);
        Table::from_numbers(&nm, &numbers(values), what, bound, outside, notes)
    }
}

impl File {
    /// Refuses sections that this quantity does not read, so that nothing in a file is silently ignored.
    fn check_sections(&self, quantity: Quantity) -> Result<(), Fault> {
        let ior = quantity == Quantity::Ior;
        let absorption = quantity == Quantity::Absorption;
        let sections = [
            ("formula", self.formula.is_some(), ior),
            ("k_table", self.k_table.is_some(), ior && self.formula.is_some()),
            ("absorption", self.absorption.is_some(), absorption),
            ("bands", self.bands.is_some(), absorption),
            ("lines", self.lines.is_some(), quantity == Quantity::Illuminant),
        ];
        if let Some((name, ..)) = sections.iter().find(|(_, present, allowed)| *present && !allowed) {
            return Err(Fault::new(format!("`{name}` has no meaning in this data set of `{quantity}`")));
        }
        if let Some(table) = &self.table {
            let columns = table.get_ref();
            let xyz = quantity == Quantity::Observer;
            let present = [
                ("n", columns.n.is_some(), ior),
                ("k", columns.k.is_some(), ior),
                ("value", columns.value.is_some(), !ior && !xyz),
                ("x", columns.x.is_some(), xyz),
                ("y", columns.y.is_some(), xyz),
                ("z", columns.z.is_some(), xyz),
            ];
            if let Some((name, ..)) = present.iter().find(|(_, present, allowed)| *present && !allowed) {
                let message = format!("a table of `{quantity}` has no column `{name}`");
                return Err(Fault::at(table.span().start, message));
            }
        }
        let alternatives = [self.table.is_some(), self.formula.is_some(), self.bands.is_some()];
        match alternatives.iter().filter(|&&present| present).count() {
            0 if self.lines.is_none() => Err(Fault::new("there are no numbers, expected a [table]")),
            0 | 1 => Ok(()),
            _ => Err(Fault::new("there are two descriptions, expected one of [table], [formula] and [[bands]]")),
        }
    }

    fn value_table(&self, what: &str, bound: Bound, outside: Outside, notes: &mut Vec<String>) -> Result<Table, Fault> {
        let table = self.table.as_ref().ok_or_else(|| Fault::new("there are no numbers, expected a [table]"))?;
        let columns = table.get_ref();
        if columns.value.is_none() {
            return Err(Fault::at(table.span().start, "the table has no `value`, expected a list of it"));
        }
        columns.table(what, &columns.value, bound, outside, notes)
    }

    fn ior(self, mut about: About) -> Result<Ior, Fault> {
        let (n, k) = match (&self.formula, &self.table) {
            (Some(formula), _) => {
                let place = formula.span().start;
                let FormulaKeys { r#type, coefficients, range_nm } = formula.get_ref();
                let n = Formula::new(*r#type, coefficients.clone(), *range_nm).map_err(|fault| fault.or_at(place))?;
                (Spectrum::Formula(n), self.k_table.as_ref())
            }
            (None, Some(table)) => {
                let columns = table.get_ref();
                let n = columns
                    .table("n", &columns.n, Bound::Positive, Outside::Hold, &mut about.notes)
                    .map_err(|fault| fault.or_at(table.span().start))?;
                (Spectrum::Table(n), columns.k.is_some().then_some(columns))
            }
            (None, None) => return Err(Fault::new("there are no numbers, expected a [table] or a [formula]")),
        };
        let k = match k {
            Some(columns) => {
                Spectrum::Table(columns.table("k", &columns.k, Bound::NonNegative, Outside::Hold, &mut about.notes)?)
            }
            None => Spectrum::Constant(0.0),
        };
        let range_nm = [n.range_nm(), k.range_nm()].into_iter().flatten().reduce(common_range);
        Ok(Ior { n, k, about: About { range_nm, ..about } })
    }

    fn observer(self, mut about: About) -> Result<ColorMatching, Fault> {
        let table = self.table.as_ref().ok_or_else(|| Fault::new("there are no numbers, expected a [table]"))?;
        let columns = table.get_ref();
        let mut part = |what, values| {
            columns
                .table(what, values, Bound::Any, Outside::Zero, &mut about.notes)
                .map_err(|fault| fault.or_at(table.span().start))
        };
        let (x, y, z) = (part("x", &columns.x)?, part("y", &columns.y)?, part("z", &columns.z)?);
        let about = About { range_nm: y.range_nm(), ..about };
        Ok(ColorMatching { x, y, z, about })
    }

    fn absorption(self, mut about: About) -> Result<Loaded, Fault> {
        let Some(AbsorptionKeys { unit, base }) = &self.absorption else {
            return Err(Fault::new(
                "there is no [absorption], expected one with unit = \"1/m\", \"1/cm\" or \"1/mm\" and base = \"e\" or \"10\"",
            ));
        };
        let base = match base {
            Base::Natural => 1.0,
            Base::Decadic => std::f64::consts::LN_10,
        };
        let factor = unit.per_metre() * base;
        let spectrum = match &self.bands {
            Some(bands) => {
                let place = bands.span().start;
                let bands = Bands::new(bands.get_ref().clone()).map_err(|fault| fault.or_at(place))?;
                Spectrum::Bands(bands.scaled(factor))
            }
            None => {
                let table =
                    self.value_table("an absorption coefficient", Bound::NonNegative, Outside::Hold, &mut about.notes)?;
                Spectrum::Table(table.map(|value| value * factor))
            }
        };
        Ok(curve(spectrum, about))
    }

    fn illuminant(self, mut about: About) -> Result<Loaded, Fault> {
        let table = match &self.table {
            Some(_) => {
                let table = self.value_table("a spectral power", Bound::Power, Outside::Zero, &mut about.notes)?;
                Some(Spectrum::Table(table))
            }
            None => None,
        };
        let lines = match &self.lines {
            Some(lines) => {
                let place = lines.span().start;
                Some(Spectrum::Lines(read_lines(lines.get_ref()).map_err(|fault| fault.or_at(place))?))
            }
            None => None,
        };
        let spectrum = match (table, lines) {
            (Some(one), None) | (None, Some(one)) => one,
            (table, lines) => Spectrum::Sum(table.into_iter().chain(lines).collect()),
        };
        Ok(curve(spectrum, about))
    }
}

fn read_lines(lines: &[LineKeys]) -> Result<Vec<Line>, Fault> {
    let read = |keys: &LineKeys| {
        let LineKeys { nm, power } = *keys;
        if nm > 0.0 && nm.is_finite() && power >= 0.0 && power.is_finite() {
            return Ok(Line { nm, power });
        }
        let message =
            format!("a line of power {power} at {nm} nm, expected a positive wavelength and a power of 0 or more");
        Err(Fault::new(message))
    };
    lines.iter().map(read).collect()
}
