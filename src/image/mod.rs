//! Pictures as files: EXR keeps every colour, PNG shows it.
//!
//! The extension chooses the format; EXR files can hold more than the picture ([`channels`], [`spectral`]). Files are written whole or not at all ([`atomic`]), and the same picture with the
//! same [`Metadata`] gives the same bytes on every machine.

pub mod atomic;
pub mod channels;
pub mod error;
pub mod exr;
mod exr_header;
pub mod metadata;
pub mod png;
pub mod spectral;

use std::path::{Path, PathBuf};

pub use channels::{Channel, Extra};
pub use error::ImageError;
pub use metadata::Metadata;

use crate::film::Developed;

/// Bits a channel of a PNG.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Bits {
    #[default]
    Eight,
    Sixteen,
}

/// What the R, G, B channels of an EXR hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ExrSpace {
    /// Linear RGB of the development, relative to display white; `whiteLuminance` gives its scale in cd/m².
    #[default]
    Rgb,
    /// CIE XYZ in cd/m² as on the film, with the chromaticities that say so.
    Xyz,
}

/// Choices a format leaves open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    pub bits: Bits,
    pub exr_space: ExrSpace,
    /// EXR channels of 16 bits instead of 32: 11 significant bits and at most 65504.
    pub half: bool,
}

/// A format of picture files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Exr,
    Png,
}

impl Format {
    /// The format that the extension of `path` names, in any case of letters.
    pub fn of(path: &Path) -> Result<Self, ImageError> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        match extension.as_deref() {
            Some("exr") => Ok(Format::Exr),
            Some("png") => Ok(Format::Png),
            _ => Err(ImageError::Extension { path: path.to_path_buf() }),
        }
    }
}

/// The bytes of a picture file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Encoded {
    pub bytes: Vec<u8>,
    /// Channels beyond the range of half floats, stored as ±65504; 0 for all other files.
    pub beyond_half: u64,
}

/// What [`write()`] wrote.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    pub path: PathBuf,
    /// Size of the file.
    pub bytes: u64,
    /// As in [`Encoded`]: report it if it is not 0.
    pub beyond_half: u64,
}

/// Writes a picture to `path` in the format its extension names. On an error nothing has changed on disk.
pub fn write(
    path: &Path,
    developed: &Developed,
    options: &Options,
    metadata: &Metadata,
) -> Result<Written, ImageError> {
    let encoded = encode(Format::of(path)?, developed, options, metadata)?;
    atomic::write(path, &encoded.bytes)?;
    Ok(Written { path: path.to_path_buf(), bytes: encoded.bytes.len() as u64, beyond_half: encoded.beyond_half })
}

/// The file that [`write()`] would write, in memory.
pub fn encode(
    format: Format,
    developed: &Developed,
    options: &Options,
    metadata: &Metadata,
) -> Result<Encoded, ImageError> {
    encode_with(format, developed, &Extra::default(), options, metadata)
}

/// [`encode`] with `extra` beside the picture, in formats that can hold it.
pub fn encode_with(
    format: Format,
    developed: &Developed,
    extra: &Extra,
    options: &Options,
    metadata: &Metadata,
) -> Result<Encoded, ImageError> {
    metadata.check()?;
    match format {
        Format::Exr => exr::encode(developed, extra, options, metadata),
        Format::Png => png::encode(developed, options.bits, metadata),
    }
}

/// Fails now if [`write()`] to `path` would fail later: for use before a long render.
pub fn check_writable(path: &Path) -> Result<(), ImageError> {
    Format::of(path)?;
    atomic::check(path)
}
