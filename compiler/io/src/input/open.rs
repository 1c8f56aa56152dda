//! Opening a file: what kind of thing it is decides whether and how it is read.

use super::{
    format::{Format, HEAD},
    kind::InputKind,
    pipe::Pipe,
    problem::InputProblem,
    signatures::POINTER_BYTES,
};
use std::{
    fs::{self, File, FileType},
    io::{self, Read, Seek as _},
    path::Path,
};

/// Bytes in which the keys of a document are looked for.
const TOLD: u64 = 64 * 1024;

/// A file that may be read.
#[derive(Debug)]
pub enum Opened {
    /// A regular file, in which one can seek.
    File(File),
    /// A pipe, whose bytes come once.
    Pipe(Pipe),
}

impl Read for Opened {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::File(file) => file.read(buffer),
            Self::Pipe(pipe) => pipe.read(buffer),
        }
    }
}

/// Opens a regular file or a pipe; symbolic links are followed.
///
/// # Errors
/// [`InputProblem`] for a path that cannot be opened, a folder, a device, a socket or a pointer of Git LFS.
pub fn open(path: &Path) -> Result<Opened, InputProblem> {
    // Before it is opened: opening can wait for a pipe's writer, and change a device.
    let found = fs::metadata(path)
        .map_err(InputProblem::Unreadable)?
        .file_type();
    if found.is_dir() {
        return Err(InputProblem::Folder);
    }
    if is_pipe(found) {
        return Ok(Opened::Pipe(Pipe::open(path)?));
    }
    if !found.is_file() {
        return Err(InputProblem::Device);
    }
    let mut file = File::open(path).map_err(InputProblem::Unreadable)?;
    if is_pointer(&mut file).map_err(InputProblem::Unreadable)? {
        return Err(InputProblem::LfsPointer);
    }
    Ok(Opened::File(file))
}

/// Opens a file of a kind that is not read as a whole.
///
/// # Errors
/// As [`open`], and [`InputProblem::OtherFormat`] for a regular file whose first bytes are of another format.
pub fn open_as(path: &Path, kind: InputKind) -> Result<Opened, InputProblem> {
    let mut opened = open(path)?;
    if let Opened::File(file) = &mut opened {
        let bytes = head(file, HEAD as u64).map_err(InputProblem::Unreadable)?;
        kind.check(Format::of_magic(&bytes))?;
    }
    Ok(opened)
}

/// The format of a file, as far as its first bytes tell.
///
/// # Errors
/// As [`open`].
pub fn format_of(path: &Path) -> Result<Option<Format>, InputProblem> {
    match open(path)? {
        Opened::File(mut file) => {
            let bytes = head(&mut file, TOLD).map_err(InputProblem::Unreadable)?;
            Ok(Format::of(&bytes))
        }
        // What is looked at is gone from a pipe.
        Opened::Pipe(_) => Ok(None),
    }
}

/// Returns true if the file is a Git LFS pointer.
fn is_pointer(file: &mut File) -> io::Result<bool> {
    if file.metadata()?.len() > POINTER_BYTES {
        return Ok(false);
    }
    Ok(Format::of_magic(&head(file, POINTER_BYTES)?) == Some(Format::LfsPointer))
}

/// The first bytes of a file, which is at its beginning again afterwards.
fn head(file: &mut File, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(most).read_to_end(&mut bytes)?;
    file.rewind()?;
    Ok(bytes)
}

#[cfg(unix)]
fn is_pipe(found: FileType) -> bool {
    std::os::unix::fs::FileTypeExt::is_fifo(&found)
}

#[cfg(not(unix))]
fn is_pipe(_: FileType) -> bool {
    false
}
