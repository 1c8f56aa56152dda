//! Files that end, and lines that end: what else a path may lead to would be read for ever.

use crate::error::{Problem, RecordingError};
use asperity_io::input::{Format, HEAD};
use std::{
    fs::File,
    io::{self, Read, Seek as _},
    path::Path,
};

/// Longest line of a table, bytes.
const MAX_LINE: usize = 64 * 1024;

/// Opens a regular file with something in it. Pipes, sockets and devices have no end and are refused,
/// and so are files of other known formats than a recording has, by their names.
pub(crate) fn open(path: &Path) -> Result<File, RecordingError> {
    let unreadable = |error| RecordingError::of(path, Problem::Unreadable(error));
    let metadata = std::fs::metadata(path).map_err(unreadable)?;
    if !metadata.is_file() {
        let problem = Problem::Format("is no file with an end".into());
        return Err(RecordingError::of(path, problem));
    }
    if metadata.len() == 0 {
        let problem = Problem::File {
            what: "is empty".into(),
            remedy: "copy or record it again",
        };
        return Err(RecordingError::of(path, problem));
    }
    let mut file = File::open(path).map_err(unreadable)?;
    let mut start = Vec::new();
    (&mut file)
        .take(HEAD as u64)
        .read_to_end(&mut start)
        .and_then(|_| file.rewind())
        .map_err(unreadable)?;
    let problem = match Format::of(&start) {
        None | Some(Format::Wav | Format::Numpy) => return Ok(file),
        Some(Format::LfsPointer) => Problem::Pointer,
        Some(other) => Problem::File {
            what: format!("is {}, not part of a recording", other.name()),
            remedy: other.remedy(),
        },
    };
    Err(RecordingError::of(path, problem))
}

/// A reader that fails where a line is longer than any table has.
#[derive(Debug)]
pub(crate) struct Lines<R> {
    inner: R,
    /// Bytes since the last line end.
    length: usize,
}

impl<R> Lines<R> {
    pub(crate) fn new(inner: R) -> Self {
        Self { inner, length: 0 }
    }
}

impl<R: Read> Read for Lines<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let room = buffer.len().min(MAX_LINE);
        let count = self.inner.read(&mut buffer[..room])?;
        let is_end = |byte: &u8| matches!(byte, b'\n' | b'\r');
        self.length = match buffer[..count].iter().rposition(is_end) {
            Some(end) => count - end - 1,
            None => self.length + count,
        };
        if self.length > MAX_LINE {
            return Err(io::Error::other("a line is longer than 64 KiB"));
        }
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_may_be_many_and_not_endless() {
        let mut text = String::new();
        let many = "1,2\n".repeat(100_000);
        Lines::new(many.as_bytes())
            .read_to_string(&mut text)
            .expect("short lines");
        assert_eq!(text.len(), many.len());
        // The longest line, after an end, read in two parts.
        for (length, fits) in [(MAX_LINE, true), (MAX_LINE + 1, false)] {
            let text = format!("1\n{}", "x".repeat(length));
            let read =
                Lines::new(text.as_bytes()).read_to_end(&mut Vec::with_capacity(4 * MAX_LINE));
            assert_eq!(read.is_ok(), fits, "{length}");
        }
        let error = Lines::new(io::repeat(0))
            .read_to_end(&mut Vec::new())
            .expect_err("endless");
        assert!(error.to_string().contains("longer than 64 KiB"));
    }

    #[test]
    fn what_is_no_recording_is_called_what_it_is() {
        let folder = tempfile::tempdir().expect("a folder");
        for (content, word) in [
            (
                "version https://git-lfs.github.com/spec/v1\noid sha256:11\nsize 9\n",
                "pointer",
            ),
            ("PK\x03\x04\x14\0xl/workbook.xml", "Excel workbook"),
            ("<!DOCTYPE html><title>Sign in</title>", "web page"),
            ("", "is empty"),
        ] {
            let path = folder.path().join("accel.wav");
            std::fs::write(&path, content).expect("written");
            let error = open(&path).expect_err(word);
            assert!(error.to_string().contains(word), "{error}");
        }
    }

    #[test]
    fn a_device_is_no_file() {
        let error = open(Path::new(if cfg!(unix) { "/dev/zero" } else { "." })).expect_err("none");
        assert!(error.to_string().contains("is no file"), "{error}");
    }
}
