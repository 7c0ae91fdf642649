//! A folder that appears whole or not at all: filled beside its place, then renamed to it.

use crate::scene::SceneError;
use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// What tells a report from other folders.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// A file that every one of them has.
    pub file: &'static str,
    /// Of spectrel, by which it is made.
    pub command: &'static str,
}

impl Kind {
    /// Whether such a report holds files of this name: whatever else lies in a folder is never thrown away.
    fn makes(&self, file: &Path) -> bool {
        let ending = file.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        let own = file.file_stem() == Path::new(self.file).file_stem() && ["html", "json", "svg"].contains(&ending);
        file.is_file() && (own || ["png", "exr"].contains(&ending))
    }
}

/// Where a report is to stand.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// Fails now if [`Folder::write`] would fail later. Only an earlier report is ever replaced, and only if `force` is said.
    pub fn claim(path: &Path, kind: Kind, force: bool) -> Result<Self, SceneError> {
        let (shown, folder) = (path.display(), Self { path: path.to_owned() });
        if path.file_name().is_none() {
            return Err(
                SceneError::new(format!("{shown} is no name for a report's folder")).help("name a new one with -o DIR")
            );
        }
        let parent = folder.parent();
        if !parent.is_dir() {
            return Err(SceneError::new(format!("cannot write {shown}: there is no folder {}", parent.display())));
        }
        if path.exists() && !path.is_dir() {
            return Err(SceneError::new(format!("{shown} is a file: the report is a folder")));
        }
        let names = if path.is_dir() { folder.names().map_err(|e| folder.failed(&e))? } else { Vec::new() };
        let foreign = names.iter().find(|name| !kind.makes(&path.join(name)));
        let report = names.iter().any(|name| name.as_os_str() == kind.file);
        match (names.is_empty(), report, foreign, force) {
            (true, ..) | (false, true, None, true) => {}
            (false, true, None, false) => {
                let error = SceneError::new(format!("{shown} holds a report already"));
                return Err(error.help("add --force to replace it, or name another folder with -o DIR"));
            }
            (false, _, foreign, _) => {
                let which = foreign.map_or(String::new(), |name| format!(" (`{}`)", name.display()));
                let error = SceneError::new(format!(
                    "{shown} is not empty, and what is in it is no report of `spectrel {}`{which}",
                    kind.command
                ));
                return Err(error.help("name another folder with -o DIR; --force replaces earlier reports only"));
            }
        }
        folder.beside().map(|_| folder)
    }

    /// Puts the files into the folder, and nothing else.
    pub fn write(&self, files: &[(String, Vec<u8>)]) -> Result<(), SceneError> {
        let failed = |error| self.failed(&error);
        let fresh = self.beside()?;
        files.iter().try_for_each(|(name, bytes)| fs::write(fresh.path().join(name), bytes)).map_err(failed)?;
        if self.path.exists() {
            // The old one goes when the new one stands, and comes back if that fails.
            let old = self.beside()?;
            let aside = old.path().join("old");
            fs::rename(&self.path, &aside).map_err(failed)?;
            return fs::rename(fresh.path(), &self.path).map_err(|error| {
                let _ = fs::rename(&aside, &self.path);
                failed(error)
            });
        }
        fs::rename(fresh.path(), &self.path).map_err(failed)
    }

    fn names(&self) -> io::Result<Vec<OsString>> {
        fs::read_dir(&self.path)?.map(|entry| entry.map(|entry| entry.file_name())).collect()
    }

    fn parent(&self) -> PathBuf {
        match self.path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
            _ => PathBuf::from("."),
        }
    }

    /// A new folder on the same file system, which goes when it is dropped.
    fn beside(&self) -> Result<TempDir, SceneError> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".spectrel-").suffix(".tmp");
        #[cfg(unix)]
        {
            // Temporary folders are private by default; a report gets what the umask allows.
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(fs::Permissions::from_mode(0o777));
        }
        builder.tempdir_in(self.parent()).map_err(|error| self.failed(&error))
    }

    fn failed(&self, error: &io::Error) -> SceneError {
        // Without the name of the temporary folder: people know the target only.
        SceneError::new(format!("cannot write {}: {}", self.path.display(), error.kind()))
    }
}
