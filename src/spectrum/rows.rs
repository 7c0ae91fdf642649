//! Text as rows of words: which mark parts the columns, what is a comment, and where each word
//! stands.

use super::words::Word;

/// What stands between two columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Separator {
    Mark(char),
    /// Blanks and tabs, any number of them.
    Blanks,
}

/// The rows of a file.
pub(super) struct Rows<'a> {
    /// Rows that are not empty, each with at least one word.
    pub rows: Vec<Vec<Word<'a>>>,
    /// Lines that start with a mark of comments, without it.
    pub comments: Vec<Word<'a>>,
    pub separator: Separator,
}

const SEPARATORS: [Separator; 4] =
    [Separator::Mark(','), Separator::Mark(';'), Separator::Mark('\t'), Separator::Blanks];

impl<'a> Rows<'a> {
    pub fn of(text: &'a str) -> Self {
        let separator = separator(text);
        let (mut rows, mut comments) = (Vec::new(), Vec::new());
        let mut start = 0;
        while let Some(rest) = text.get(start..).filter(|rest| !rest.is_empty()) {
            let line = rest.split('\n').next().unwrap_or_default();
            let end = match separator.comment(line) {
                Some(comment) => {
                    comments.push(Word { text: comment, offset: start + line.len() - comment.len() });
                    line.len()
                }
                None => {
                    let end = row_end(rest);
                    rows.extend(Some(separator.words(&rest[..end], start)).filter(|words| !words.is_empty()));
                    end
                }
            };
            start += end + 1;
        }
        Self { rows, comments, separator }
    }
}

/// The end of a row: the first end of a line that no quotation marks enclose.
fn row_end(rest: &str) -> usize {
    let first = rest.find('\n').unwrap_or(rest.len());
    if !rest[..first].contains('"') {
        return first;
    }
    let mut quoted = false;
    let end = rest.char_indices().find(|&(_, letter)| {
        quoted ^= letter == '"';
        letter == '\n' && !quoted
    });
    match end {
        Some((end, _)) => end,
        None if quoted => first,
        None => rest.len(),
    }
}

/// The separator by which most lines are all numbers; without numbers, the first that the first
/// line has.
fn separator(text: &str) -> Separator {
    let numeric = |separator: &Separator| {
        let is_row = |words: &Vec<Word>| words.len() > 1 && words.iter().all(|word| word.is_number());
        text.lines().filter(|line| is_row(&separator.words(line, 0))).count()
    };
    let counts = SEPARATORS.map(|separator| (numeric(&separator), separator));
    // Of equals the first.
    let best = counts.into_iter().rev().max_by_key(|(count, _)| *count).filter(|(count, _)| *count > 0);
    let first = text.lines().find(|line| !line.starts_with('#') && !line.trim().is_empty()).unwrap_or_default();
    let found = SEPARATORS.into_iter().find(|separator| match separator {
        Separator::Mark(mark) => first.contains(*mark),
        Separator::Blanks => true,
    });
    best.map(|(_, separator)| separator).or(found).unwrap_or(Separator::Mark(','))
}

impl Separator {
    /// What a line of comment says.
    fn comment(self, line: &str) -> Option<&str> {
        let line = line.trim_start();
        let marks = ["#", "%", "!", "//", ";"];
        let marks = marks.iter().filter(|mark| self != Self::Mark(';') || **mark != ";");
        marks.into_iter().find_map(|mark| line.strip_prefix(mark)).map(|rest| rest.trim_start_matches(['#', ';', ' ']))
    }

    /// The words of a row, without empty ones at its end.
    pub fn words(self, row: &str, start: usize) -> Vec<Word<'_>> {
        let mut words = match self {
            Self::Mark(mark) => parts(row, start, mark),
            Self::Blanks => blank_separated(row, start),
        };
        words.truncate(words.iter().rposition(|word| !word.text.is_empty()).map_or(0, |last| last + 1));
        words
    }
}

/// The parts of a row between marks that no quotation marks enclose.
fn parts(row: &str, start: usize, mark: char) -> Vec<Word<'_>> {
    let quotes = row.matches('"').count().is_multiple_of(2);
    let (mut words, mut from, mut quoted) = (Vec::new(), 0, false);
    for (at, letter) in row.char_indices() {
        quoted ^= quotes && letter == '"';
        if letter == mark && !quoted {
            words.push(trimmed(row, from, at, start));
            from = at + letter.len_utf8();
        }
    }
    words.push(trimmed(row, from, row.len(), start));
    words
}

/// A part without blanks and quotation marks around it.
fn trimmed(row: &str, from: usize, to: usize, start: usize) -> Word<'_> {
    let part = row[from..to].trim_start();
    let unquoted = part.trim().strip_prefix('"').and_then(|part| part.strip_suffix('"'));
    let offset = start + to - part.len() + usize::from(unquoted.is_some());
    let text = unquoted.unwrap_or(part).trim_end();
    Word { text, offset: offset + text.len() - text.trim_start().len() }.without_blanks()
}

impl Word<'_> {
    fn without_blanks(self) -> Self {
        Self { text: self.text.trim(), ..self }
    }
}

/// Words between blanks; what stands in brackets belongs to the word before: `Wavelength (nm)` is
/// one.
fn blank_separated(row: &str, start: usize) -> Vec<Word<'_>> {
    let mut spans: Vec<(usize, usize)> = Vec::new();
    let (mut open, units) = (0_i32, is_unit_row(row));
    for word in row.split_whitespace() {
        let from = word.as_ptr() as usize - row.as_ptr() as usize;
        let to = from + word.len();
        let count = |marks: [char; 2]| word.matches(marks).count() as i32;
        match spans.last_mut() {
            Some(last) if open > 0 || (word.starts_with(['(', '[']) && !units) => last.1 = to,
            _ => spans.push((from, to)),
        }
        open = (open + count(['(', '[']) - count([')', ']'])).max(0);
    }
    spans.into_iter().map(|(from, to)| Word { text: &row[from..to], offset: start + from }).collect()
}

/// A row of units alone, such as `(nm) (-) (-)`.
fn is_unit_row(row: &str) -> bool {
    row.split_whitespace().all(|word| word.starts_with(['(', '[']) && word.ends_with([')', ']']))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Separator, Vec<Vec<&str>>) {
        let rows = Rows::of(text);
        (rows.separator, rows.rows.iter().map(|row| row.iter().map(|word| word.text).collect()).collect())
    }

    #[test]
    fn the_separator_is_the_one_that_leaves_numbers() {
        let expected = vec![vec!["400,5", "1,5", "0,2"]];
        for (text, separator) in [
            ("400,5;1,5;0,2\n", Separator::Mark(';')),
            ("400,5\t1,5\t0,2\n", Separator::Mark('\t')),
            ("  400,5  1,5 \t 0,2\n", Separator::Blanks),
            ("\"400,5\",\"1,5\",\"0,2\"", Separator::Mark(',')),
        ] {
            assert_eq!(read(text), (separator, expected.clone()), "{text}");
        }
        assert_eq!(read("a; b\n400, 1, 2,,\n").1, [vec!["a; b"], vec!["400", "1", "2"]]);
        assert_eq!(read("lambda [nm] n k (at 20 °C)\n1 2 3\n").1[0], ["lambda [nm]", "n", "k (at 20 °C)"]);
        assert_eq!(read("(nm) (-)\n1 2\n").1[0], ["(nm)", "(-)"]);
        assert_eq!(read("\"a\nb\",c\n1,2\n").1, [vec!["a\nb", "c"], vec!["1", "2"]]);
        assert_eq!(read("5\" disc,c\n1,2\n").1, [vec!["5\" disc", "c"], vec!["1", "2"]]);
        assert_eq!(read("; comment\n# another\n// third\n1 2\n").1, [vec!["1", "2"]]);
        assert!(read("").1.is_empty() && read("\n , ,\n").1.is_empty());
    }

    #[test]
    fn words_know_their_places() {
        let text = "# λ\n\" a \" , b\n 1,  \"2\"\n";
        for row in Rows::of(text).rows {
            for word in row {
                assert_eq!(&text[word.offset..word.offset + word.text.len()], word.text);
            }
        }
        let rows = Rows::of(text);
        assert_eq!(&text[rows.comments[0].offset..][..2], "λ");
    }
}
