//! Texts of mesh files, which may be large: what needs no change is not copied.

use crate::files;
use std::borrow::Cow;

/// A file without its byte order mark; what is in UTF-16 is turned to UTF-8, but for half a letter at its end.
pub(super) fn decoded(bytes: &[u8]) -> Cow<'_, [u8]> {
    let whole = || files::unmarked(bytes.get(..bytes.len() & !1)?);
    files::unmarked(bytes).or_else(whole).unwrap_or(Cow::Borrowed(bytes))
}

/// A text whose lines end in line feeds, with or without a carriage return before them.
pub(super) fn text(bytes: &[u8]) -> Cow<'_, str> {
    let text = files::letters(bytes);
    if ends_lines_in_returns(bytes) { Cow::Owned(text.replace('\r', "\n")) } else { text }
}

/// Whether carriage returns that no line feed follows are more than line feeds.
fn ends_lines_in_returns(bytes: &[u8]) -> bool {
    let returns =
        bytes.iter().zip(bytes.iter().skip(1).chain([&0])).filter(|pair| *pair.0 == b'\r' && *pair.1 != b'\n');
    let count = returns.count();
    count > 0 && count > bytes.iter().filter(|&&byte| byte == b'\n').count()
}
