//! Which file a path means, however it is spelt.

use super::{
    links::{folder, followed},
    stream::is_standard_output,
};
use same_file::Handle;
use std::{
    fs,
    path::{Path, PathBuf},
};

/// A file as the system knows it, or the place where it is going to be.
#[derive(Debug)]
pub(super) enum Identity {
    /// A file that is there: the same through links, hard links and any spelling of its name.
    There(Handle),
    /// A place without a file, or with one that cannot be opened.
    New(PathBuf),
    /// A pipe, a terminal, a device: never replaced.
    Stream,
}

impl Identity {
    /// Of an input; `-` is standard input.
    pub(super) fn of_input(path: &Path) -> Self {
        if path == Path::new("-") {
            return regular(Handle::stdin());
        }
        Self::of_path(path)
    }

    /// Of an output; `-` is standard output.
    pub(super) fn of_output(path: &Path) -> Self {
        if is_standard_output(path) {
            return Self::standard_output();
        }
        Self::of_path(path)
    }

    /// Of standard output, which the shell may have redirected to a file.
    pub(super) fn standard_output() -> Self {
        regular(Handle::stdout())
    }

    fn of_path(path: &Path) -> Self {
        match fs::metadata(path) {
            // Opening a pipe would wait for its other end.
            Ok(metadata) if !metadata.is_file() => Self::Stream,
            Ok(_) => {
                Handle::from_path(path).map_or_else(|_| Self::New(followed(path)), Self::There)
            }
            Err(_) => Self::New(followed(path)),
        }
    }

    /// Whether both are one file.
    pub(super) fn is(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::There(one), Self::There(two)) => one == two,
            (Self::New(one), Self::New(two)) => one == two,
            _ => false,
        }
    }

    /// Whether both are places in one folder whose names differ in case alone. A file system that
    /// does not tell case apart has one file for both.
    pub(super) fn differs_in_case_from(&self, other: &Self) -> bool {
        let lower = |path: &Path| path.file_name().map(|n| n.to_string_lossy().to_lowercase());
        match (self, other) {
            (Self::New(one), Self::New(two)) => {
                folder(one) == folder(two) && lower(one) == lower(two)
            }
            _ => false,
        }
    }
}

/// Of an open file that may be a pipe or a terminal.
fn regular(handle: std::io::Result<Handle>) -> Identity {
    match handle {
        Ok(handle) if handle.as_file().metadata().is_ok_and(|m| m.is_file()) => {
            Identity::There(handle)
        }
        _ => Identity::Stream,
    }
}
