//! Reports as text: for a terminal, for documents, for programs, for a browser.

mod assets;
mod html;
mod rows;
mod verdicts;

pub use html::Page;

use super::Table;
use crate::report::{Grid, markup};
use serde::Serialize;

/// A form of text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Aligned columns for a terminal: what a person looks at first.
    #[default]
    Table,
    /// The same columns in Markdown.
    Markdown,
    /// Every column.
    Csv,
    Json,
    Toml,
    /// One page that needs no other file.
    Html,
    /// A glTF scene with a sphere of each material.
    Gltf,
    /// A MaterialX document of `open_pbr_surface`.
    MaterialX,
}

/// What can be told in every format.
pub trait Report: Serialize {
    /// The columns that a person looks at first.
    fn brief(&self) -> Grid;
    /// Every column.
    fn full(&self) -> Grid;
    /// What has to be said below the table.
    fn notes(&self) -> Vec<String>;
    fn page(&self) -> Page;
    /// The materials, if it is about materials.
    fn materials(&self) -> Option<&Table> {
        None
    }
}

/// Why a report could not be written.
#[derive(Debug, thiserror::Error)]
pub enum FormatError {
    #[error("JSON: {0}")]
    Json(#[from] serde_json::Error),
    #[error("TOML: {0}")]
    Toml(#[from] toml::ser::Error),
    #[error("CSV: {0}")]
    Csv(#[from] csv::Error),
    #[error("a verdict is no material: only tables of materials are written as glTF and MaterialX")]
    NoMaterials,
}

/// A report in a format, without a newline at its end.
pub fn text(report: &impl Report, format: Format) -> Result<String, FormatError> {
    let text = match format {
        Format::Table => with_notes(report.brief().text(), report.notes()),
        Format::Markdown => {
            let notes = report.notes().iter().map(|note| format!("- {}", markup::markdown(note))).collect();
            with_notes(report.brief().markdown(), notes)
        }
        Format::Csv => report.full().csv()?,
        Format::Json => markup::json(report)?,
        Format::Toml => toml::to_string(report)?,
        Format::Html => report.page().html(),
        Format::Gltf => assets::gltf(report.materials().ok_or(FormatError::NoMaterials)?)?,
        Format::MaterialX => assets::materialx(report.materials().ok_or(FormatError::NoMaterials)?),
    };
    Ok(text.trim_end().to_owned())
}

fn with_notes(table: String, notes: Vec<String>) -> String {
    format!("{table}\n{}", notes.join("\n"))
}
