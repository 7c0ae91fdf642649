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
    /// A chart of many samples.
    Cgats,
    Spdx,
}

/// Endings of text in columns.
const COLUMNS: [&str; 9] = ["csv", "txt", "dat", "nk", "spd", "tsv", "tab", "asc", "prn"];

/// Endings of CGATS.
const CHARTS: [&str; 5] = ["cgats", "cgt", "ti3", "it8", "cie"];

/// What can be read, in words for whoever has something else.
pub(super) const READABLE: &str = "two or three columns of text (.csv, .txt, .dat, .nk, .spd, .tsv), .toml, \
    pages of refractiveindex.info (.yml), glasses of Zemax catalogues (as `file.agf#N-BK7`), samples of CGATS charts (as `file.ti3#A1`) and TM-27 (.spdx)";

impl Format {
    /// The format that a name's ending tells; `None` for a name in the library.
    pub fn of(name: &str) -> Option<Self> {
        let ending = Path::new(file_of(name)).extension()?.to_str()?.to_lowercase();
        match ending.as_str() {
            "toml" => Some(Self::Toml),
            "yml" | "yaml" => Some(Self::Yaml),
            "agf" => Some(Self::Agf),
            "spdx" => Some(Self::Spdx),
            chart if CHARTS.contains(&chart) => Some(Self::Cgats),
            columns if COLUMNS.contains(&columns) => Some(Self::Columns),
            _ => None,
        }
    }
}

/// The file and the part of it of a name such as `SCHOTT.AGF#N-BK7`, where files have parts.
fn parted(name: &str) -> Option<(&str, &str)> {
    let has_parts = |file: &str| {
        let ending = Path::new(file).extension().and_then(|ending| ending.to_str());
        let ending = ending.unwrap_or_default().to_lowercase();
        ending == "agf" || ending == "txt" || CHARTS.contains(&ending.as_str())
    };
    name.rsplit_once('#').filter(|(file, _)| has_parts(file))
}

/// The name of the file that a data set's name stands for.
pub(super) fn file_of(name: &str) -> &str {
    parted(name).map_or(name, |(file, _)| file)
}

/// The glass of a catalogue or the sample of a chart that a name asks for.
pub(super) fn part_of(name: &str) -> Option<&str> {
    parted(name).map(|(_, part)| part)
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
