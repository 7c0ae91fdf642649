//! Files that appear whole or not at all: written beside the target, then renamed over it.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::ImageError;

/// Replaces `path` by `bytes`. On an error the old file, if any, is untouched and nothing is left behind.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), ImageError> {
    let failed = |error| ImageError::Write { path: path.to_path_buf(), error };
    let (mut file, target) = open(path)?;
    file.write_all(bytes).map_err(failed)?;
    // Before the rename, or a crash could leave the name with an empty file.
    file.as_file().sync_all().map_err(failed)?;
    file.persist(target).map_err(|e| failed(e.error))?;
    Ok(())
}

/// Whether [`write`] to `path` would find a place to write. Leaves nothing behind.
pub fn check(path: &Path) -> Result<(), ImageError> {
    let (file, _) = open(path)?;
    file.close().map_err(|error| ImageError::Write { path: path.to_path_buf(), error })
}

/// A temporary file beside the target, and the target with symbolic links followed.
fn open(path: &Path) -> Result<(NamedTempFile, PathBuf), ImageError> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
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
