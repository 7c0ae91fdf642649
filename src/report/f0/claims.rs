//! Reading someone else's table: CSV with a row for each material.
//!
//! The first line that is no comment names the columns; case, order and further columns do not matter:
//! `material` (or `name`, `metal`), `r`, `g`, `b` (or `red`, `green`, `blue`), and, if there are any, `encoding` (or `space`, `curve`) and
//! `table` (or `source`, `engine`). Numbers of no stated encoding are taken for linear, which the verdict says.

use super::check::{Claim, Encoding};
use crate::report::table::{Table, TableError, number};
use csv::StringRecord;

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
pub fn read(text: &[u8]) -> Result<Vec<Claim>, TableError> {
    let mut table = Table::new(text)?;
    let columns = Columns::of(&table)?;
    let claims = table.rows().map(|row| {
        let (line, record) = row?;
        columns.claim(&record, line).map_err(|message| TableError { line: Some(line), message })
    });
    let claims = claims.collect::<Result<Vec<_>, _>>()?;
    match claims.is_empty() {
        true => Err(TableError { line: None, message: "the table has no rows".into() }),
        false => Ok(claims),
    }
}

/// Where the values stand.
struct Columns {
    material: usize,
    rgb: [usize; 3],
    encoding: Option<usize>,
    table: Option<usize>,
}

impl Columns {
    fn of(table: &Table) -> Result<Self, TableError> {
        let [material, r, g, b] = table.columns([MATERIAL, RED, GREEN, BLUE])?;
        Ok(Self { material, rgb: [r, g, b], encoding: table.column(ENCODING), table: table.column(TABLE) })
    }

    fn claim(&self, record: &StringRecord, line: u64) -> Result<Claim, String> {
        let [r, g, b] = self.rgb;
        let material = record[self.material].to_owned();
        if material.is_empty() {
            return Err("`material` is empty".into());
        }
        let stated = self.encoding.map(|column| &record[column]).filter(|text| !text.is_empty());
        Ok(Claim {
            table: self.table.map(|column| record[column].to_owned()).filter(|table| !table.is_empty()),
            material,
            rgb: [channel("r", &record[r])?, channel("g", &record[g])?, channel("b", &record[b])?],
            encoding: stated.map_or(Ok(Encoding::Linear), encoding)?,
            assumed: stated.is_none(),
            line,
        })
    }
}

fn channel(name: &str, text: &str) -> Result<f64, String> {
    let value = number(name, text)?;
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
            assumed: false,
            line: 3,
        };
        assert_eq!(claims, [claim]);
        assert_eq!(read(b"material,r,g,b,encoding\nx,0,0,0,linear\n").unwrap()[0].table, None);
        for text in ["name,r,g,b\nx,0,0,0\n", "name,r,g,b,encoding\nx,0,0,0,\n"] {
            let claim = &read(text.as_bytes()).unwrap()[0];
            assert_eq!((claim.encoding, claim.assumed), (Encoding::Linear, true));
        }
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        assert_eq!(error("materiel,r,g\n"), "the table has no column `material` (is it `materiel`?), `b`");
        assert_eq!(error("material,r,g,b,encoding\n# x\na,1,x,0,linear\n"), "line 3: `g` is \"x\", expected a number");
        assert!(error("material,r,g,b,encoding\na,1,0,200,linear\n").starts_with("line 2: `b` is 200, expected"));
        assert!(error("material,r,g,b,encoding\na,1,0,nan,linear\n").starts_with("line 2: `b` is nan, expected"));
        assert!(error("material,r,g,b,encoding\na,1,0,0,cmyk\n").contains("expected `linear` or `sRGB`"));
        assert!(error("material,r,g,b,encoding\na,1,0\n").starts_with("line 2: "), "too few fields");
        assert_eq!(error("material,r,g,b,encoding\n"), "the table has no rows");
        assert!(error("").starts_with("the table has no column"));
    }
}
