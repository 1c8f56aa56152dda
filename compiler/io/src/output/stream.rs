//! Outputs that no file can replace: standard output, pipes and devices.

use std::{
    fs::File,
    io::{self, Seek as _, SeekFrom, Write},
    path::Path,
};
use tempfile::SpooledTempFile;

/// Bytes that are kept in memory before a temporary file takes them.
const IN_MEMORY: usize = 16 << 20;

/// Names of standard output. A path that leads there, as to a file that the shell redirected it
/// to, must not be replaced: what is printed later would go to the file that is gone.
const STANDARD_OUTPUT: [&str; 4] = ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];

/// Returns true if a path denotes standard output: `-`, or the system's names for it.
#[must_use]
pub fn is_standard_output(path: &Path) -> bool {
    STANDARD_OUTPUT.iter().any(|name| path.as_os_str() == *name)
}

/// Returns the name of an output for a report.
#[must_use]
pub fn display(path: &Path) -> std::path::Display<'_> {
    if is_standard_output(path) {
        Path::new("standard output").display()
    } else {
        path.display()
    }
}

/// Returns true if a path names an open file of this process, which is written to, not replaced.
pub(super) fn is_open_file(path: &Path) -> bool {
    path == Path::new("/dev/stderr")
        || path.starts_with("/dev/fd")
        || path.starts_with("/proc/self/fd")
}

/// Where the bytes go in the end.
#[derive(Debug)]
pub(super) enum Sink {
    StandardOutput,
    File(File),
}

/// An output that cannot be replaced: bytes are held back until they are complete.
#[derive(Debug)]
pub(super) struct Stream {
    sink: Sink,
    held: SpooledTempFile,
}

impl Stream {
    pub(super) fn to(sink: Sink) -> Self {
        let held = tempfile::spooled_tempfile(IN_MEMORY);
        Self { sink, held }
    }

    pub(super) fn is_standard_output(&self) -> bool {
        matches!(self.sink, Sink::StandardOutput)
    }

    pub(super) fn held(&mut self) -> &mut impl Write {
        &mut self.held
    }

    /// Hands everything over. A reader that has gone away, as `head` does, is no failure.
    pub(super) fn release(&mut self) -> io::Result<()> {
        self.held.seek(SeekFrom::Start(0))?;
        let released = match &mut self.sink {
            Sink::StandardOutput => {
                let mut stdout = io::stdout().lock();
                io::copy(&mut self.held, &mut stdout).and_then(|_| stdout.flush())
            }
            Sink::File(file) => io::copy(&mut self.held, file).and_then(|_| file.flush()),
        };
        match released {
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error),
            _ => Ok(()),
        }
    }
}
