//! Bytes that can be read anywhere: of a file, or of all that came through a pipe.

use super::error::{MAX_ASSET_BYTES, SourceProblem};
use std::{
    fs::File,
    io::{self, Cursor, Read, Seek, SeekFrom},
    path::Path,
};

/// The path that means standard input.
pub(super) const STANDARD_INPUT: &str = "-";

/// A file, or what came through a pipe.
#[derive(Debug)]
pub(super) enum Bytes {
    File(File),
    Piped(Cursor<Vec<u8>>),
}

impl Bytes {
    /// Opens a path; `-` is standard input. A pipe is read to its end, up to the largest asset.
    pub(super) fn open(path: &Path) -> Result<Self, SourceProblem> {
        if path == Path::new(STANDARD_INPUT) {
            return piped(io::stdin().lock());
        }
        let file = File::open(path)?;
        // A folder is refused by its first read.
        if file.metadata()?.is_file() || path.is_dir() {
            Ok(Self::File(file))
        } else {
            piped(file)
        }
    }

    /// Number of bytes.
    pub(super) fn len(&self) -> io::Result<u64> {
        match self {
            Self::File(file) => Ok(file.metadata()?.len()),
            Self::Piped(bytes) => Ok(bytes.get_ref().len() as u64),
        }
    }
}

fn piped(pipe: impl Read) -> Result<Bytes, SourceProblem> {
    let mut bytes = Vec::new();
    pipe.take(MAX_ASSET_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_ASSET_BYTES {
        let bytes = bytes.len() as u64;
        return Err(SourceProblem::TooLarge { bytes });
    }
    Ok(Bytes::Piped(Cursor::new(bytes)))
}

impl Read for Bytes {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::File(file) => file.read(buffer),
            Self::Piped(bytes) => bytes.read(buffer),
        }
    }
}

impl Seek for Bytes {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match self {
            Self::File(file) => file.seek(to),
            Self::Piped(bytes) => bytes.seek(to),
        }
    }
}
