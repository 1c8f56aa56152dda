//! Opening what must be a file: opening a pipe waits for its writer, and a device need not end.

use std::{fs::File, io, path::Path};

/// Opens a regular file, or what a link to one leads to.
pub(crate) fn open(path: &Path) -> io::Result<File> {
    if std::fs::metadata(path)?.is_file() {
        File::open(path)
    } else {
        let kind = io::ErrorKind::InvalidInput;
        Err(io::Error::new(kind, "not a regular file: copy it into one"))
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_pipe_without_a_writer_is_refused_at_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let pipe = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.is_ok_and(|status| status.success()));
        for other in [pipe.as_path(), folder.path(), Path::new("/dev/zero")] {
            let error = open(other).expect_err("no file");
            assert_eq!(error.kind(), io::ErrorKind::InvalidInput, "{other:?}");
        }
        let file = folder.path().join("file");
        std::fs::write(&file, "text").expect("a file");
        assert!(open(&file).is_ok());
    }
}
