//! A text file as columns of measured values over wavelengths in nm: its header, its units, its
//! rows.
//!
//! A header is a row of words, perhaps with a row of units below it, or the last comment before the
//! numbers; titles above are passed over. A second header further down starts a second table, as in
//! the files that refractiveindex.info exports.

use super::error::Fault;
use super::noise::note_likely_um;
use super::rows::Rows;
use super::table::{Bound, Number, Outside, Table};
use super::wave_unit::WaveUnit;
use super::words::Word;
use super::{LAMBDA_MAX_NM, LAMBDA_MIN_NM};

/// A column of values with the wavelengths it was measured at.
pub(super) struct Column {
    /// As in the header, in lower case; empty without one.
    pub name: String,
    pub nm: Vec<Number>,
    pub values: Vec<Number>,
    /// Where the header names it, bytes from the start.
    pub offset: usize,
}

/// What a file holds.
pub(super) struct Columns<'a> {
    pub columns: Vec<Column>,
    pub comments: Vec<Word<'a>>,
    pub notes: Vec<String>,
}

const EXAMPLE: &str = "a first line such as `wavelength_nm,n,k`";

impl Column {
    /// The name without its unit: `Refractive_index (-)` is "refractive index".
    pub fn plain(&self) -> String {
        let name = self.name.split(['(', '[', '%', '/']).next().unwrap_or_default();
        name.replace('_', " ").trim().to_owned()
    }

    pub fn table(&self, what: &str, bound: Bound, outside: Outside, notes: &mut Vec<String>) -> Result<Table, Fault> {
        Table::from_numbers(&self.nm, &self.values, what, bound, outside, notes)
            .map_err(|fault| fault.or_at(self.offset))
    }
}

/// A table of the file: its header's rows, and its numbers.
#[derive(Default)]
struct Block<'a> {
    head: Vec<&'a [Word<'a>]>,
    data: Vec<&'a [Word<'a>]>,
}

impl<'a> Columns<'a> {
    pub fn of(text: &'a str) -> Result<Self, Fault> {
        let Rows { rows, comments, separator } = Rows::of(text);
        let mut read = Columns { columns: Vec::new(), comments, notes: Vec::new() };
        let blocks = blocks(&rows)?;
        for (number, block) in blocks.iter().enumerate() {
            let count = block.data.first().map_or(0, |row| row.len());
            let first = block.data.first().and_then(|row| row.first()).map_or(0, |word| word.offset);
            // Words of a comment count as a header where there is no other and they name each
            // column.
            let comment = read.comments.iter().rfind(|comment| comment.offset < first).filter(|_| number == 0).copied();
            let comment = comment.map(|line| separator.words(line.text, line.offset)).unwrap_or_default();
            let header = match Header::of(&block.head, count) {
                Some(header) => header,
                None if comment.len() == count && WaveUnit::stated(comment[0].text).is_some() => {
                    Header { names: comment, units: &[] }
                }
                None => Header { names: Vec::new(), units: &[] },
            };
            block.read_into(&header, &mut read)?;
        }
        if read.columns.is_empty() {
            let message = format!("the file is empty, expected {EXAMPLE} and rows of numbers");
            return Err(Fault::new(message));
        }
        Ok(read)
    }
}

/// Parts rows into tables: words that are no numbers start the next one.
fn blocks<'a>(rows: &'a [Vec<Word<'a>>]) -> Result<Vec<Block<'a>>, Fault> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut head: Vec<&[Word]> = Vec::new();
    for row in rows {
        if is_words(row) || (blocks.is_empty() && !row[0].is_number()) {
            head.push(row);
            continue;
        }
        match blocks.last_mut() {
            Some(block) if head.is_empty() => block.data.push(row),
            _ => blocks.push(Block { head: std::mem::take(&mut head), data: vec![row] }),
        }
    }
    // Words after the last number are a remark, but for what looks like a row that went wrong.
    let last = blocks.last().and_then(|block| block.data.last()).map_or(0, |row| row.len());
    let went_wrong =
        |row: &[Word]| row.len() == last && row.iter().any(|word| word.text.contains(|c: char| c.is_ascii_digit()));
    match head.iter().find(|row| blocks.is_empty() || went_wrong(row)) {
        Some(row) if blocks.is_empty() => {
            Err(Fault::at(row[0].offset, format!("no numbers in the file, expected {EXAMPLE} and rows of numbers")))
        }
        Some(row) if WaveUnit::stated(row[0].text).is_none() => Err(row[0].no_number()),
        _ => Ok(blocks),
    }
}

fn is_words(row: &[Word]) -> bool {
    row.iter().all(|word| !word.is_number())
}

/// The names of the columns, and units that stand in a row of their own.
struct Header<'a> {
    names: Vec<Word<'a>>,
    units: &'a [Word<'a>],
}

impl<'a> Header<'a> {
    /// From the rows of words above `count` columns of numbers; `None` if they are a title only.
    fn of(head: &[&'a [Word<'a>]], count: usize) -> Option<Self> {
        let (&last, above) = head.split_last()?;
        let fits = |row: &[Word]| row.len() == count || WaveUnit::stated(row[0].text).is_some();
        if last.iter().all(|word| is_unit(word.text)) {
            let names = above.last().filter(|row| fits(row)).map(|row| row.to_vec()).unwrap_or_default();
            return Some(Self { names, units: last });
        }
        fits(last).then(|| Self { names: last.to_vec(), units: &[] })
    }

    fn wave_unit(&self) -> Option<WaveUnit> {
        let of = |words: &[Word]| words.first().and_then(|word| WaveUnit::stated(word.text));
        of(&self.names).or_else(|| of(self.units))
    }

    /// The name of a column with its unit.
    fn name(&self, column: usize) -> String {
        let word = |words: &[Word]| words.get(column).map_or("", |word| word.text).to_lowercase();
        let (name, unit) = (word(&self.names), word(self.units));
        let unit = unit.trim_matches(['(', ')', '[', ']']);
        if unit.is_empty() || unit == "-" { name } else { format!("{name} ({unit})") }
    }
}

/// Whether a word is a unit and no name.
fn is_unit(word: &str) -> bool {
    let bracketed = word.starts_with(['(', '[']) && word.ends_with([')', ']']);
    let known = ["", "-", "nm", "µm", "μm", "um", "ev", "å", "a.u.", "%", "1", "1/cm", "1/mm", "1/m", "cm-1", "cm^-1"];
    bracketed || known.contains(&word.to_lowercase().as_str())
}

impl<'a> Block<'a> {
    fn read_into(&self, header: &Header, read: &mut Columns) -> Result<(), Fault> {
        let waves: Vec<Word> = self.data.iter().map(|row| row[0]).collect();
        let count = if header.names.is_empty() { self.data[0].len() } else { header.names.len() };
        let stated = header.wave_unit();
        let unit = stated.or_else(|| WaveUnit::told(&waves)).ok_or_else(|| no_unit(header, waves[0]))?;
        if stated.is_none() {
            let why = format!("no unit of wavelength is stated: by their numbers they are {}", unit.symbol());
            read.notes.push(why);
        }
        let nm: Vec<Number> = waves.iter().map(|word| unit.nm(*word)).collect::<Result<_, _>>()?;
        let offset = |column: usize| header.names.get(column).map_or(waves[0].offset, |word| word.offset);
        let mut columns: Vec<Column> = (1..count)
            .map(|column| Column {
                name: header.name(column),
                nm: nm.clone(),
                values: Vec::with_capacity(nm.len()),
                offset: offset(column),
            })
            .collect();
        for row in &self.data {
            if row.len() != count {
                let as_there = if header.names.is_empty() { "the first row" } else { "the header" };
                let message = format!("{} columns, expected {count} as in {as_there}", row.len());
                return Err(Fault::at(row[0].offset, message));
            }
            for (column, word) in columns.iter_mut().zip(&row[1..]) {
                column.values.push(word.number()?);
            }
        }
        self.doubt_unit(header, stated, &nm, read)?;
        read.columns.append(&mut columns);
        Ok(())
    }

    /// Tells numbers that are hardly of the unit that the header states.
    fn doubt_unit(
        &self,
        header: &Header,
        stated: Option<WaveUnit>,
        nm: &[Number],
        read: &mut Columns,
    ) -> Result<(), Fault> {
        match (stated, nm.first()) {
            // Nobody's table starts beyond 100 µm: these are nm under a header that says µm, or
            // `wl` which is µm by custom.
            (Some(WaveUnit::Micrometre), Some(first)) if first.value > 1e5 => {
                let message =
                    format!("a wavelength of {} µm; if it is in nm, say `wavelength_nm`", first.value / 1000.0);
                Err(Fault::at(first.offset, message))
            }
            (Some(WaveUnit::Nanometre), _) => {
                let name = header.names.first().map_or("wavelength", |word| word.text);
                note_likely_um(nm, name, &mut read.notes);
                Ok(())
            }
            (
                Some(unit @ (WaveUnit::Metre | WaveUnit::Angstrom | WaveUnit::ElectronVolt | WaveUnit::PerCentimetre)),
                Some(first),
            ) if !nm.iter().any(|nm| (LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(&nm.value)) => {
                let message = format!(
                    "by the unit {} of the header no wavelength is visible: {} nm is the first",
                    unit.symbol(),
                    first.value
                );
                Err(Fault::at(first.offset, message))
            }
            _ => Ok(()),
        }
    }
}

fn no_unit(header: &Header, first: Word) -> Fault {
    match header.names.first() {
        Some(name) => {
            let message = format!(
                "the first column `{}` states no unit of wavelength, expected `wavelength_nm` or `wavelength_um`",
                name.text
            );
            Fault::at(name.offset, message)
        }
        None => {
            let message =
                format!("numbers without a header, and by them the unit of wavelength is not sure: expected {EXAMPLE}");
            Fault::at(first.offset, message)
        }
    }
}
