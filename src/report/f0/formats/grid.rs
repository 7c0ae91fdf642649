//! A table of texts, as columns, Markdown or CSV.

use super::FormatError;

/// Rows as long as the heading.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    pub heading: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Grid {
    pub fn new(heading: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> Self {
        Self { heading: heading.iter().map(|&name| name.to_owned()).collect(), rows: rows.into_iter().collect() }
    }

    /// Columns as wide as their widest cell, two spaces apart; numbers end at the right.
    pub fn text(&self) -> String {
        let widths = self.widths();
        let lines: Vec<_> = self.lines().map(|line| self.aligned(line, &widths, "  ").trim_end().to_owned()).collect();
        lines.join("\n") + "\n"
    }

    /// A table of GitHub Flavored Markdown, readable as text too.
    pub fn markdown(&self) -> String {
        let escaped = Self {
            heading: self.heading.iter().map(|cell| escape_markdown(cell)).collect(),
            rows: self.rows.iter().map(|row| row.iter().map(|cell| escape_markdown(cell)).collect()).collect(),
        };
        let widths: Vec<_> = escaped.widths().into_iter().map(|width| width.max(3)).collect();
        let rule = |(column, width): (usize, &usize)| match escaped.is_number(column) {
            true => format!("{}:", "-".repeat(width - 1)),
            false => "-".repeat(*width),
        };
        let rule: Vec<_> = widths.iter().enumerate().map(rule).collect();
        let mut lines: Vec<_> =
            escaped.lines().map(|line| format!("| {} |\n", escaped.aligned(line, &widths, " | "))).collect();
        lines.insert(1, format!("| {} |\n", rule.join(" | ")));
        lines.concat()
    }

    pub fn csv(&self) -> Result<String, FormatError> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for line in self.lines() {
            writer.write_record(line)?;
        }
        let bytes = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    fn lines(&self) -> impl Iterator<Item = &Vec<String>> {
        std::iter::once(&self.heading).chain(&self.rows)
    }

    fn widths(&self) -> Vec<usize> {
        let width = |column: usize| self.lines().filter_map(|line| line.get(column)).map(|cell| width(cell)).max();
        (0..self.heading.len()).map(|column| width(column).unwrap_or(0)).collect()
    }

    /// Whether every cell below the heading is a number or nothing, and one is a number.
    fn is_number(&self, column: usize) -> bool {
        let mut cells = self.rows.iter().filter_map(|row| row.get(column)).filter(|cell| !is_nothing(cell)).peekable();
        cells.peek().is_some() && cells.all(|cell| cell.trim_end_matches(['\\', '*']).parse::<f64>().is_ok())
    }

    fn aligned(&self, line: &[String], widths: &[usize], gap: &str) -> String {
        let cell = |(column, (cell, size)): (usize, (&String, &usize))| {
            let room = " ".repeat(size.saturating_sub(width(cell)));
            if self.is_number(column) { format!("{room}{cell}") } else { format!("{cell}{room}") }
        };
        line.iter().zip(widths).enumerate().map(cell).collect::<Vec<_>>().join(gap)
    }
}

fn is_nothing(cell: &str) -> bool {
    cell.is_empty() || cell == "–"
}

/// How many columns of a terminal a text takes; the library's texts are Latin.
fn width(text: &str) -> usize {
    text.chars().count()
}

/// Without what Markdown reads as a table, markup or HTML.
pub(super) fn escape_markdown(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        match character {
            '|' | '\\' | '*' | '_' | '`' | '[' | ']' | '<' | '>' => escaped.extend(['\\', character]),
            '\n' | '\r' => escaped.push(' '),
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Grid {
        let row = |a: &str, b: &str| vec![a.to_owned(), b.to_owned()];
        Grid::new(&["Name", "n"], [row("gold", "0.22"), row("a|b, \"c\" <i>", "11.5*"), row("größe", "–")])
    }

    #[test]
    fn numbers_end_at_the_right() {
        assert_eq!(
            grid().text(),
            "Name              n\ngold           0.22\na|b, \"c\" <i>  11.5*\ngröße             –\n"
        );
    }

    #[test]
    fn what_would_be_markup_is_escaped() {
        let text = grid().markdown();
        assert!(text.contains("\n| ----------------- | ------: |\n"), "{text}");
        assert!(text.contains("| a\\|b, \"c\" \\<i\\> | 11.5\\* |"), "{text}");
        assert!(grid().csv().unwrap().contains("\n\"a|b, \"\"c\"\" <i>\",11.5*\n"));
    }
}
