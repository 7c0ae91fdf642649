//! What can be wrong with a mesh file, in words for the person who has it: which file, where, what was expected.

use std::fmt;
use std::path::{Path, PathBuf};

use super::EXTENSIONS;

/// A mesh file that cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    #[error("{}: {}; the mesh formats are {}", .path.display(), unknown(.extension), known())]
    UnknownFormat { path: PathBuf, extension: Option<String> },

    /// A file, or one that it refers to, that cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read { path: PathBuf, source: std::io::Error },

    /// A file whose content is not what its format asks for.
    #[error("{}{place}: {message}", .path.display())]
    Content { path: PathBuf, place: Place, message: String },

    /// A glTF file that cannot be shown without extensions that are not supported.
    #[error(
        "{}: it requires {}, which spectrel does not support; export it without",
        .path.display(), .names.join(", ")
    )]
    Extensions { path: PathBuf, names: Vec<String> },
}

/// Where in a file something is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Nowhere in particular.
    File,
    /// Of a text, from 1.
    Line(usize),
    /// Of a binary, from 0.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Place::File => Ok(()),
            Place::Line(line) => write!(f, ":{line}"),
            Place::Byte(byte) => write!(f, ", byte {byte}"),
        }
    }
}

fn unknown(extension: &Option<String>) -> String {
    match extension {
        Some(extension) => format!("`.{extension}` is no mesh format known here"),
        None => "a file without extension, which tells the format".to_owned(),
    }
}

fn known() -> String {
    EXTENSIONS.map(|extension| format!(".{extension}")).join(", ")
}

/// What is wrong, before it is known in which file: the readers return it, [`super::load`] adds the path.
#[derive(Debug)]
pub(super) struct Fault {
    kind: Kind,
    place: Place,
}

#[derive(Debug)]
enum Kind {
    Content(String),
    Extensions(Vec<String>),
    Other(PathBuf, std::io::Error),
}

impl Fault {
    pub fn new(message: impl Into<String>) -> Self {
        Self { kind: Kind::Content(message.into()), place: Place::File }
    }

    pub fn at_line(line: usize, message: impl Into<String>) -> Self {
        Self { kind: Kind::Content(message.into()), place: Place::Line(line) }
    }

    pub fn at_byte(byte: usize, message: impl Into<String>) -> Self {
        Self { kind: Kind::Content(message.into()), place: Place::Byte(byte) }
    }

    pub fn extensions(names: Vec<String>) -> Self {
        Self { kind: Kind::Extensions(names), place: Place::File }
    }

    /// Another file that this one refers to cannot be read.
    pub fn other_file(path: PathBuf, source: std::io::Error) -> Self {
        Self { kind: Kind::Other(path, source), place: Place::File }
    }

    /// Says in what the fault is.
    pub fn within(mut self, what: &str) -> Self {
        if let Kind::Content(message) = &mut self.kind {
            *message = format!("{what}: {message}");
        }
        self
    }

    pub fn in_file(self, path: &Path) -> LoadError {
        let path = path.to_owned();
        match self.kind {
            Kind::Content(message) => LoadError::Content { path, place: self.place, message },
            Kind::Extensions(names) => LoadError::Extensions { path, names },
            Kind::Other(path, source) => LoadError::Read { path, source },
        }
    }
}
