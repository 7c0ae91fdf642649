//! Texts as programs of all ages write them: with a byte order mark, in UTF-16, in Latin-1, with
//! lines that end in a carriage return alone.

use std::borrow::Cow;

/// A file without its byte order mark; what is in UTF-16 is turned to UTF-8.
pub(super) fn decoded(bytes: &[u8]) -> Cow<'_, [u8]> {
    match bytes {
        [0xEF, 0xBB, 0xBF, rest @ ..] => Cow::Borrowed(rest),
        [0xFF, 0xFE, rest @ ..] => Cow::Owned(utf16(rest, u16::from_le_bytes)),
        [0xFE, 0xFF, rest @ ..] => Cow::Owned(utf16(rest, u16::from_be_bytes)),
        // Without a mark, every second byte of ASCII tells.
        [1..=255, 0, 1..=255, 0, 1..=255, 0, ..] => Cow::Owned(utf16(bytes, u16::from_le_bytes)),
        [0, 1..=255, 0, 1..=255, 0, 1..=255, ..] => Cow::Owned(utf16(bytes, u16::from_be_bytes)),
        _ => Cow::Borrowed(bytes),
    }
}

fn utf16(bytes: &[u8], word: fn([u8; 2]) -> u16) -> Vec<u8> {
    let (pairs, _) = bytes.as_chunks();
    let text = char::decode_utf16(pairs.iter().map(|&pair| word(pair)));
    text.map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER)).collect::<String>().into_bytes()
}

/// A text whose lines end in line feeds. What is no UTF-8 is read as Latin-1, in which names keep
/// their letters.
pub(super) fn text(bytes: &[u8]) -> Cow<'_, str> {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&byte| char::from(byte)).collect::<String>()),
    };
    if ends_lines_in_returns(bytes) { Cow::Owned(text.replace('\r', "\n")) } else { text }
}

/// Whether carriage returns that no line feed follows are more than line feeds.
fn ends_lines_in_returns(bytes: &[u8]) -> bool {
    let returns =
        bytes.iter().zip(bytes.iter().skip(1).chain([&0])).filter(|pair| *pair.0 == b'\r' && *pair.1 != b'\n');
    let count = returns.count();
    count > 0 && count > bytes.iter().filter(|&&byte| byte == b'\n').count()
}
