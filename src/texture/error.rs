//! Why a picture could not be read.

use crate::memory::{GIB, available_bytes};
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

#[derive(Debug, Error)]
pub enum TextureError {
    #[error("cannot tell the format of `{}`: the name must end in .exr, .hdr, .png or .jpg", path.display())]
    Extension { path: PathBuf },
    #[error("cannot read `{}`: {error}", path.display())]
    Open { path: PathBuf, error: io::Error },
    #[error("cannot read `{}`: it is no file", path.display())]
    NoFile { path: PathBuf },
    #[error("`{}`: {message}", path.display())]
    Content { path: PathBuf, message: String },
    #[error(
        "`{}` has {width} × {height} texels: they take {:.1} GiB of memory ({bytes:.0} bytes){}",
        path.display(),
        bytes / GIB,
        available.map_or(String::new(), |available| format!(", but {:.1} GiB are free", available / GIB))
    )]
    Memory { path: PathBuf, width: u64, height: u64, bytes: f64, available: Option<f64> },
}

/// What is wrong with a file, before it is known which file.
#[derive(Debug)]
pub(super) enum Fault {
    Content(String),
    Memory { width: u64, height: u64, bytes: f64, available: Option<f64> },
}

impl Fault {
    pub fn new(message: impl fmt::Display) -> Self {
        Self::Content(message.to_string())
    }

    pub fn in_file(self, path: &Path) -> TextureError {
        let path = path.to_owned();
        match self {
            Self::Content(message) => TextureError::Content { path, message },
            Self::Memory { width, height, bytes, available } => {
                TextureError::Memory { path, width, height, bytes, available }
            }
        }
    }
}

/// How many texels there are, if there is memory for so many bytes of each.
pub(super) fn room_for(width: u64, height: u64, bytes_a_texel: usize) -> Result<usize, Fault> {
    if width == 0 || height == 0 {
        return Err(Fault::new(format!("it has {width} × {height} texels: there is no picture in it")));
    }
    let bytes = width as f64 * height as f64 * bytes_a_texel as f64;
    let available = available_bytes();
    let fits = bytes <= available.unwrap_or(f64::INFINITY) && bytes < isize::MAX as f64;
    let sides = u32::try_from(width).is_ok() && u32::try_from(height).is_ok();
    match usize::try_from(width * height) {
        Ok(texels) if fits && sides => Ok(texels),
        _ => Err(Fault::Memory { width, height, bytes, available }),
    }
}

/// An array of so many equal values, or the fault that there is no memory for it.
pub(super) fn array<T: Copy>(value: T, texels: usize, [width, height]: [u64; 2]) -> Result<Vec<T>, Fault> {
    let mut values = Vec::new();
    let bytes = texels as f64 * size_of::<T>() as f64;
    values.try_reserve_exact(texels).map_err(|_| Fault::Memory {
        width,
        height,
        bytes,
        available: available_bytes(),
    })?;
    values.resize(texels, value);
    Ok(values)
}
