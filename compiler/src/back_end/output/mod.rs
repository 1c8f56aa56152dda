//! Writes outputs in full or not at all.
//!
//! A file is written beside its target and renamed over it. What is not committed is
//! removed, on an error and on an interrupt.

mod same_file;

pub use same_file::{SameFile, distinct};

use crate::diagnostic::Diagnostic;
use std::{
    fs::{self, File, OpenOptions},
    io::{self, Write},
    path::{Path, PathBuf},
    sync::{Mutex, MutexGuard, PoisonError},
};
use tempfile::{NamedTempFile, TempPath};
use thiserror::Error;

/// Files and folders that must not outlive an interrupt.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    // A list of paths is whole after any panic.
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Why an output could not be written.
#[derive(Debug, Error)]
#[error("{path}: {doing}", path = path.display())]
pub struct OutputError {
    /// The output.
    pub path: PathBuf,
    /// What failed.
    pub doing: &'static str,
    /// Why.
    pub source: io::Error,
}

impl Diagnostic for OutputError {
    fn remedy(&self) -> String {
        match self.source.kind() {
            io::ErrorKind::NotFound => "create the folder first, or give another path".into(),
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
                "give a path in a folder that you may write to".into()
            }
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
                "free space on the disk, or give a path on another one".into()
            }
            io::ErrorKind::IsADirectory => "give a path for a file, not a folder".into(),
            io::ErrorKind::NotADirectory => "give a folder, not a file".into(),
            io::ErrorKind::AlreadyExists => "give another path".into(),
            _ => "check the path and the disk".into(),
        }
    }
}

/// A file that is being written: write to it, then [`commit`](AtomicFile::commit).
///
/// If it is dropped before, the target stays as it was. A target that is no regular
/// file (a pipe, `/dev/stdout`) cannot be replaced and is written to directly.
#[derive(Debug)]
pub struct AtomicFile {
    target: PathBuf,
    place: Place,
}

#[derive(Debug)]
enum Place {
    Beside(File, TempPath),
    Direct(File),
}

impl AtomicFile {
    /// Starts a file for `target`, whose folder must exist.
    ///
    /// # Errors
    /// [`OutputError`] for a missing folder, a folder at `target`, or no permission.
    pub fn create(target: &Path) -> Result<Self, OutputError> {
        let fail = |doing, source| OutputError {
            path: target.to_owned(),
            doing,
            source,
        };
        let existing = fs::metadata(target).ok();
        if existing.as_ref().is_some_and(fs::Metadata::is_dir) {
            let source = io::Error::from(io::ErrorKind::IsADirectory);
            return Err(fail("cannot write a file there", source));
        }
        if existing.as_ref().is_some_and(|m| !m.is_file()) {
            let file = OpenOptions::new()
                .write(true)
                .open(target)
                .map_err(|e| fail("cannot open it for writing", e))?;
            return Ok(Self {
                target: target.to_owned(),
                place: Place::Direct(file),
            });
        }
        // Of a symbolic link, the file that it points to is replaced.
        let target = fs::canonicalize(target).unwrap_or_else(|_| target.to_owned());
        let folder = match target.parent() {
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        };
        fs::metadata(folder).map_err(|e| fail("cannot reach its folder", e))?;
        let mut builder = tempfile::Builder::new();
        builder.prefix(".asperity-");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            // The permissions of any new file: what the umask leaves.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        // Under the lock, so that an interrupt sees every file that is there.
        let mut list = unfinished();
        let (file, path) = builder
            .tempfile_in(folder)
            .map(NamedTempFile::into_parts)
            .map_err(|e| fail("cannot write into its folder", strip_path(&e)))?;
        list.push(path.to_path_buf());
        Ok(Self {
            target,
            place: Place::Beside(file, path),
        })
    }

    /// The file that is written.
    #[must_use]
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Whether the target is no regular file, such as a pipe or a terminal.
    #[must_use]
    pub fn is_direct(&self) -> bool {
        matches!(self.place, Place::Direct(_))
    }

    /// Makes what was written the target, replacing what was there.
    ///
    /// # Errors
    /// [`OutputError`]; the target is then as it was.
    pub fn commit(mut self) -> Result<(), OutputError> {
        self.finish()
    }

    fn finish(&mut self) -> Result<(), OutputError> {
        let fail = |source| OutputError {
            path: self.target.clone(),
            doing: "cannot finish it",
            source,
        };
        match &mut self.place {
            Place::Direct(file) => file.flush().map_err(fail),
            Place::Beside(file, path) => {
                file.flush().map_err(fail)?;
                // The standard rename replaces the target on Windows, too.
                fs::rename(&*path, &self.target).map_err(fail)
            }
        }
    }
}

/// The error without the temporary file's name, which means nothing to a user.
fn strip_path(error: &io::Error) -> io::Error {
    error.raw_os_error().map_or_else(
        || io::Error::from(error.kind()),
        io::Error::from_raw_os_error,
    )
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if let Place::Beside(_, path) = &self.place {
            // Removed before it leaves the list. After a commit there is nothing to remove.
            let mut list = unfinished();
            let _ = fs::remove_file(path);
            list.retain(|other| other != &**path);
        }
    }
}

impl Write for AtomicFile {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        match &mut self.place {
            Place::Beside(file, _) | Place::Direct(file) => file.write(buffer),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.place {
            Place::Beside(file, _) | Place::Direct(file) => file.flush(),
        }
    }
}

/// Writes `bytes` to `target`, all or nothing.
///
/// # Errors
/// [`OutputError`]; the target is then as it was.
pub fn write_atomic(target: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    write_all(&[(target, bytes)])
}

/// Writes several files. All of them are complete before the first appears under its name.
///
/// # Errors
/// [`OutputError`]. Every target is then as it was, unless it was the renaming that failed.
pub fn write_all(files: &[(&Path, &[u8])]) -> Result<(), OutputError> {
    let mut staged = Vec::with_capacity(files.len());
    for (target, bytes) in files {
        let mut file = AtomicFile::create(target)?;
        fill(&mut file, bytes)?;
        staged.push(file);
    }
    // Under the lock: an interrupt waits until every file has its name.
    let list = unfinished();
    let finished = staged.iter_mut().try_for_each(AtomicFile::finish);
    drop(list);
    finished
}

fn fill(file: &mut AtomicFile, bytes: &[u8]) -> Result<(), OutputError> {
    file.write_all(bytes).map_err(|source| OutputError {
        path: file.target().to_owned(),
        doing: "cannot write it",
        source,
    })
}

/// Writes named files into a folder, which is made if its parent exists. All of them
/// are complete before the first appears under its name.
///
/// # Errors
/// [`OutputError`]; a folder that was made is removed again.
pub fn write_folder(folder: &Path, files: &[(String, &[u8])]) -> Result<(), OutputError> {
    let fail = |doing, source| OutputError {
        path: folder.to_owned(),
        doing,
        source,
    };
    let made = if folder.is_dir() {
        None
    } else {
        let mut list = unfinished();
        fs::create_dir(folder).map_err(|e| match e.kind() {
            io::ErrorKind::AlreadyExists => fail("is a file", io::ErrorKind::NotADirectory.into()),
            _ => fail("cannot make the folder", e),
        })?;
        list.push(folder.to_owned());
        Some(MadeFolder(folder))
    };
    let targets: Vec<PathBuf> = files.iter().map(|(name, _)| folder.join(name)).collect();
    let files: Vec<(&Path, &[u8])> = targets
        .iter()
        .zip(files)
        .map(|(target, (_, bytes))| (target.as_path(), *bytes))
        .collect();
    write_all(&files)?;
    if let Some(made) = made {
        made.keep();
    }
    Ok(())
}

/// A folder that is removed again, if it is empty, unless it is kept.
struct MadeFolder<'a>(&'a Path);

impl MadeFolder<'_> {
    fn keep(self) {
        unfinished().retain(|other| other != self.0);
        std::mem::forget(self);
    }
}

impl Drop for MadeFolder<'_> {
    fn drop(&mut self) {
        unfinished().retain(|other| other != self.0);
        // A folder that is not empty holds finished files and stays.
        let _ = fs::remove_dir(self.0);
    }
}

/// On an interrupt (Ctrl-C, termination): removes what is unfinished and exits with
/// status 130. For a command's `main`; calling it twice has no effect.
pub fn clean_up_on_interrupt() {
    // Fails only where a handler is set already.
    let _ = ctrlc::set_handler(|| {
        let list = unfinished();
        // Folders come before what was put into them.
        for path in list.iter().rev() {
            let _ = fs::remove_file(path).or_else(|_| fs::remove_dir(path));
        }
        // Still under the lock: no new file can appear.
        std::process::exit(130);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_committed_file_replaces_and_leaves_nothing_beside() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a.asp");
        write_atomic(&target, b"old").unwrap();
        write_atomic(&target, b"new").unwrap();
        assert_eq!(fs::read(&target).unwrap(), b"new");
        assert_eq!(entries(folder.path()), ["a.asp"]);
    }

    #[test]
    fn an_abandoned_file_leaves_the_target_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a.asp");
        write_atomic(&target, b"old").unwrap();
        let mut file = AtomicFile::create(&target).unwrap();
        file.write_all(b"half").unwrap();
        drop(file);
        assert_eq!(fs::read(&target).unwrap(), b"old");
        assert_eq!(entries(folder.path()), ["a.asp"]);
    }

    #[test]
    fn a_missing_folder_and_a_folder_as_target_are_errors() {
        let folder = tempfile::tempdir().unwrap();
        let missing = write_atomic(&folder.path().join("no/a.asp"), b"x").unwrap_err();
        assert_eq!(missing.source.kind(), io::ErrorKind::NotFound);
        let is_folder = write_atomic(folder.path(), b"x").unwrap_err();
        assert_eq!(is_folder.source.kind(), io::ErrorKind::IsADirectory);
    }

    #[test]
    fn a_failed_folder_leaves_nothing() {
        let parent = tempfile::tempdir().unwrap();
        let folder = parent.path().join("out");
        let files = [
            ("a.asp".to_owned(), b"a".as_slice()),
            ("no/b.asp".to_owned(), b"b".as_slice()),
        ];
        assert!(write_folder(&folder, &files).is_err());
        assert!(!folder.exists());
        assert!(write_folder(&folder, &files[..1]).is_ok());
        assert_eq!(entries(&folder), ["a.asp"]);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_device_is_written_to_not_replaced() {
        let full = write_atomic(Path::new("/dev/full"), b"x").unwrap_err();
        assert_eq!(full.source.kind(), io::ErrorKind::StorageFull);
        write_atomic(Path::new("/dev/null"), b"x").unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }
}
