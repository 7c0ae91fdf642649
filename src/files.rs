//! Files of others: read whole, and made text whatever their encoding.
//!
//! Spreadsheets, instruments and modellers write UTF-8 with or without a mark, UTF-16, or one byte
//! a letter, and end lines by LF, CR LF or CR. All of it becomes UTF-8 with LF, so that whatever
//! parses it, and whoever counts lines, knows one form.

use std::borrow::Cow;
use std::io;
use std::path::Path;

/// Reads a file. What is no regular file is refused: a pipe that nobody writes to would be waited
/// for without end.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let kind = std::fs::metadata(path)?;
    match (kind.is_file(), kind.is_dir()) {
        (true, _) => std::fs::read(path),
        (_, true) => Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder, expected a file")),
        _ => Err(io::Error::new(io::ErrorKind::InvalidInput, "it is a pipe or a device, expected a regular file")),
    }
}

/// Returns the text that bytes stand for, with LF at the ends of lines and without a byte order
/// mark; `None` for what is no text. Text that is UTF-8 with LF already is not copied.
///
/// UTF-16 is told by its mark, or by every other byte being 0; what is neither this nor UTF-8 is
/// taken for Latin-1, whose letters are the first 256 of Unicode: µ, °, ², Å and é come out right,
/// in Windows' and Apple's code pages µ at least.
pub fn decode(bytes: &[u8]) -> Option<Cow<'_, str>> {
    let text = match unmarked(bytes)? {
        Cow::Borrowed(bytes) if bytes.contains(&0) => return None,
        Cow::Borrowed(bytes) => letters(bytes),
        Cow::Owned(bytes) => Cow::Owned(String::from_utf8(bytes).ok()?),
    };
    Some(if text.contains('\r') { Cow::Owned(text.replace("\r\n", "\n").replace('\r', "\n")) } else { text })
}

/// Returns bytes without a byte order mark, what is in UTF-16 as UTF-8: for files that may go on in binary. `None` for UTF-16 that is no
/// text.
pub fn unmarked(bytes: &[u8]) -> Option<Cow<'_, [u8]>> {
    let utf16 = |bytes, unit| Some(Cow::Owned(utf16(bytes, unit)?.into_bytes()));
    match bytes {
        [0xFF, 0xFE, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0xFE, 0xFF, rest @ ..] => utf16(rest, u16::from_be_bytes),
        _ if every_other_is_zero(bytes, 1) => utf16(bytes, u16::from_le_bytes),
        _ if every_other_is_zero(bytes, 0) => utf16(bytes, u16::from_be_bytes),
        _ => Some(Cow::Borrowed(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes))),
    }
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Option<String> {
    let (pairs, rest) = bytes.as_chunks::<2>();
    let units: Vec<u16> = pairs.iter().copied().map(unit).collect();
    if rest.is_empty() { String::from_utf16(&units).ok() } else { None }
}

/// How many bytes are looked at to tell UTF-16 without a mark.
const LOOKED_AT: usize = 64;

/// Whether each first or second byte of the first pairs is 0 and the other is not: the Latin
/// letters of UTF-16.
fn every_other_is_zero(bytes: &[u8], zero: usize) -> bool {
    let (pairs, _) = bytes.get(..bytes.len().min(LOOKED_AT)).unwrap_or_default().as_chunks::<2>();
    !pairs.is_empty() && pairs.iter().all(|pair| pair[zero] == 0 && pair[1 - zero] != 0)
}

/// Returns UTF-8 as it is, and other bytes as the letters of a code page of one byte a letter.
pub fn letters(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().copied().map(char::from).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_encoding_gives_the_same_text() {
        let text = "λ (µm)\n0.4\n";
        let utf16 = |bytes: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(bytes).collect::<Vec<u8>>();
        let latin = "wavelength µm\n0,4\n";
        for (bytes, expected) in [
            (text.as_bytes().to_vec(), text),
            ([b"\xEF\xBB\xBF", text.as_bytes()].concat(), text),
            ([b"\xFF\xFE".to_vec(), utf16(u16::to_le_bytes)].concat(), text),
            ([b"\xFE\xFF".to_vec(), utf16(u16::to_be_bytes)].concat(), text),
            (b"wavelength \xB5m\n0,4\n".to_vec(), latin),
            (b"wavelength \xB5m\r0,4\r".to_vec(), latin),
            ("wavelength µm\r\n0,4\r\n".as_bytes().to_vec(), latin),
            ("wavelength µm\n0,4\n".encode_utf16().flat_map(u16::to_le_bytes).collect(), latin),
            ("wavelength µm\n0,4\n".encode_utf16().flat_map(u16::to_be_bytes).collect(), latin),
            (Vec::new(), ""),
        ] {
            assert_eq!(decode(&bytes).as_deref(), Some(expected), "{bytes:?}");
        }
        assert!(matches!(decode(b"v 0 0 0\n"), Some(Cow::Borrowed(_))));
    }

    #[test]
    fn what_is_no_text_is_told() {
        assert_eq!(decode(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"), None);
        assert_eq!(decode(b"\xFF\xFEa"), None);
        assert_eq!(decode(b"\xFF\xFE\x00\xD8"), None);
    }

    #[test]
    fn only_regular_files_are_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.csv");
        std::fs::write(&path, "a").expect("a file");
        assert_eq!(read(&path).expect("a file"), b"a");
        assert!(read(folder.path()).expect_err("a folder").to_string().contains("a folder"));
        assert_eq!(read(&folder.path().join("b.csv")).expect_err("nothing").kind(), io::ErrorKind::NotFound);
        #[cfg(unix)]
        assert!(read(Path::new("/dev/null")).expect_err("a device").to_string().contains("a pipe or a device"));
    }
}
