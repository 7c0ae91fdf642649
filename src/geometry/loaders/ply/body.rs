//! The numbers of a PLY file's body, from text or from bytes of either order.

use super::super::error::Fault;
use super::super::gather::count;
use super::super::number;
use super::header::{Element, Encoding, Type};

/// Hands out the body number by number. All numbers of the format are exact in double precision.
pub(super) trait Body {
    /// Before the first number of each row.
    fn begin_row(&mut self, element: &Element, row: usize) -> Result<(), Fault>;

    fn number(&mut self, kind: Type) -> Result<f64, Fault>;

    /// After the last one.
    fn end_row(&mut self) -> Result<(), Fault>;

    /// What is wrong with the row at hand.
    fn fault(&self, message: String) -> Fault;

    /// The most numbers that can still come, each being of a byte at least.
    fn left(&self) -> usize;

    /// What a user should know of the end of the file.
    fn epilogue(&self) -> Option<String>;
}

/// A body of text: a line for each row.
pub(super) struct Text<'a> {
    rest: &'a str,
    words: std::str::SplitAsciiWhitespace<'a>,
    line: usize,
    cut_short: bool,
}

impl<'a> Text<'a> {
    pub fn new(text: &'a str, lines_before: usize) -> Self {
        let cut_short = !text.ends_with('\n');
        let words = "".split_ascii_whitespace();
        Self { rest: text, words, line: lines_before, cut_short }
    }
}

impl Body for Text<'_> {
    fn begin_row(&mut self, element: &Element, row: usize) -> Result<(), Fault> {
        loop {
            if self.rest.is_empty() {
                let Element { name, count, .. } = element;
                let message = format!("the file ends before `{name}` {} of {count}", row + 1);
                return Err(Fault::at_line(self.line + 1, message));
            }
            let (line, rest) = self.rest.split_once('\n').unwrap_or((self.rest, ""));
            self.rest = rest;
            self.line += 1;
            if !line.trim_ascii().is_empty() {
                self.words = line.split_ascii_whitespace();
                return Ok(());
            }
        }
    }

    fn number(&mut self, kind: Type) -> Result<f64, Fault> {
        let Some(word) = self.words.next() else {
            return Err(self.fault("the line ends before its last number".to_owned()));
        };
        if kind.is_integer() {
            let value: Option<i64> = word.parse().ok();
            return value
                .map(|value| value as f64)
                .ok_or_else(|| self.fault(format!("`{word}` is not a whole number")));
        }
        number::parse(word).map_err(|message| self.fault(message))
    }

    fn end_row(&mut self) -> Result<(), Fault> {
        match self.words.next() {
            None => Ok(()),
            Some(word) => Err(self.fault(format!("`{word}` follows the last number of the row"))),
        }
    }

    fn fault(&self, message: String) -> Fault {
        Fault::at_line(self.line, message)
    }

    fn left(&self) -> usize {
        self.rest.len()
    }

    fn epilogue(&self) -> Option<String> {
        if !self.rest.trim_ascii().is_empty() {
            return Some(format!("the text from line {} on belongs to no element of the header", self.line + 1));
        }
        self.cut_short.then(|| "the last line has no end: the file may have been cut short".to_owned())
    }
}

/// A body of bytes.
pub(super) struct Binary<'a> {
    bytes: &'a [u8],
    at: usize,
    big: bool,
    /// Where the row at hand began, and what it is.
    row_at: usize,
    row: usize,
    element: String,
}

impl<'a> Binary<'a> {
    pub fn new(bytes: &'a [u8], at: usize, encoding: Encoding) -> Self {
        Self { bytes, at, big: encoding == Encoding::Big, row_at: at, row: 0, element: String::new() }
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let found = self.bytes.get(self.at..).and_then(|rest| rest.first_chunk::<N>());
        let Some(&found) = found else {
            let message = format!("the file ends in `{}` {}, at byte {}", self.element, self.row, self.bytes.len());
            return Err(Fault::at_byte(self.row_at, message));
        };
        self.at += N;
        Ok(if self.big {
            let mut turned = found;
            turned.reverse();
            turned
        } else {
            found
        })
    }
}

impl Body for Binary<'_> {
    #[inline]
    fn begin_row(&mut self, element: &Element, row: usize) -> Result<(), Fault> {
        if row == 0 {
            self.element.clone_from(&element.name);
        }
        self.row = row;
        self.row_at = self.at;
        Ok(())
    }

    #[inline]
    fn number(&mut self, kind: Type) -> Result<f64, Fault> {
        Ok(match kind {
            Type::I8 => i8::from_le_bytes(self.take()?).into(),
            Type::U8 => u8::from_le_bytes(self.take()?).into(),
            Type::I16 => i16::from_le_bytes(self.take()?).into(),
            Type::U16 => u16::from_le_bytes(self.take()?).into(),
            Type::I32 => i32::from_le_bytes(self.take()?).into(),
            Type::U32 => u32::from_le_bytes(self.take()?).into(),
            Type::F32 => f32::from_le_bytes(self.take()?).into(),
            Type::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    fn end_row(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    fn fault(&self, message: String) -> Fault {
        Fault::at_byte(self.row_at, message)
    }

    fn left(&self) -> usize {
        self.bytes.len().saturating_sub(self.at)
    }

    fn epilogue(&self) -> Option<String> {
        match self.left() {
            0 => None,
            left => Some(format!("{} at the end, of no element of the header", count(left, "byte"))),
        }
    }
}
