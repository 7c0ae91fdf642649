//! Reports as text: for a terminal, for documents, for programs, for a browser.

mod grid;
mod html;
mod rows;
mod verdicts;

pub use grid::Grid;
pub use html::Page;

use grid::escape_markdown;
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
}

/// A report in a format, without a newline at its end.
pub fn text(report: &impl Report, format: Format) -> Result<String, FormatError> {
    let text = match format {
        Format::Table => with_notes(report.brief().text(), report.notes()),
        Format::Markdown => {
            let notes = report.notes().iter().map(|note| format!("- {}", escape_markdown(note))).collect();
            with_notes(report.brief().markdown(), notes)
        }
        Format::Csv => report.full().csv()?,
        Format::Json => serde_json::to_string_pretty(report)?,
        Format::Toml => toml::to_string(report)?,
        Format::Html => report.page().html(),
    };
    Ok(text.trim_end().to_owned())
}

fn with_notes(table: String, notes: Vec<String>) -> String {
    format!("{table}\n{}", notes.join("\n"))
}
