//! The wrapping of glTF: plain JSON or the chunks of a GLB, and the buffers inside, beside or in the text.

use std::cell::OnceCell;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use super::super::contents;
use super::super::error::Fault;
use super::super::text::decoded;
use super::json::{Buffer, Root};

const PADDING: GeneralPurposeConfig =
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
const BASE64: GeneralPurpose = GeneralPurpose::new(&base64::alphabet::STANDARD, PADDING);

/// JSON and, of a GLB, the binary chunk.
pub(super) struct Container<'a> {
    pub root: Root,
    pub chunk: Option<&'a [u8]>,
    /// Bytes after the end of a GLB.
    pub trailing: usize,
}

/// Which of the two it is, its first bytes tell.
pub(super) fn open(bytes: &[u8]) -> Result<Container<'_>, Fault> {
    if bytes.starts_with(b"glTF") { open_glb(bytes) } else { open_text(bytes) }
}

fn open_text(bytes: &[u8]) -> Result<Container<'_>, Fault> {
    let bytes = &*decoded(bytes);
    let root = serde_json::from_slice(bytes).map_err(|error| {
        if let Some(old) = older(bytes) {
            return old;
        }
        let message = error.to_string();
        let message = message.split(" at line ").next().unwrap_or(&message);
        Fault::at_line(error.line(), format!("column {}: {message}", error.column()))
    })?;
    Ok(Container { root, chunk: None, trailing: 0 })
}

/// What is no glTF 2.0 may be glTF 1.0, whose parts stand under names instead of in lists.
fn older(json: &[u8]) -> Option<Fault> {
    let document: serde_json::Value = serde_json::from_slice(json).ok()?;
    let version = document.get("asset").and_then(|asset| asset.get("version"));
    let version = version.map(|version| version.to_string().replace('"', ""));
    let named = document.get("scenes").is_some_and(serde_json::Value::is_object);
    let version = version.or(named.then(|| "1.0".to_owned()))?;
    (named || version.starts_with('1'))
        .then(|| Fault::new(format!("it is glTF {version}, expected 2.0: export it as glTF 2.0")))
}

fn word(bytes: &[u8], at: usize) -> Result<u32, Fault> {
    let found = bytes.get(at..).and_then(|rest| rest.first_chunk());
    let ended = || Fault::at_byte(bytes.len(), "the file ends in the head of a GLB or of one of its chunks");
    found.map(|&word| u32::from_le_bytes(word)).ok_or_else(ended)
}

fn open_glb(bytes: &[u8]) -> Result<Container<'_>, Fault> {
    let (version, length) = (word(bytes, 4)?, word(bytes, 8)? as usize);
    if version != 2 {
        return Err(Fault::at_byte(4, format!("the GLB is of version {version}, expected 2: export it as glTF 2.0")));
    }
    let Some(all) = bytes.get(..length) else {
        let message = format!("the file ends here, but its head promises {length} bytes");
        return Err(Fault::at_byte(bytes.len(), message));
    };
    let trailing = bytes.len() - length;
    let (json, next) = chunk(all, 12, b"JSON")?;
    let json = json.ok_or_else(|| Fault::at_byte(12, "the first chunk of the GLB is not JSON"))?;
    let root =
        serde_json::from_slice(json).map_err(|error| Fault::at_byte(20, format!("the JSON in the GLB: {error}")))?;
    let chunk = if next < all.len() { chunk(all, next, b"BIN\0")?.0 } else { None };
    Ok(Container { root, chunk, trailing })
}

/// A chunk, if it is of this kind, and where the next one begins.
fn chunk<'a>(bytes: &'a [u8], at: usize, kind: &[u8; 4]) -> Result<(Option<&'a [u8]>, usize), Fault> {
    let length = word(bytes, at)? as usize;
    let found = word(bytes, at + 4)?;
    let end = (at + 8).saturating_add(length);
    let Some(content) = bytes.get(at + 8..end) else {
        return Err(Fault::at_byte(at, format!("the chunk of {length} bytes reaches beyond the end of the file")));
    };
    Ok(((found == u32::from_le_bytes(*kind)).then_some(content), end))
}

/// The buffers of a document, each read when first asked for: those of pictures never are.
pub(super) struct Buffers<'a> {
    described: &'a [Buffer],
    read: Vec<OnceCell<Vec<u8>>>,
    chunk: Option<&'a [u8]>,
    folder: PathBuf,
}

impl<'a> Buffers<'a> {
    pub fn new(described: &'a [Buffer], chunk: Option<&'a [u8]>, path: &Path) -> Self {
        let folder = path.parent().map_or_else(PathBuf::new, Path::to_owned);
        let read = described.iter().map(|_| OnceCell::new()).collect();
        Self { described, read, chunk, folder }
    }

    pub fn get(&self, index: usize) -> Result<&[u8], Fault> {
        let (Some(buffer), Some(cell)) = (self.described.get(index), self.read.get(index)) else {
            return Err(Fault::new(format!("there is no buffer {index}")));
        };
        let bytes: &[u8] = match (&buffer.uri, self.chunk) {
            (None, Some(chunk)) if index == 0 => chunk,
            (None, _) => return Err(Fault::new(format!("buffer {index} has neither a `uri` nor data in the file"))),
            (Some(uri), _) => match cell.get() {
                Some(bytes) => bytes,
                None => {
                    let bytes = self.fetch(uri, index, buffer.byte_length)?;
                    cell.get_or_init(|| bytes)
                }
            },
        };
        bytes.get(..buffer.byte_length).ok_or_else(|| {
            let message = format!("buffer {index} ends after {} bytes, expected {}", bytes.len(), buffer.byte_length);
            Fault::new(message)
        })
    }

    /// The bytes that a count could be about, at most.
    pub fn total(&self) -> usize {
        self.described.iter().fold(0, |sum, buffer| sum.saturating_add(buffer.byte_length))
    }

    fn fetch(&self, uri: &str, index: usize, length: usize) -> Result<Vec<u8>, Fault> {
        if let Some(data) = uri.strip_prefix("data:") {
            let Some((_, text)) = data.split_once(";base64,") else {
                return Err(Fault::new(format!("the data of buffer {index} are not in base64")));
            };
            let wrong = |error| Fault::new(format!("the base64 data of buffer {index}: {error}"));
            return BASE64.decode(text).map_err(wrong);
        }
        if uri.contains("://") {
            return Err(Fault::new(format!("buffer {index} is at {uri}: only files are read")));
        }
        let path = self.folder.join(percent_decoded(uri));
        contents(&path, u64::try_from(length).ok()).map_err(|source| Fault::other_file(path, source))
    }
}

/// `%20` and its like to bytes.
fn percent_decoded(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let digits = after.first_chunk::<2>().and_then(|digits| std::str::from_utf8(digits).ok());
        match digits.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) if first == b'%' => {
                bytes.push(byte);
                rest = after.get(2..).unwrap_or_default();
            }
            _ => {
                bytes.push(first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
