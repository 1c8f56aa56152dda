//! A file that is written in full or not at all.

use super::{
    error::OutputError,
    links::{folder, followed},
    stream::{Sink, Stream, is_open_file, is_standard_output},
    unfinished::unfinished,
};
use std::{
    collections::BTreeSet,
    fs::{self, OpenOptions},
    io::{self, Write},
    path::{Path, PathBuf},
};
use tempfile::{NamedTempFile, TempPath};

/// A file that is being written: write to it, then [`commit`](AtomicFile::commit).
///
/// If it is dropped before, the target stays as it was. A file that is replaced keeps its
/// permissions. Standard output (`-`) and a target that is no regular file (a pipe, a device)
/// cannot be replaced: they get everything at once, on commit.
#[derive(Debug)]
pub struct AtomicFile {
    target: PathBuf,
    destination: Destination,
}

#[derive(Debug)]
enum Destination {
    Beside {
        /// `None` once it has its name.
        file: Option<Temporary>,
        /// The target without links.
        path: PathBuf,
    },
    Stream(Stream),
}

/// A file that has no name of its own yet, and is removed when it is dropped.
#[derive(Debug)]
enum Temporary {
    Open(NamedTempFile),
    Complete(TempPath),
}

impl Temporary {
    fn path(&self) -> &Path {
        match self {
            Self::Open(file) => file.path(),
            Self::Complete(path) => path,
        }
    }

    /// Persisting replaces the target on every system. On failure the file is removed.
    fn persist(self, path: &Path) -> io::Result<()> {
        match self {
            Self::Open(file) => file.persist(path).map(drop).map_err(|error| error.error),
            Self::Complete(file) => file.persist(path).map_err(|error| error.error),
        }
    }
}

impl AtomicFile {
    /// Starts a file for `target`, whose folder must exist.
    ///
    /// # Errors
    /// [`OutputError`] for a missing folder, a folder at `target`, a file that is read-only, or
    /// no permission.
    pub fn create(target: &Path) -> Result<Self, OutputError> {
        let fail = |doing, source| OutputError {
            path: target.to_owned(),
            doing,
            source,
        };
        if is_standard_output(target) {
            return Ok(Self {
                target: "standard output".into(),
                destination: Destination::Stream(Stream::to(Sink::StandardOutput)),
            });
        }
        let existing = fs::metadata(target).ok();
        if existing.as_ref().is_some_and(fs::Metadata::is_dir) {
            let source = io::Error::from(io::ErrorKind::IsADirectory);
            return Err(fail("cannot write a file there", source));
        }
        if existing.as_ref().is_some_and(|m| !m.is_file()) || is_open_file(target) {
            let file = OpenOptions::new()
                .write(true)
                .open(target)
                .map_err(|e| fail("cannot open it for writing", e))?;
            return Ok(Self {
                target: target.to_owned(),
                destination: Destination::Stream(Stream::to(Sink::File(file))),
            });
        }
        if let Some(metadata) = &existing {
            // A rename asks the folder alone, so a protected file would be lost.
            writable(target, metadata).map_err(|e| match e.kind() {
                io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
                    fail("it is read-only", e)
                }
                _ => fail("cannot open it for writing", e),
            })?;
        }
        // Of a symbolic link, the file that it points to is replaced.
        let file = Self::beside(target, followed(target))?;
        let kept = match (existing, &file.destination) {
            (
                Some(metadata),
                Destination::Beside {
                    file: Some(Temporary::Open(file)),
                    ..
                },
            ) => file.as_file().set_permissions(metadata.permissions()),
            _ => Ok(()),
        };
        kept.map_err(|e| file.error("cannot keep its permissions", e))?;
        Ok(file)
    }

    /// Starts a file that takes the place of whatever is at `target`, a symbolic link, a pipe and a
    /// protected file included, and that has the permissions of a new one.
    ///
    /// # Errors
    /// [`OutputError`] for a missing folder or no permission.
    pub fn replacing(target: &Path) -> Result<Self, OutputError> {
        Self::beside(target, target.to_owned())
    }

    /// Starts a file beside `path`, which is what `target` means.
    fn beside(target: &Path, path: PathBuf) -> Result<Self, OutputError> {
        let fail = |doing, source| OutputError {
            path: target.to_owned(),
            doing,
            source,
        };
        let folder = folder(&path);
        fs::metadata(folder).map_err(|e| fail("cannot reach its folder", e))?;
        // Under the lock, so that an interrupt sees every file that is there.
        let mut list = unfinished();
        // Made as any new file, with the permissions that the umask leaves, and with errors that do not
        // name it: its name means nothing to a user.
        let file = tempfile::Builder::new()
            .prefix(".asperity-")
            .make_in(folder, |path| fs::File::create_new(path))
            .map_err(|e| fail("cannot write into its folder", e))?;
        list.insert(file.path().to_path_buf());
        Ok(Self {
            target: target.to_owned(),
            destination: Destination::Beside {
                file: Some(Temporary::Open(file)),
                path,
            },
        })
    }

    /// The file that is written.
    #[must_use]
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Returns true if the bytes go to standard output.
    #[must_use]
    pub fn is_standard_output(&self) -> bool {
        matches!(&self.destination, Destination::Stream(stream) if stream.is_standard_output())
    }

    /// Returns true if the target is not a regular file, such as a pipe or a terminal.
    #[must_use]
    pub fn is_stream(&self) -> bool {
        matches!(self.destination, Destination::Stream(_))
    }

    /// Makes what was written the target, replacing what was there.
    ///
    /// # Errors
    /// [`OutputError`]; the target is then as it was.
    pub fn commit(mut self) -> Result<(), OutputError> {
        self.release()?;
        self.rename(&mut unfinished())
    }

    /// Hands over what a stream has been given. Does nothing to a file.
    pub(super) fn release(&mut self) -> Result<(), OutputError> {
        let released = match &mut self.destination {
            Destination::Stream(stream) => stream.release(),
            Destination::Beside { .. } => Ok(()),
        };
        released.map_err(|source| self.error("cannot write it", source))
    }

    /// Gives a file its name, under the lock of the list. Does nothing to a stream.
    pub(super) fn rename(&mut self, list: &mut BTreeSet<PathBuf>) -> Result<(), OutputError> {
        let Destination::Beside { file, path } = &mut self.destination else {
            return Ok(());
        };
        let Some(file) = file.take() else {
            return Ok(());
        };
        let beside = file.path().to_path_buf();
        let persisted = file.persist(path);
        list.remove(&beside);
        persisted.map_err(|source| self.error("cannot finish it", source))
    }

    /// Writes all of `bytes`.
    ///
    /// # Errors
    /// [`OutputError`] with the target.
    pub fn fill(&mut self, bytes: &[u8]) -> Result<(), OutputError> {
        self.write_all(bytes)
            .map_err(|source| self.error("cannot write it", source))
    }

    /// Ends the writing, and frees what an open file takes. Does nothing to a stream.
    ///
    /// # Errors
    /// [`OutputError`] for what could not be written.
    pub(super) fn close(&mut self) -> Result<(), OutputError> {
        self.flush()
            .map_err(|source| self.error("cannot write it", source))?;
        if let Destination::Beside { file, .. } = &mut self.destination {
            *file = file.take().map(|file| match file {
                Temporary::Open(file) => Temporary::Complete(file.into_temp_path()),
                complete @ Temporary::Complete(_) => complete,
            });
        }
        Ok(())
    }

    /// An error about this file.
    #[must_use]
    pub fn error(&self, doing: &'static str, source: io::Error) -> OutputError {
        OutputError {
            path: self.target.clone(),
            doing,
            source,
        }
    }
}

/// Refuses a file that its owner has protected, or that this user may not write to.
fn writable(target: &Path, metadata: &fs::Metadata) -> io::Result<()> {
    if metadata.permissions().readonly() {
        return Err(io::ErrorKind::PermissionDenied.into());
    }
    match OpenOptions::new().write(true).open(target) {
        // A program that is running is busy, but may be replaced.
        Err(error) if error.kind() != io::ErrorKind::ExecutableFileBusy => Err(error),
        _ => Ok(()),
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if let Destination::Beside { file, .. } = &mut self.destination
            && let Some(file) = file.take()
        {
            // Removed before it leaves the list.
            let mut list = unfinished();
            let path = file.path().to_path_buf();
            drop(file);
            list.remove(&path);
        }
    }
}

// Written to the file itself: errors of the temporary file name it.
impl Write for AtomicFile {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        match &mut self.destination {
            Destination::Beside {
                file: Some(Temporary::Open(file)),
                ..
            } => file.as_file_mut().write(buffer),
            Destination::Beside { .. } => Err(io::ErrorKind::NotFound.into()),
            Destination::Stream(stream) => stream.held().write(buffer),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.destination {
            Destination::Beside {
                file: Some(Temporary::Open(file)),
                ..
            } => file.as_file_mut().flush(),
            Destination::Beside { .. } => Ok(()),
            Destination::Stream(stream) => stream.held().flush(),
        }
    }
}
