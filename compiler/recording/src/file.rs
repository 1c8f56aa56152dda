//! Files that end: what else a path may lead to would be read for ever.

use crate::error::{Problem, RecordingError};
use asperity_io::input::{Format, HEAD};
use std::{
    fs::File,
    io::{Read as _, Seek as _},
    path::Path,
};

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

#[cfg(test)]
mod tests {
    use super::*;

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
