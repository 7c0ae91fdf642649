//! In which format a data file is, told by the ending of its name, and its text.

use std::path::Path;

use super::SpectrumError;
use crate::files;

/// The formats that are read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Format {
    Toml,
    /// A page of refractiveindex.info.
    Yaml,
    /// Columns of text.
    Columns,
    /// A glass catalogue.
    Agf,
    Spdx,
}

/// Endings of text in columns.
const COLUMNS: [&str; 9] = ["csv", "txt", "dat", "nk", "spd", "tsv", "tab", "asc", "prn"];

/// What can be read, in words for whoever has something else.
pub(super) const READABLE: &str = "two or three columns of text (.csv, .txt, .dat, .nk, .spd, .tsv), .toml, \
    pages of refractiveindex.info (.yml), glasses of Zemax catalogues (as `file.agf#N-BK7`) and TM-27 (.spdx)";

impl Format {
    /// The format that a name's ending tells; `None` for a name in the library.
    pub fn of(name: &str) -> Option<Self> {
        if glass(name).is_some() {
            return Some(Self::Agf);
        }
        let ending = Path::new(name).extension()?.to_str()?.to_lowercase();
        match ending.as_str() {
            "toml" => Some(Self::Toml),
            "yml" | "yaml" => Some(Self::Yaml),
            "agf" => Some(Self::Agf),
            "spdx" => Some(Self::Spdx),
            columns if COLUMNS.contains(&columns) => Some(Self::Columns),
            _ => None,
        }
    }
}

/// The file and the glass of a name such as `SCHOTT.AGF#N-BK7`.
pub(super) fn glass(name: &str) -> Option<(&str, &str)> {
    name.rsplit_once('#').filter(|(file, _)| file.to_lowercase().ends_with(".agf"))
}

/// The name of the file that a data set's name stands for.
pub(super) fn file_of(name: &str) -> &str {
    glass(name).map_or(name, |(file, _)| file)
}

/// The text of a file, whatever its encoding.
pub(super) fn text_of(path: &Path) -> Result<String, SpectrumError> {
    let bytes = files::read(path).map_err(|source| SpectrumError::Read { path: path.to_owned(), source })?;
    match files::decode(&bytes) {
        Some(text) => Ok(text.into_owned()),
        None => Err(SpectrumError::Content {
            path: path.to_owned(),
            line: None,
            column: None,
            message: format!("this is no text; read are {READABLE}"),
        }),
    }
}
