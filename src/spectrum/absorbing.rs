//! What a column says about absorption: a coefficient, absorbance, transmittance or k, made m⁻¹ of
//! natural base.
//!
//! α = A ln 10 / d of a decadic absorbance A, α = −ln T / d of an internal transmittance T, through
//! a thickness d (Beer and Lambert); α = 4πk/λ of an extinction coefficient.

use super::columns::{Column, Columns};
use super::error::Fault;
use super::table::{Bound, Number, Outside};
use super::{Spectrum, Table};

/// What is measured of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// Per length, natural base.
    Coefficient,
    /// Decadic.
    Absorbance,
    /// 0…1.
    Transmittance,
    Extinction,
}

/// Units of length with their metres; longer names before those that they end in.
const LENGTHS: [(&str, f64); 8] =
    [("µm", 1e-6), ("μm", 1e-6), ("um", 1e-6), ("nm", 1e-9), ("mm", 1e-3), ("cm", 1e-2), ("dm", 1e-1), ("m", 1.0)];

/// The absorption coefficient that a file states, and the wavelengths that it was measured at, nm.
pub(super) fn coefficient(file: &mut Columns) -> Result<(Spectrum, Option<(f64, f64)>), Fault> {
    let index = file.columns.iter().position(|column| column.name == "n");
    if let (Some(index), true) = (index, file.columns.len() > 1) {
        file.columns.remove(index);
    }
    let [column] = file.columns.as_slice() else {
        return Err(Fault::at(0, format!("{} columns of values, expected one", file.columns.len())));
    };
    if is_scaled(&column.name) {
        return Err(no_unit(column));
    }
    let kind = kind(column);
    let notes = &mut file.notes;
    let table = match (kind, per_length(&column.name)) {
        (Kind::Extinction, _) => {
            let k = column.table("k", Bound::NonNegative, Outside::Hold, notes)?;
            let range = k.range_nm();
            return Ok((Spectrum::Table(k).absorption_from_k(), range));
        }
        (Kind::Transmittance, _) => {
            let metres = thickness(column, file.comments.iter().map(|line| line.text))?;
            let table = as_share(column).table("a transmittance", Bound::Transmittance, Outside::Hold, notes)?;
            notes.push(format!("`{}` is taken for internal transmittance, without losses at surfaces", column.name));
            table.map(|value| -libm::log(value) / metres)
        }
        (Kind::Absorbance, per_length) => {
            let metres = match per_length {
                Some(metres) => metres,
                None => thickness(column, file.comments.iter().map(|line| line.text))?,
            };
            let table = column.table("an absorbance", Bound::NonNegative, Outside::Hold, notes)?;
            table.map(|value| value * std::f64::consts::LN_10 / metres)
        }
        (Kind::Coefficient, Some(metres)) => {
            let table = column.table("an absorption coefficient", Bound::NonNegative, Outside::Hold, notes)?;
            table.map(|value| value / metres)
        }
        (Kind::Coefficient, None) => return Err(no_unit(column)),
    };
    let range = table.range_nm();
    Ok((Spectrum::Table(table), range))
}

/// Whether a name speaks of decibels, concentrations, logarithms or powers of ten, which no unit of length tells.
fn is_scaled(name: &str) -> bool {
    let mut words = name.split(|c: char| !c.is_alphanumeric());
    let plain = name.replace([' ', '^'], "").replace("⁻¹", "-1").replace('−', "-");
    words.any(|word| ["db", "log", "log10", "lg", "ln"].contains(&word) || word.starts_with("mol") || word == "molar")
        || ["10^", "×10", "x10^", "10**"].iter().any(|form| name.contains(form))
        || plain.contains("m-1/m")
}

fn no_unit(column: &Column) -> Fault {
    let name = if column.name.is_empty() { "of values".to_owned() } else { format!("`{}`", column.name) };
    let message = format!(
        "the column {name} states no unit, expected `alpha_1/m`, `alpha_1/cm` or `alpha_1/mm` (natural base), \
         `absorbance_1/cm` or `absorbance (10 mm)` (decadic), nothing molar, in dB or times a power of ten, `transmittance (10 mm)`, or `k`"
    );
    Fault::at(column.offset, message)
}

fn kind(column: &Column) -> Kind {
    let name = column.name.as_str();
    let plain = column.plain();
    let first = plain.split(' ').next().unwrap_or_default();
    let is = |words: &[&str]| words.iter().any(|word| name.contains(word));
    match () {
        () if is(&["absorbance", "optical density", "decadic"]) => Kind::Absorbance,
        () if is(&["transmi"]) || first == "t" => Kind::Transmittance,
        // With a unit of length below the line, these letters are coefficients in many papers.
        () if per_length(name).is_some() => Kind::Coefficient,
        () if ["a", "od"].contains(&first) => Kind::Absorbance,
        () if ["k", "kappa"].contains(&first) || is(&["extinction coefficient"]) => Kind::Extinction,
        () => Kind::Coefficient,
    }
}

/// The metres of the unit of "1/cm", "cm^-1", "per mm" and the like, if a name states one.
fn per_length(name: &str) -> Option<f64> {
    let plain = name.replace([' ', '^', '*', '(', ')', '[', ']', '{', '}'], "").replace("⁻¹", "-1").replace('−', "-");
    let words: Vec<&str> = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let states = |unit: &str| {
        [format!("/{unit}"), format!("{unit}-1")].iter().any(|form| plain.contains(form.as_str()))
            || words.array_windows().any(|[per, of]| *per == "per" && *of == unit)
    };
    LENGTHS.iter().find(|(unit, _)| states(unit)).map(|(_, metres)| *metres)
}

/// The thickness that a column's name or a comment states, m.
fn thickness<'a>(column: &Column, comments: impl Iterator<Item = &'a str>) -> Result<f64, Fault> {
    let stating = comments.map(str::to_lowercase).filter(|line| line.contains("thick") || line.contains("path"));
    let found = length(&column.name).or_else(|| stating.into_iter().find_map(|line| length(&line)));
    found.ok_or_else(|| {
        let message = format!(
            "the column `{}` needs the thickness it was measured through, such as `transmittance (10 mm)`",
            column.name
        );
        Fault::at(column.offset, message)
    })
}

/// The first number with a unit of length in a text, m.
fn length(text: &str) -> Option<f64> {
    let starts = text.char_indices().filter(|(_, letter)| letter.is_ascii_digit() || *letter == '.').map(|(at, _)| at);
    starts.into_iter().find_map(|at| {
        let rest = &text[at..];
        let end = rest.find(|letter: char| !(letter.is_ascii_digit() || ['.', ','].contains(&letter)))?;
        let number: f64 = rest[..end].replace(',', ".").parse().ok()?;
        let word: String =
            rest[end..].trim_start_matches([' ', '_']).chars().take_while(|c| c.is_alphabetic()).collect();
        let (_, metres) = LENGTHS.iter().find(|(unit, _)| *unit == word)?;
        Some(number * metres).filter(|metres| *metres > 0.0)
    })
}

/// A column of shares, whose name may say that they are in percent.
pub(super) fn as_share(column: &Column) -> Column {
    let whole = if column.name.contains('%') { 100.0 } else { 1.0 };
    let values = column.values.iter().map(|number| Number { value: number.value / whole, ..*number }).collect();
    Column { name: column.name.clone(), nm: column.nm.clone(), values, offset: column.offset }
}

/// The k that an internal transmittance through a thickness means: −ln T λ / (4π d).
pub(super) fn k_of_transmittance(table: &Table, metres: impl Fn(f64) -> f64) -> Table {
    let points: Vec<_> = (table.wavelengths_nm().iter().zip(table.values()))
        .map(|(&nm, &value)| (nm, -libm::log(value) * nm * 1e-9 / (4.0 * std::f64::consts::PI * metres(nm))))
        .collect();
    Table::from_points(&points, Outside::Hold)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The coefficient at 500 nm of a file with one column of two equal values.
    fn alpha(header: &str, value: &str) -> Result<f64, String> {
        let text = format!("{header}\n400;{value}\n600;{value}\n");
        let mut file = Columns::of(&text).map_err(|fault| fault.message)?;
        coefficient(&mut file)
            .map(|(spectrum, range)| {
                assert_eq!(range, Some((400.0, 600.0)));
                spectrum.at(500.0)
            })
            .map_err(|fault| fault.message)
    }

    #[test]
    fn every_way_to_state_absorption_is_the_same_coefficient() {
        let ln_10 = std::f64::consts::LN_10;
        for (header, value, expected) in [
            ("wavelength_nm;alpha_1/cm", "2", 200.0),
            ("wavelength_nm;alpha (cm^-1)", "2", 200.0),
            ("wavelength_nm;Absorption coefficient [cm⁻¹]", "2", 200.0),
            ("wavelength_nm;1/cm", "2", 200.0),
            ("nm;cm-1", "2", 200.0),
            ("wavelength_nm;alpha (1/mm)", "2", 2000.0),
            ("wavelength_nm;alpha (1/µm)", "2e-6", 2.0),
            ("wavelength_nm;alpha_1/m", "2", 2.0),
            ("wavelength_nm;absorbance (1/cm)", "2", 200.0 * ln_10),
            ("wavelength_nm;Absorbance (10 mm)", "2", 200.0 * ln_10),
            ("wavelength_nm;A_10mm", "2", 200.0 * ln_10),
            ("# path length: 1 cm\nwavelength_nm;absorbance", "2", 200.0 * ln_10),
            ("wavelength_nm;transmittance (10 mm)", "0,5", 100.0 * std::f64::consts::LN_2),
            ("wavelength_nm;T_10mm (%)", "50", 100.0 * std::f64::consts::LN_2),
            ("# thickness = 5 mm\nwavelength_nm;internal transmittance", "0.5", 200.0 * std::f64::consts::LN_2),
        ] {
            let found = alpha(header, value).unwrap_or_else(|message| panic!("{header}: {message}"));
            assert!((found / expected - 1.0).abs() < 1e-14, "{header}: {found} for {expected}");
        }
        let k = alpha("wavelength_nm;k", "1e-6").unwrap();
        assert!((k - 4.0 * std::f64::consts::PI * 1e-6 / 500e-9).abs() < 1e-9);
    }

    #[test]
    fn what_lacks_a_unit_or_a_thickness_is_told() {
        for header in [
            "alpha",
            "attenuation (dB/m)",
            "alpha (10^4 cm^-1)",
            "molar extinction (cm-1/M)",
            "eps (L/mol/cm)",
            "log10(alpha) (1/cm)",
            "permeability",
        ] {
            let message = alpha(&format!("wavelength_nm;{header}"), "1").unwrap_err();
            assert!(message.contains("states no unit"), "{header}: {message}");
        }
        assert_eq!(alpha("wavelength_nm;alpha per cm", "1"), Ok(100.0));
        assert!(alpha("wavelength_nm;transmittance", "1").unwrap_err().contains("needs the thickness"));
        assert!(alpha("wavelength_nm;absorbance", "1").unwrap_err().contains("needs the thickness"));
        assert!(alpha("wavelength_nm;T (10 mm)", "0").unwrap_err().contains("a transmittance is 0"));
    }
}
