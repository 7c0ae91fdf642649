//! Why a picture could not be written.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

#[derive(Debug, Error)]
pub enum ImageError {
    #[error("cannot tell the format of `{}`: the name must end in .exr or .png", path.display())]
    Extension { path: PathBuf },
    #[error("cannot write `{}`: the folder `{}` does not exist", path.display(), folder.display())]
    NoFolder { path: PathBuf, folder: PathBuf },
    #[error("cannot write `{}`: it is a folder", path.display())]
    IsFolder { path: PathBuf },
    #[error("cannot write `{}`: {error}", path.display())]
    Write { path: PathBuf, error: io::Error },
    #[error("cannot encode the {format}: {reason}")]
    Encode { format: &'static str, reason: String },
    #[error("the metadata key `{key}` {problem}")]
    Metadata { key: String, problem: &'static str },
}
