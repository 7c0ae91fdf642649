//! A table of a user: two or three columns of CSV, whose header names the columns and the unit of the wavelength.
//!
//! `wavelength_nm,n,k` or `wavelength_um,n` (an index), `wavelength_nm,value` (a reflectance or a light),
//! `wavelength_nm,alpha_1/cm` (an absorption, natural base). The separator is a comma, semicolon or tab; lines that start
//! with # are comments. The files that refractiveindex.info exports are read too: a header `wl,n` with µm, followed by
//! a second table `wl,k`.

use super::error::Fault;
use super::rii_page::Word;
use super::table::{Bound, Number};
use super::toml_file::LengthUnit;
use super::{About, Outside, Quantity, Sample, Source, Spectrum, Table};

/// A column of values with the wavelengths it was measured at.
struct Column {
    name: String,
    nm: Vec<Number>,
    values: Vec<Number>,
    /// Where the header names it, bytes from the start.
    offset: usize,
}

/// (n, k) of an index of refraction.
pub(super) fn read_ior(text: &str, name: &str) -> Result<(Spectrum, Spectrum, About), Fault> {
    let columns = columns(text)?;
    let n = find(&columns, &["n"])?.table("n", Bound::Positive, Outside::Hold)?;
    let k = match find(&columns, &["k"]) {
        Ok(k) => Spectrum::Table(k.table("k", Bound::NonNegative, Outside::Hold)?),
        Err(_) => Spectrum::Constant(0.0),
    };
    refuse_others(&columns, &["n", "k"])?;
    Ok((Spectrum::Table(n), k, about(name)))
}

/// A reflectance, an absorption coefficient (m⁻¹, natural base) or a light.
pub(super) fn read_curve(text: &str, name: &str, quantity: Quantity) -> Result<(Spectrum, About), Fault> {
    let columns = columns(text)?;
    let table = match quantity {
        Quantity::Absorption => {
            let [column] = columns.as_slice() else {
                return Err(Fault::at(0, format!("{} columns of values, expected one", columns.len())));
            };
            let unit = column.name.replace(' ', "");
            let unit = match unit {
                _ if unit.contains("1/mm") => LengthUnit::Millimetre,
                _ if unit.contains("1/cm") => LengthUnit::Centimetre,
                _ if unit.contains("1/m") => LengthUnit::Metre,
                _ => {
                    let message = format!(
                        "the column `{}` states no unit, expected `alpha_1/m`, `alpha_1/cm` or `alpha_1/mm` (natural base)",
                        column.name
                    );
                    return Err(Fault::at(column.offset, message));
                }
            };
            let table = column.table("an absorption coefficient", Bound::NonNegative, Outside::Hold)?;
            table.map(|value| value * unit.per_metre())
        }
        _ => {
            refuse_others(&columns, &["value", "r", "reflectance", "power"])?;
            let column = find(&columns, &["value", "r", "reflectance", "power"])?;
            match quantity {
                Quantity::Illuminant => column.table("a spectral power", Bound::NonNegative, Outside::Zero)?,
                _ => column.table("a reflectance", Bound::Fraction, Outside::Hold)?,
            }
        }
    };
    Ok((Spectrum::Table(table), about(name)))
}

fn about(name: &str) -> About {
    let source = Source { origin: name.to_owned(), ..Source::default() };
    About { name: name.to_owned(), source, sample: Sample::default(), range_nm: None }
}

impl Column {
    fn table(&self, what: &str, bound: Bound, outside: Outside) -> Result<Table, Fault> {
        Table::from_numbers(&self.nm, &self.values, what, bound, outside).map_err(|fault| fault.or_at(self.offset))
    }
}

fn find<'a>(columns: &'a [Column], names: &[&str]) -> Result<&'a Column, Fault> {
    columns
        .iter()
        .find(|column| names.contains(&column.name.as_str()))
        .ok_or_else(|| Fault::at(0, format!("no column `{}` in the header", names.first().unwrap_or(&""))))
}

fn refuse_others(columns: &[Column], names: &[&str]) -> Result<(), Fault> {
    match columns.iter().find(|column| !names.contains(&column.name.as_str())) {
        None => Ok(()),
        Some(column) => {
            let message = format!("the column `{}`, expected one of `{}`", column.name, names.join("`, `"));
            Err(Fault::at(column.offset, message))
        }
    }
}

/// The factor from the unit that the header of the wavelength column states.
fn is_in_um(header: Word) -> Result<bool, Fault> {
    let name = header.text.to_lowercase();
    let words: Vec<_> = name.split(|c: char| !c.is_alphanumeric()).collect();
    let states = |units: &[&str]| words.iter().any(|word| units.contains(word));
    // Both signs for micro: U+00B5 and the Greek letter, which is what lower case makes of either.
    match () {
        () if states(&["nm", "nanometre", "nanometer", "nanometres", "nanometers"]) => Ok(false),
        () if states(&["um", "µm", "μm", "micron", "microns", "micrometre", "micrometer"]) || name == "wl" => {
            Ok(true)
        }
        () => {
            let message = format!(
                "the first column `{}` states no unit of wavelength, expected `wavelength_nm` or `wavelength_um`",
                header.text
            );
            Err(Fault::at(header.offset, message))
        }
    }
}

fn columns(text: &str) -> Result<Vec<Column>, Fault> {
    let first_line = text.lines().find(|line| !line.starts_with('#') && !line.trim().is_empty()).unwrap_or_default();
    let delimiter = [b',', b';', b'\t'].into_iter().find(|&mark| first_line.contains(char::from(mark))).unwrap_or(b',');
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .delimiter(delimiter)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());

    let mut done: Vec<Column> = Vec::new();
    let mut block: Vec<Column> = Vec::new();
    let mut in_um = false;
    for record in reader.records() {
        let record = record.map_err(|error| match error.position() {
            Some(position) => Fault::at(position.byte() as usize, "this is not a row of text"),
            None => Fault::new(error),
        })?;
        let row = words(&record, text);
        let Some((&wavelength, values)) = row.split_first() else { continue };
        if row.iter().all(|word| word.text.is_empty()) {
            continue;
        }
        if wavelength.number().is_err() && values.iter().all(|word| word.number().is_err()) {
            in_um = is_in_um(wavelength)?;
            done.append(&mut block);
            block = values
                .iter()
                .map(|word| Column {
                    name: word.text.to_lowercase(),
                    nm: Vec::new(),
                    values: Vec::new(),
                    offset: word.offset,
                })
                .collect();
            continue;
        }
        if block.is_empty() {
            let message = "numbers without a header, expected a first line such as `wavelength_nm,n,k`";
            return Err(Fault::at(wavelength.offset, message));
        }
        if values.len() != block.len() {
            let message = format!("{} columns, expected {} as in the header", row.len(), block.len() + 1);
            return Err(Fault::at(wavelength.offset, message));
        }
        let nm = if in_um { wavelength.nm_from_um()? } else { wavelength.number()? };
        for (column, word) in block.iter_mut().zip(values) {
            column.nm.push(nm);
            column.values.push(word.number()?);
        }
    }
    done.append(&mut block);
    if done.is_empty() {
        return Err(Fault::new("the file is empty, expected a header such as `wavelength_nm,n,k` and rows of numbers"));
    }
    // Nobody's table starts beyond 100 µm: these are nm under a header that says µm, or `wl` which is µm by custom.
    let implausible = done.iter().filter_map(|column| column.nm.first()).find(|number| number.value > 1e5);
    if let Some(number) = implausible {
        let message = format!("a wavelength of {} µm; if it is in nm, say `wavelength_nm`", number.value / 1000.0);
        return Err(Fault::at(number.offset, message));
    }
    Ok(done)
}

/// The fields of a record with their places, found again in the text because `csv` tells only that of the record.
fn words<'a>(record: &'a csv::StringRecord, text: &str) -> Vec<Word<'a>> {
    let mut offset = record.position().map_or(0, |position| position.byte() as usize);
    record
        .iter()
        .map(|field| {
            let found = text.get(offset..).and_then(|rest| rest.find(field)).map(|place| offset + place);
            let at = found.unwrap_or(offset);
            offset = found.map_or(offset, |at| at + field.len());
            Word { text: field, offset: at }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_an_index_in_either_unit() {
        let (n, k, _) = read_ior("# gold\nwavelength_um,n,k\n0.0517,1.5,2\n0.6,0.2,3\n", "a.csv").unwrap();
        assert_eq!((n.at(600.0), k.at(600.0)), (0.2, 3.0));
        assert_eq!(n.range_nm(), Some((51.7, 600.0)));
        let (n, k, _) = read_ior("Wavelength (nm);n\r\n400;1.5\r\n700;1.6\r\n", "a.csv").unwrap();
        assert_eq!((n.at(550.0), k.at(550.0)), (1.55, 0.0));
        let (n, k, _) = read_ior("wl,n\n0.4,1.5\n0.7,1.6\n\nwl,k\n0.5,0.1\n", "a.csv").unwrap();
        assert_eq!((n.at(700.0), k.at(550.0)), (1.6, 0.1));
    }

    #[test]
    fn reads_curves() {
        let (light, _) = read_curve("wavelength_nm,value\n400,1\n500,2\n", "a.csv", Quantity::Illuminant).unwrap();
        assert_eq!((light.at(450.0), light.at(300.0)), (1.5, 0.0));
        let (alpha, _) = read_curve("wavelength_nm,alpha_1/cm\n400,1\n", "a.csv", Quantity::Absorption).unwrap();
        assert_eq!(alpha.at(500.0), 100.0);
    }

    #[test]
    fn errors_have_their_place() {
        let place = |text: &str| read_ior(text, "a.csv").unwrap_err().in_file("a.csv", text).to_string();
        let starts = |text: &str, start: &str| assert!(place(text).starts_with(start), "{}", place(text));
        starts("", "a.csv: the file is empty");
        starts("400,1,2\n", "a.csv:1:1: numbers without a header");
        starts("wavelength,n\n400,1\n", "a.csv:1:1: the first column `wavelength` states no unit");
        starts("wavelength_nm,n\n400,1\n500,1,2\n", "a.csv:3:1: 3 columns");
        starts("wavelength_nm,n\n400,1\n500,one\n", "a.csv:3:5: `one`");
        starts("wavelength_nm,n\n400,1\n500,-1\n", "a.csv:3:5: n is -1 at 500 nm");
        starts("wavelength_nm,n\n400,1\n400,1\n", "a.csv:3:1: the wavelength 400 nm follows");
        starts("wavelength_nm,m\n400,1\n", "a.csv:1:1: no column `n`");
        starts("wavelength_nm,n,q\n400,1,1\n", "a.csv:1:17: the column `q`");
        starts("wl,n\n400,1\n", "a.csv:2:1: a wavelength of 400 µm");
    }
}
