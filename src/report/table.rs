//! Tables of others, in CSV: columns by their names, rows with their lines, and in words what is wrong.
//!
//! Lines that start with `#` are comments; the first line that is none names the columns.

use crate::spectrum::nearest;
use csv::{ErrorKind, Position, Reader, ReaderBuilder, StringRecord, Trim};

/// What is wrong with a table, and in which line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{message}", line.map_or_else(String::new, |line| format!("line {line}: ")))]
pub struct TableError {
    /// From 1; `None` for the table as a whole.
    pub line: Option<u64>,
    pub message: String,
}

/// A table whose header is read.
pub struct Table<'a> {
    pub header: StringRecord,
    reader: Reader<&'a [u8]>,
    text: &'a [u8],
}

impl<'a> Table<'a> {
    pub fn new(text: &'a [u8]) -> Result<Self, TableError> {
        let mut reader = ReaderBuilder::new().comment(Some(b'#')).trim(Trim::All).from_reader(text);
        let header = reader.headers().map_err(|error| unreadable(text, &error))?.clone();
        Ok(Self { header, reader, text })
    }

    /// The rows after the header, each with its line.
    pub fn rows(&mut self) -> impl Iterator<Item = Result<(u64, StringRecord), TableError>> {
        let text = self.text;
        self.reader.records().map(move |record| {
            let record = record.map_err(|error| unreadable(text, &error))?;
            let line = record.position().map_or(0, |position| line(text, position));
            Ok((line, record))
        })
    }

    /// Where a column stands that goes by any of these names, in whatever case.
    pub fn column(&self, names: &[&str]) -> Option<usize> {
        let plain = |header: &str| names.contains(&header.to_lowercase().as_str());
        let exact = self.header.iter().position(|header| names.contains(&header));
        exact.or_else(|| self.header.iter().position(plain))
    }

    /// The same for columns that must be there; errors tell the first of each one's names.
    pub fn columns<const N: usize>(&self, wanted: [&[&str]; N]) -> Result<[usize; N], TableError> {
        let mut places = [0; N];
        let mut missing = Vec::new();
        let free = |header: &&str| !wanted.concat().contains(&header.to_lowercase().as_str());
        for (place, names) in places.iter_mut().zip(wanted) {
            match self.column(names) {
                Some(column) => *place = column,
                None => missing.push(told(names[0], self.header.iter().filter(free))),
            }
        }
        match missing.is_empty() {
            true => Ok(places),
            false => Err(TableError { line: None, message: format!("the table has no column {}", missing.join(", ")) }),
        }
    }
}

/// A missing column, and the one that it may be. A single letter is like too many.
fn told<'a>(name: &str, headers: impl Iterator<Item = &'a str>) -> String {
    let near = if name.len() > 1 { nearest(name, headers) } else { None };
    near.map_or_else(|| format!("`{name}`"), |header| format!("`{name}` (is it `{header}`?)"))
}

/// The number in a column of this name.
pub fn number(name: &str, text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| format!("`{name}` is \"{text}\", expected a number"))
}

/// The line of a record, from 1: its position is that of the comments and the empty lines before it.
fn line(text: &[u8], position: &Position) -> u64 {
    let rest = text.get(position.byte() as usize..).unwrap_or_default();
    let skipped = |line: &&[u8]| matches!(*line, [] | b"\r") || line.starts_with(b"#");
    position.line() + rest.split(|byte| *byte == b'\n').take_while(skipped).count() as u64
}

fn unreadable(text: &[u8], error: &csv::Error) -> TableError {
    let message = match error.kind() {
        ErrorKind::UnequalLengths { expected_len, len, .. } => format!("{len} columns, expected {expected_len}"),
        ErrorKind::Utf8 { .. } => "this is no text in UTF-8".into(),
        _ => error.to_string(),
    };
    TableError { line: error.position().map(|position| line(text, position)), message }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<u64> {
        let mut table = Table::new(text.as_bytes()).unwrap();
        table.rows().map(|row| row.map_or_else(|error| error.line.unwrap(), |(line, _)| line)).collect()
    }

    #[test]
    fn lines_are_those_of_an_editor() {
        assert_eq!(lines("a,b\n1,2\n3,4\n"), [2, 3]);
        assert_eq!(lines("# x\n#\na,b\n# y\n\n1,2\n# z\n3,4"), [6, 8]);
        assert_eq!(lines("a,b\r\n# x\r\n\r\n1,2\r\n3,4\r\n"), [4, 5]);
        assert_eq!(lines("a,b\n\"1\n\",2\n# x\n3,4\n"), [2, 5]);
        // Of a row that is too short, too.
        assert_eq!(lines("a,b\n# x\n1,2\n# y\n3\n"), [3, 5]);
    }

    #[test]
    fn columns_are_found_by_any_of_their_names() {
        let table = Table::new(b"N, n ,Kappa,coss\n").unwrap();
        assert_eq!(table.columns([&["n"], &["k", "kappa"]]), Ok([1, 2]));
        let missing = table.columns([&["n"], &["cos"], &["x"]]).unwrap_err();
        assert_eq!(missing.to_string(), "the table has no column `cos` (is it `coss`?), `x`");
    }
}
