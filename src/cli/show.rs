//! What people read: answers on standard output, everything else on standard error.

use crate::image::atomic;
use crate::scene::{DataSet, SceneError};
use crate::spectrum::About;
use std::fmt::Display;
use std::io::{self, Write};
use std::path::Path;

/// An answer of whole lines; a reader that has closed the pipe has seen enough.
pub fn answer(text: impl AsRef<str>) -> Result<(), SceneError> {
    let mut out = io::stdout().lock();
    match writeln!(out, "{}", text.as_ref().trim_end_matches('\n')).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(SceneError::new(format!("cannot write the answer: {error}")))
        }
        _ => Ok(()),
    }
}

/// An answer to a file, or to standard output.
pub fn answer_to(output: Option<&Path>, text: &str) -> Result<(), SceneError> {
    match output {
        Some(path) => atomic::write(path, text.as_bytes()).map_err(SceneError::new),
        None => answer(text),
    }
}

pub fn note(text: impl Display) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

pub fn warning(text: impl Display) {
    note(format_args!("warning: {text}"));
}

pub fn error(text: impl Display) {
    note(format_args!("error: {text}"));
}

/// Columns as wide as their widest cell, two spaces apart.
pub fn columns<const N: usize>(rows: &[[String; N]]) -> String {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; N] = std::array::from_fn(width);
    let line = |row: &[String; N]| {
        let cells = row.iter().zip(widths).map(|(cell, width)| format!("{cell:width$}"));
        cells.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    rows.iter().map(line).collect::<Vec<_>>().join("\n")
}

/// [`columns`] under their names.
pub fn table<const N: usize>(names: [&str; N], rows: impl IntoIterator<Item = [String; N]>) -> String {
    let head = names.map(str::to_owned);
    columns(&std::iter::once(head).chain(rows).collect::<Vec<_>>())
}

/// A block of lines under a title, two spaces in.
pub fn section(title: impl Display, lines: &str) -> String {
    let lines: Vec<_> = lines.lines().map(|line| format!("\n  {line}")).collect();
    format!("{title}{}", lines.concat())
}

/// Every data set of these once, in the order of their first use, with all that use it.
pub fn data_sets<'a>(all: impl IntoIterator<Item = &'a DataSet>) -> Vec<(&'a About, Vec<String>)> {
    let mut found: Vec<(&About, Vec<String>)> = Vec::new();
    for DataSet { used_by, about } in all {
        match found.iter_mut().find(|(known, _)| known.name == about.name && known.range_nm == about.range_nm) {
            Some((_, users)) if users.contains(used_by) => {}
            Some((_, users)) => users.push(used_by.clone()),
            None => found.push((about, vec![used_by.clone()])),
        }
    }
    found
}

/// Wavelengths that data cover.
pub fn range_nm(range: Option<(f64, f64)>) -> String {
    range.map_or("everywhere".into(), |(first, last)| format!("{first:.0}–{last:.0} nm"))
}

/// A word as a shell takes it.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_=,./+:".contains(c);
    if word.chars().all(plain) { word.to_owned() } else { format!("'{}'", word.replace('\'', r"'\''")) }
}
