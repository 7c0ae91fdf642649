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
        let columns = self.columns();
        let line = |line: &Vec<String>| aligned(line, &columns, "  ").trim_end().to_owned() + "\n";
        self.lines().map(line).collect()
    }

    /// A table of GitHub Flavored Markdown, readable as text too.
    pub fn markdown(&self) -> String {
        let escape = |line: &Vec<String>| line.iter().map(|cell| escape_markdown(cell)).collect();
        let escaped = Self { heading: escape(&self.heading), rows: self.rows.iter().map(escape).collect() };
        let columns = escaped.columns();
        let rule = |column: &Column| match column.numbers {
            true => format!("{}:", "-".repeat(column.width - 1)),
            false => "-".repeat(column.width),
        };
        let rule: Vec<_> = columns.iter().map(rule).collect();
        let mut lines: Vec<_> = escaped.lines().map(|line| aligned(line, &columns, " | ")).collect();
        lines.insert(1, rule.join(" | "));
        lines.iter().map(|line| format!("| {line} |\n")).collect()
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

    fn columns(&self) -> Vec<Column> {
        let cells = |column: usize| self.lines().filter_map(move |line| line.get(column));
        let column = |(index, _): (usize, &String)| Column {
            // A rule of Markdown has three dashes.
            width: cells(index).map(|cell| width(cell)).fold(3, usize::max),
            numbers: are_numbers(cells(index).skip(1)),
        };
        self.heading.iter().enumerate().map(column).collect()
    }
}

/// How a column is set.
struct Column {
    width: usize,
    numbers: bool,
}

/// Whether every cell is a number or nothing, and one is a number.
fn are_numbers<'a>(cells: impl Iterator<Item = &'a String>) -> bool {
    let mut cells = cells.filter(|cell| !is_nothing(cell)).peekable();
    cells.peek().is_some() && cells.all(|cell| cell.trim_end_matches(['\\', '*']).parse::<f64>().is_ok())
}

fn aligned(line: &[String], columns: &[Column], gap: &str) -> String {
    let cell = |(cell, column): (&String, &Column)| {
        let room = " ".repeat(column.width.saturating_sub(width(cell)));
        if column.numbers { format!("{room}{cell}") } else { format!("{cell}{room}") }
    };
    line.iter().zip(columns).map(cell).collect::<Vec<_>>().join(gap)
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
        assert!(text.contains("\n| --------------- | -----: |\n"), "{text}");
        assert!(text.contains("| a\\|b, \"c\" \\<i\\> | 11.5\\* |"), "{text}");
        assert!(grid().csv().unwrap().contains("\n\"a|b, \"\"c\"\" <i>\",11.5*\n"));
    }
}
