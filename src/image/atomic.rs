//! Files that appear whole or not at all: written beside the target, then renamed over it.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::ImageError;

/// Replaces `path` by `bytes`. On an error the old file, if any, is untouched and nothing is left behind.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), ImageError> {
    write_with(path, |file| file.write_all(bytes))
}

/// [`write()`] for content that comes bit by bit, such as a film.
pub fn write_with(path: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), ImageError> {
    let failed = |error| ImageError::Write { path: path.to_path_buf(), error };
    let (file, target) = open(path)?;
    let mut buffered = BufWriter::new(file.as_file());
    content(&mut buffered).and_then(|()| buffered.flush()).map_err(failed)?;
    drop(buffered);
    // Before the rename, or a crash could leave the name with an empty file.
    file.as_file().sync_all().map_err(failed)?;
    file.persist(target).map_err(|e| failed(e.error))?;
    Ok(())
}

/// Whether [`write()`] to `path` would find a place to write. Leaves nothing behind.
pub fn check(path: &Path) -> Result<(), ImageError> {
    let (file, _) = open(path)?;
    file.close().map_err(|error| ImageError::Write { path: path.to_path_buf(), error })
}

/// A temporary file beside the target, and the target with symbolic links followed.
fn open(path: &Path) -> Result<(NamedTempFile, PathBuf), ImageError> {
    let target = match fs::canonicalize(path) {
        // Not there yet, or a folder is missing: that is told below.
        Err(error) if error.kind() == io::ErrorKind::NotFound => path.to_path_buf(),
        Err(error) => return Err(ImageError::Write { path: path.to_path_buf(), error }),
        Ok(target) => target,
    };
    if target.is_dir() {
        return Err(ImageError::IsFolder { path: path.to_path_buf() });
    }
    let folder = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    };
    if !folder.is_dir() {
        return Err(ImageError::NoFolder { path: path.to_path_buf(), folder });
    }
    let file = builder().tempfile_in(&folder).map_err(|e| ImageError::Write {
        path: path.to_path_buf(),
        // Without the name of the temporary file: people know the target only.
        error: e.kind().into(),
    })?;
    Ok((file, target))
}

fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".spectrel-").suffix(".tmp");
    #[cfg(unix)]
    {
        // Temporary files are private by default; a picture gets what the umask allows, as any other file.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder
}
