//! Files that end: what else a path may lead to would be read for ever.

use crate::remedy::{self, unreadable};
use asperity_io::{
    diagnostic::Fault,
    input::{Format, HEAD},
};
use std::{
    fs::File,
    io::{Read as _, Seek as _},
    path::Path,
};

/// Opens a regular file with something in it. Pipes, sockets and devices have no end and are refused,
/// and so are files of other known formats than a recording has, by their names.
pub(crate) fn open(path: &Path) -> Result<File, Fault> {
    let metadata = std::fs::metadata(path).map_err(unreadable(path))?;
    if !metadata.is_file() {
        return Err(Fault::new("is no file with an end", remedy::FORMAT).at(path));
    }
    if metadata.len() == 0 {
        return Err(Fault::new("is empty", "copy or record it again").at(path));
    }
    let mut file = File::open(path).map_err(unreadable(path))?;
    let mut start = Vec::new();
    (&mut file)
        .take(HEAD as u64)
        .read_to_end(&mut start)
        .and_then(|_| file.rewind())
        .map_err(unreadable(path))?;
    let fault = match Format::of(&start) {
        None | Some(Format::Wav | Format::Numpy) => return Ok(file),
        Some(Format::LfsPointer) => Fault::new(
            "is a Git LFS pointer, not the data: the file was never downloaded",
            "run `git lfs pull` where the file comes from",
        ),
        Some(other) => {
            let what = format!("is {}, not part of a recording", other.name());
            Fault::new(what, other.remedy())
        }
    };
    Err(fault.at(path))
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
