//! Errors that say where, what was expected, and what was probably meant.

use super::words::{meant, plain, slip};
use crate::spectrum::SpectrumError;
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A text that values come from: a scene or material file, kept so that an error can show its line.
#[derive(Clone, Debug)]
pub struct Text {
    pub path: PathBuf,
    pub content: String,
}

/// Why a scene cannot be rendered.
#[derive(Debug)]
pub struct SceneError {
    pub message: String,
    pub place: Option<Place>,
    pub help: Option<String>,
}

/// Where in a file something stands; lines and columns count from 1, columns in characters.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    pub path: PathBuf,
    pub line: usize,
    pub column: usize,
    source_line: String,
}

impl Text {
    pub fn new(path: impl Into<PathBuf>, content: impl Into<String>) -> Self {
        Self { path: path.into(), content: content.into() }
    }

    /// The folder that relative file names in this text start from.
    pub fn base(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    fn place(&self, span: &Range<usize>) -> Place {
        let start = (0..=span.start.min(self.content.len())).rev().find(|&at| self.content.is_char_boundary(at));
        let before = &self.content[..start.unwrap_or(0)];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let source_line = self.content[line_start..].lines().next().unwrap_or("");
        Place {
            path: self.path.clone(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            source_line: source_line.to_owned(),
        }
    }

    /// An error at a place in this text.
    pub fn error(&self, span: &Range<usize>, message: impl fmt::Display) -> SceneError {
        SceneError { message: message.to_string(), place: Some(self.place(span)), help: None }
    }

    /// An error about the whole file.
    pub fn whole(&self, message: impl fmt::Display) -> SceneError {
        SceneError { message: format!("{}: {message}", self.path.display()), place: None, help: None }
    }

    /// Reads TOML into `T`; unknown names come with the nearest known one.
    pub fn parse<T: serde::de::DeserializeOwned>(&self) -> Result<T, SceneError> {
        toml::from_str(&self.content).map_err(|error| {
            if self.content.lines().all(|line| line.trim().is_empty() || line.trim_start().starts_with('#')) {
                return self.whole("there is nothing in this file");
            }
            let mut message = plain(error.message());
            let Some(span) = error.span() else { return self.whole(message) };
            if error.message().starts_with("missing field") {
                let table = self.table_at(&span).map_or("this file".to_owned(), |path| format!("`{path}`"));
                message = format!("{message} in {table}");
            }
            let slip =
                slip(error.message(), self.line_of(&span)).or_else(|| self.list_of_tables(error.message(), &span));
            self.error(&span, message).maybe_help(slip.or_else(|| meant(error.message())))
        })
    }

    /// The line of a place, and how many of its bytes stand before it.
    fn line_of(&self, span: &Range<usize>) -> (&str, usize) {
        let start = span.start.min(self.content.len());
        let line = self.content.get(..start).and_then(|before| before.rfind('\n')).map_or(0, |newline| newline + 1);
        (self.content.get(line..).and_then(|rest| rest.lines().next()).unwrap_or(""), start - line)
    }

    /// How a table is written that stands in a list.
    fn list_of_tables(&self, message: &str, span: &Range<usize>) -> Option<String> {
        let expected = message.trim_end() == "invalid type: map, expected a sequence";
        let name = self.table_at(span).filter(|_| expected)?;
        Some(format!("there may be more than one: write `[[{name}]]` above each, with two brackets"))
    }

    /// The dotted name of the table that stands at a place.
    fn table_at(&self, span: &Range<usize>) -> Option<String> {
        let root = DeTable::parse(&self.content).ok()?;
        path_to(root.get_ref(), span).map(|mut path| {
            path.reverse();
            path.join(".")
        })
    }
}

/// The keys that lead to the table at a place, the last one first.
fn path_to(table: &DeTable, span: &Range<usize>) -> Option<Vec<String>> {
    table.iter().find_map(|(key, value)| {
        let mut path = keys_below(value, span)?;
        path.push(key.get_ref().to_string());
        Some(path)
    })
}

fn keys_below(value: &Spanned<DeValue>, span: &Range<usize>) -> Option<Vec<String>> {
    match value.get_ref() {
        DeValue::Table(_) if value.span() == *span => Some(Vec::new()),
        DeValue::Table(table) => path_to(table, span),
        DeValue::Array(list) => list.iter().find_map(|entry| keys_below(entry, span)),
        _ => None,
    }
}

impl SceneError {
    pub fn new(message: impl fmt::Display) -> Self {
        Self { message: message.to_string(), place: None, help: None }
    }

    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    pub(super) fn maybe_help(mut self, help: Option<String>) -> Self {
        self.help = help.or(self.help);
        self
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}:{}", self.path.display(), self.line, self.column)
    }
}

/// Lines longer than this are shown without their text.
const LONGEST_SHOWN_LINE: usize = 160;

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Some(place) = &self.place else {
            write!(f, "{}", self.message)?;
            return self.help.iter().try_for_each(|help| write!(f, "\n  help: {help}"));
        };
        write!(f, "{place}: {}", self.message)?;
        let shown = !place.source_line.trim().is_empty() && place.source_line.chars().count() <= LONGEST_SHOWN_LINE;
        if shown {
            let number = place.line.to_string();
            write!(f, "\n  {number} | {}", place.source_line.replace('\t', " "))?;
            write!(f, "\n  {:width$} | {:indent$}^", "", "", width = number.len(), indent = place.column - 1)?;
        }
        self.help.iter().try_for_each(|help| write!(f, "\n  help: {help}"))
    }
}

impl std::error::Error for SceneError {}

impl From<SpectrumError> for SceneError {
    fn from(error: SpectrumError) -> Self {
        Self::new(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn places_count_lines_and_characters_from_one() {
        let text = Text::new("a.toml", "x = 1\nµ = \"gold\"\n");
        let place = text.error(&(11..17), "no").place.unwrap();
        assert_eq!((place.line, place.column), (2, 5));
        let end = text.error(&(1000..1001), "no").place.unwrap();
        assert_eq!((end.line, end.column), (3, 1));
    }

    #[test]
    fn an_error_shows_its_line_and_help() {
        let text = Text::new("a.toml", "material = \"glod\"");
        let error = text.error(&(11..17), "unknown material").help("did you mean \"gold\"?");
        assert_eq!(
            error.to_string(),
            "a.toml:1:12: unknown material\n  1 | material = \"glod\"\n    |            ^\n  help: did you mean \"gold\"?"
        );
    }

    #[test]
    fn a_missing_key_names_its_table() {
        #[derive(Debug, serde::Deserialize)]
        #[allow(dead_code, reason = "only the error matters")]
        struct File {
            a: Vec<Inner>,
        }
        #[derive(Debug, serde::Deserialize)]
        #[allow(dead_code, reason = "only the error matters")]
        struct Inner {
            b: BTreeMap<String, u32>,
            c: Option<Box<Inner>>,
        }
        let message = |text: &str| Text::new("a.toml", text).parse::<File>().unwrap_err().to_string();
        assert!(message("x = 1").starts_with("a.toml:1:1: `a` is missing in this file"));
        assert!(message("[[a]]\nb = {}\n[[a]]\nc = {}").starts_with("a.toml:4:5: `b` is missing in `a.c`"));
        assert_eq!(message("# nothing"), "a.toml: there is nothing in this file");
    }
}
