//! Errors that say where, what was expected, and what was probably meant.

use crate::spectrum::{SpectrumError, nearest};
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

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
            let message = error.message().trim_end();
            let found = match error.span() {
                Some(span) => self.error(&span, message),
                None => self.whole(message),
            };
            found.maybe_help(meant_name(message))
        })
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

    fn maybe_help(mut self, help: Option<String>) -> Self {
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

/// A suggestion from serde's words: "unknown field `x`, expected one of `a`, `b`".
fn meant_name(message: &str) -> Option<String> {
    let (unknown, expected) = message.strip_prefix("unknown ")?.split_once("expected ")?;
    let wanted = unknown.split('`').nth(1)?;
    let name = nearest(wanted, expected.split('`').skip(1).step_by(2))?;
    Some(format!("did you mean `{name}`?"))
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn serde_messages_give_a_suggestion() {
        let message = "unknown field `radus`, expected one of `center`, `radius`";
        assert_eq!(meant_name(message).as_deref(), Some("did you mean `radius`?"));
        assert_eq!(meant_name("unknown field `zzz`, expected `center`"), None);
        assert_eq!(meant_name("invalid type: string"), None);
    }
}
