//! Which file a path means, however it is spelt.

use super::{
    links::{folder, followed},
    stream::is_standard_output,
};
use same_file::Handle;
use std::{
    fs,
    hash::{DefaultHasher, Hash as _, Hasher as _},
    path::{Path, PathBuf},
};

/// A file as the system knows it, or the place where it is going to be.
#[derive(Debug)]
pub(super) enum Identity {
    /// A file that is there: the same through links, hard links and any spelling of its name.
    There(FileId),
    /// A place without a file, or with one that cannot be opened.
    New(PathBuf),
    /// A pipe, a terminal, a device: never replaced.
    Stream,
}

impl Identity {
    /// Identifies an input; `-` is standard input.
    pub(super) fn of_input(path: &Path) -> Self {
        if path == Path::new("-") {
            return regular(Handle::stdin());
        }
        Self::of_path(path)
    }

    /// Identifies an output; `-` is standard output.
    pub(super) fn of_output(path: &Path) -> Self {
        if is_standard_output(path) {
            return Self::standard_output();
        }
        Self::of_path(path)
    }

    /// Identifies standard output, which the shell may have redirected to a file.
    pub(super) fn standard_output() -> Self {
        regular(Handle::stdout())
    }

    fn of_path(path: &Path) -> Self {
        match fs::metadata(path) {
            // Opening a pipe would wait for its other end.
            Ok(metadata) if !metadata.is_file() => Self::Stream,
            Ok(_) => Handle::from_path(path)
                .map_or_else(|_| Self::New(followed(path)), |file| Self::There(id(file))),
            Err(_) => Self::New(followed(path)),
        }
    }

    /// Returns true if both are the same file.
    pub(super) fn is(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::There(one), Self::There(two)) => one == two,
            (Self::New(one), Self::New(two)) => one == two,
            _ => false,
        }
    }

    /// A hash of a file that is there.
    pub(super) fn hashed(&self) -> Option<u64> {
        let Self::There(file) = self else {
            return None;
        };
        let mut hasher = DefaultHasher::new();
        file.hash(&mut hasher);
        Some(hasher.finish())
    }

    /// The place of a new file, the same for names that differ in case alone: a file system that
    /// does not tell case apart has one file for both.
    pub(super) fn caseless(&self) -> Option<(PathBuf, String)> {
        match self {
            Self::New(path) => {
                let name = path.file_name()?.to_string_lossy().to_lowercase();
                Some((folder(path).to_owned(), name))
            }
            _ => None,
        }
    }
}

/// Identity of an existing file. On Unix it needs no open file, of which a process may have few.
#[cfg(unix)]
type FileId = (u64, u64);
#[cfg(not(unix))]
type FileId = Handle;

#[cfg(unix)]
fn id(file: Handle) -> FileId {
    (file.dev(), file.ino())
}

#[cfg(not(unix))]
fn id(file: Handle) -> FileId {
    file
}

/// Identifies an open file, which may be a pipe or a terminal.
fn regular(handle: std::io::Result<Handle>) -> Identity {
    match handle {
        Ok(handle) if handle.as_file().metadata().is_ok_and(|m| m.is_file()) => {
            Identity::There(id(handle))
        }
        _ => Identity::Stream,
    }
}
