//! Reading someone else's table: CSV with a row for each material.
//!
//! The first line that is no comment names the columns; case, order and further columns do not matter:
//! `material` (or `name`, `metal`), `r`, `g`, `b` (or `red`, `green`, `blue`), `encoding` (or `space`, `curve`), and, if there is one, `table`
//! (or `source`, `engine`).

use super::check::{Claim, Encoding};
use crate::spectrum::nearest;
use csv::{ReaderBuilder, StringRecord, Trim};

/// What is wrong with a table, and in which line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{message}", line.map_or_else(String::new, |line| format!("line {line}: ")))]
pub struct ClaimsError {
    pub line: Option<u64>,
    pub message: String,
}

/// The names that a column goes by; the first is the one that errors tell.
const MATERIAL: &[&str] = &["material", "name", "metal"];
const RED: &[&str] = &["r", "red"];
const GREEN: &[&str] = &["g", "green"];
const BLUE: &[&str] = &["b", "blue"];
const ENCODING: &[&str] = &["encoding", "space", "curve"];
const TABLE: &[&str] = &["table", "source", "engine"];

/// No table of reflectances holds more; 8-bit values do.
const LARGEST: f64 = 2.0;

/// The rows of a table.
pub fn read(text: &[u8]) -> Result<Vec<Claim>, ClaimsError> {
    let mut reader = ReaderBuilder::new().comment(Some(b'#')).trim(Trim::All).from_reader(text);
    let headers = reader.headers().map_err(unreadable)?.clone();
    let columns = Columns::of(&headers).map_err(|message| ClaimsError { line: None, message })?;
    let claims = reader.records().map(|record| {
        let record = record.map_err(unreadable)?;
        let line = line(text, &record);
        columns.claim(&record, line).map_err(|message| ClaimsError { line: Some(line), message })
    });
    let claims = claims.collect::<Result<Vec<_>, _>>()?;
    match claims.is_empty() {
        true => Err(ClaimsError { line: None, message: "the table has no rows".into() }),
        false => Ok(claims),
    }
}

/// The line of a record, from 1: its position is that of the comments before it.
fn line(text: &[u8], record: &StringRecord) -> u64 {
    let start = record.position().map_or(0, |position| position.byte() as usize).min(text.len());
    let (before, rest) = text.split_at(start);
    let skipped = |line: &&[u8]| line.trim_ascii().is_empty() || line.starts_with(b"#");
    let comments = rest.split(|byte| *byte == b'\n').take_while(skipped).count();
    (before.iter().filter(|byte| **byte == b'\n').count() + comments + 1) as u64
}

fn unreadable(error: csv::Error) -> ClaimsError {
    ClaimsError { line: error.position().map(csv::Position::line), message: error.to_string() }
}

/// Where the values stand.
struct Columns {
    material: usize,
    rgb: [usize; 3],
    encoding: usize,
    table: Option<usize>,
}

impl Columns {
    fn of(headers: &StringRecord) -> Result<Self, String> {
        let found = [MATERIAL, RED, GREEN, BLUE, ENCODING].map(|names| (names[0], find(headers, names)));
        if let [(_, Some(material)), (_, Some(r)), (_, Some(g)), (_, Some(b)), (_, Some(encoding))] = found {
            return Ok(Self { material, rgb: [r, g, b], encoding, table: find(headers, TABLE) });
        }
        let missing = found.iter().filter(|(_, place)| place.is_none()).map(|(name, _)| told(name, headers));
        let missing: Vec<_> = missing.collect();
        Err(format!("the table has no column {}", missing.join(", ")))
    }

    fn claim(&self, record: &StringRecord, line: u64) -> Result<Claim, String> {
        let [r, g, b] = self.rgb;
        let material = record[self.material].to_owned();
        if material.is_empty() {
            return Err("`material` is empty".into());
        }
        Ok(Claim {
            table: self.table.map(|column| record[column].to_owned()).filter(|table| !table.is_empty()),
            material,
            rgb: [channel("r", &record[r])?, channel("g", &record[g])?, channel("b", &record[b])?],
            encoding: encoding(&record[self.encoding])?,
            line,
        })
    }
}

fn find(headers: &StringRecord, names: &[&str]) -> Option<usize> {
    headers.iter().position(|header| names.contains(&header.to_lowercase().as_str()))
}

fn told(name: &str, headers: &StringRecord) -> String {
    let near = if name.len() > 1 { nearest(name, headers.iter()) } else { None };
    near.map_or_else(|| format!("`{name}`"), |header| format!("`{name}` (is it `{header}`?)"))
}

fn channel(name: &str, text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| format!("`{name}` is \"{text}\", expected a number"))?;
    if value.abs() <= LARGEST {
        return Ok(value);
    }
    let hint = if (0.0..=255.0).contains(&value) { "; 8-bit values are to be divided by 255" } else { "" };
    Err(format!("`{name}` is {text}, expected a reflectance of about 0…1{hint}"))
}

fn encoding(text: &str) -> Result<Encoding, String> {
    match text.to_lowercase().as_str() {
        "linear" | "lin" => Ok(Encoding::Linear),
        "srgb" | "encoded" | "gamma" => Ok(Encoding::Encoded),
        _ => Err(format!("`encoding` is \"{text}\", expected `linear` or `sRGB`")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> String {
        read(text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn columns_are_found_by_any_of_their_names() {
        let text = "# a comment\n Engine , Name,RED,Green,b,space,note\nx, Gold ,1,0.85,0.57,SRGB,\"a, b\"\n";
        let claims = read(text.as_bytes()).unwrap();
        let claim = Claim {
            table: Some("x".into()),
            material: "Gold".into(),
            rgb: [1.0, 0.85, 0.57],
            encoding: Encoding::Encoded,
            line: 3,
        };
        assert_eq!(claims, [claim]);
        assert_eq!(read(b"material,r,g,b,encoding\nx,0,0,0,linear\n").unwrap()[0].table, None);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        assert_eq!(error("materiel,r,g\n"), "the table has no column `material` (is it `materiel`?), `b`, `encoding`");
        assert_eq!(error("material,r,g,b,encoding\n# x\na,1,x,0,linear\n"), "line 3: `g` is \"x\", expected a number");
        assert!(error("material,r,g,b,encoding\na,1,0,200,linear\n").starts_with("line 2: `b` is 200, expected"));
        assert!(error("material,r,g,b,encoding\na,1,0,nan,linear\n").starts_with("line 2: `b` is nan, expected"));
        assert!(error("material,r,g,b,encoding\na,1,0,0,cmyk\n").contains("expected `linear` or `sRGB`"));
        assert!(error("material,r,g,b,encoding\na,1,0\n").starts_with("line 2: "), "too few fields");
        assert_eq!(error("material,r,g,b,encoding\n"), "the table has no rows");
        assert!(error("").starts_with("the table has no column"));
    }
}
