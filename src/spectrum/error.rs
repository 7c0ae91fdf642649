//! What can go wrong with a spectrum, in words for people: which file and place, what was found, what was expected.

use std::fmt;
use std::path::PathBuf;

use super::about::Quantity;

/// An error of this room. The message says what was expected, and names the nearest match of a misspelt name.
#[derive(Debug, thiserror::Error)]
pub enum SpectrumError {
    /// A reference that neither the user's folders nor the built-in library know.
    #[error("no {quantity} data set is called `{name}`{}", hint(.suggestion))]
    UnknownData { quantity: Quantity, name: String, suggestion: Option<String> },

    /// A material that neither the user's folders nor the built-in library know.
    #[error("no material is called `{name}`{}", hint(.suggestion))]
    UnknownMaterial { name: String, suggestion: Option<String> },

    /// A file that cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read { path: PathBuf, source: std::io::Error },

    /// A file of a kind that no reader is for.
    #[error("`{name}` is a file of a kind that is not read; read are {}", super::format::READABLE)]
    UnreadableKind { name: String },

    /// A file whose content is not what its format asks for.
    #[error("{}: {message}", place(.path, .line, .column))]
    Content { path: PathBuf, line: Option<usize>, column: Option<usize>, message: String },

    /// A number outside the range in which a formula holds.
    #[error("{what} is {value}, expected {expected}")]
    OutOfRange { what: &'static str, value: f64, expected: &'static str },

    /// A formula without meaning.
    #[error("{0}")]
    Formula(String),

    /// An illuminant without light where the observer sees: it has no white.
    #[error("the illuminant has no light between 360 and 830 nm, so it has no white")]
    NoLight,
}

fn hint(suggestion: &Option<String>) -> String {
    suggestion.as_ref().map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
}

fn place(path: &std::path::Path, line: &Option<usize>, column: &Option<usize>) -> String {
    let mut text = path.display().to_string();
    for number in [line, column].into_iter().map_while(|number| *number) {
        text.push_str(&format!(":{number}"));
    }
    text
}

/// What is wrong with the content of a file, before it is known which file: the readers return it, the library adds
/// the path.
#[derive(Debug)]
pub(super) struct Fault {
    pub message: String,
    place: Place,
}

#[derive(Debug)]
enum Place {
    Unknown,
    /// Bytes from the start of the text.
    Offset(usize),
    LineColumn(usize, usize),
}

impl Fault {
    pub fn new(message: impl fmt::Display) -> Self {
        Self { message: message.to_string(), place: Place::Unknown }
    }

    /// At a byte offset of the text.
    pub fn at(offset: usize, message: impl fmt::Display) -> Self {
        Self { message: message.to_string(), place: Place::Offset(offset) }
    }

    pub fn at_line(line: usize, column: usize, message: impl fmt::Display) -> Self {
        Self { message: message.to_string(), place: Place::LineColumn(line, column) }
    }

    /// The same fault, at this byte offset unless it already knows its place.
    pub fn or_at(self, offset: usize) -> Self {
        match self.place {
            Place::Unknown => Self { place: Place::Offset(offset), ..self },
            _ => self,
        }
    }

    pub fn in_file(self, path: impl Into<PathBuf>, text: &str) -> SpectrumError {
        let place = match self.place {
            Place::Unknown => None,
            Place::Offset(offset) => Some(line_and_column(text, offset)),
            Place::LineColumn(line, column) => Some((line, column)),
        };
        let (line, column) = place.unzip();
        SpectrumError::Content { path: path.into(), line, column, message: self.message }
    }
}

fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().map_or(0, |line| line.chars().count()) + 1;
    (line, column)
}

/// The candidate nearest to a name, if one is near enough to be meant: the same but for case, then the one that
/// continues it, then the most alike.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wanted = name.to_lowercase();
    let score = |candidate: &str| {
        let candidate = candidate.to_lowercase();
        let contains = !wanted.is_empty() && candidate.contains(&wanted);
        let [short, long] = [wanted.len().min(candidate.len()), wanted.len().max(candidate.len())];
        // A long word is not a symbol of two letters, whichever letters they share.
        let alike = if short <= 3 && long > 2 * short { 0.0 } else { strsim::jaro_winkler(&wanted, &candidate) };
        alike.max(if contains { 0.9 } else { 0.0 })
    };
    candidates
        .into_iter()
        .map(|candidate| (score(candidate), candidate))
        .filter(|(score, _)| *score > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0).then_with(|| b.1.cmp(a.1)))
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_prefers_the_same_word_and_refuses_the_far() {
        let names = ["D50", "D65", "FL2", "led-b1"];
        assert_eq!(nearest("d65", names), Some("D65"));
        assert_eq!(nearest("led_b1", names), Some("led-b1"));
        assert_eq!(nearest("xenon", names), None);
        assert_eq!(nearest("", names), None);
        assert_eq!(nearest("aquamarine", ["Au", "Ag"]), None);
        assert_eq!(nearest("anisotropy", ["ior", "roughness", "fresnel"]), None);
        assert_eq!(nearest("god", ["gold"]), Some("gold"));
        assert_eq!(nearest("Au/jonson", ["Au/johnson-christy-1972"]), Some("Au/johnson-christy-1972"));
    }

    #[test]
    fn offsets_become_lines_and_columns() {
        assert_eq!(line_and_column("ab\ncd\n", 4), (2, 2));
        assert_eq!(line_and_column("ab", 99), (1, 3));
        let error = Fault::new("odd").or_at(3).in_file("a.toml", "ab\ncd\n");
        assert_eq!(error.to_string(), "a.toml:2:1: odd");
    }
}
