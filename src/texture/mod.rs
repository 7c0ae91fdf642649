//! Pictures that come in: EXR, Radiance HDR, PNG and JPEG as arrays of numbers, with what the file says of their meaning; and what
//! such a picture shows where it lies on a surface (`texels`).
//!
//! A reader tells the size from the header before it takes memory, names the file in every error, and changes no value:
//! what a negative or an infinite one means is for the scene to say. It looks at the file's extension, not at its first
//! bytes, so that an error can say what was expected.

mod code_points;
mod codes;
mod curve;
mod error;
mod exr;
mod hdr;
mod icc;
mod jpeg;
mod png;
mod raster;
mod stated;
mod texels;

pub use codes::{Codes, Index};
pub use curve::Curve;
pub use error::TextureError;
pub use raster::{Encoding, Raster, Samples};
pub use texels::{Texels, Wrap};

use std::fs::File;
use std::path::Path;

/// Reads a picture. `beside`: bytes a texel that the caller is going to keep of it, counted when memory is asked for.
pub fn read(path: &Path, beside: usize) -> Result<Raster, TextureError> {
    let extension = path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase);
    let reader = match extension.as_deref() {
        Some("exr") => exr::read,
        Some("hdr" | "pic") => hdr::read,
        Some("png") => png::read,
        Some("jpg" | "jpeg") => jpeg::read,
        _ => return Err(TextureError::Extension { path: path.to_owned() }),
    };
    let unreadable = |error| TextureError::Open { path: path.to_owned(), error };
    let file = File::open(path).map_err(unreadable)?;
    // A folder opens, and a pipe may never end.
    if !file.metadata().map_err(unreadable)?.is_file() {
        return Err(TextureError::NoFile { path: path.to_owned() });
    }
    reader(file, beside).map_err(|fault| fault.in_file(path))
}
