//! Opening a file: what kind of thing it is decides whether and how it is read.

use super::{
    format::{Format, HEAD, POINTER_BYTES},
    kind::Kind,
    pipe_timeout::{MAX_SILENCE, MAX_WAIT},
    problem::InputProblem,
};
use std::{
    fs::{self, File, FileType},
    io::{self, Read, Seek as _},
    path::Path,
    sync::mpsc::{Receiver, RecvTimeoutError, sync_channel},
    thread,
    time::{Duration, Instant},
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
pub fn open_as(path: &Path, kind: Kind) -> Result<Opened, InputProblem> {
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

/// Whether a file is a pointer of Git LFS.
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

// A pipe whose waits end.
//
// Opening a pipe waits for its writer, and reading waits for bytes; neither can be called off. So a
// thread does both, and its reader waits for the thread only so long. The thread of a pipe that was
// given up ends with the process.

/// Bytes that the thread hands over at once.
const CHUNK_BYTES: usize = 64 * 1024;
/// Chunks that may wait for the reader.
const CHUNKS: usize = 2;

/// A pipe, read by a thread of its own.
#[derive(Debug)]
pub struct Pipe {
    chunks: Receiver<io::Result<Vec<u8>>>,
    /// The chunk that is handed out, and how much of it has been.
    chunk: Vec<u8>,
    taken: usize,
    waited: Duration,
}

impl Pipe {
    fn open(path: &Path) -> Result<Self, InputProblem> {
        let (sender, chunks) = sync_channel(CHUNKS);
        let path = path.to_owned();
        let read = move || {
            let mut file = match File::open(path) {
                Ok(file) => file,
                Err(error) => {
                    // Nobody is left to tell where this fails, here and below.
                    let _ = sender.send(Err(error));
                    return;
                }
            };
            loop {
                let mut chunk = vec![0; CHUNK_BYTES];
                let message = file.read(&mut chunk).map(|len| {
                    chunk.truncate(len);
                    chunk
                });
                let is_last = message.as_ref().map_or(true, Vec::is_empty);
                if sender.send(message).is_err() || is_last {
                    return;
                }
            }
        };
        thread::Builder::new()
            .spawn(read)
            .map_err(InputProblem::Unreadable)?;
        Ok(Self {
            chunks,
            chunk: Vec::new(),
            taken: 0,
            waited: Duration::ZERO,
        })
    }

    /// The next bytes of the pipe; none at its end.
    fn next_chunk(&mut self) -> Result<Vec<u8>, InputProblem> {
        let from = Instant::now();
        let left = MAX_WAIT.saturating_sub(self.waited);
        let message = self.chunks.recv_timeout(left.min(MAX_SILENCE));
        self.waited += from.elapsed();
        match message {
            Ok(chunk) => chunk.map_err(InputProblem::Unreadable),
            // The last message was an empty chunk or an error.
            Err(RecvTimeoutError::Disconnected) => Ok(Vec::new()),
            Err(RecvTimeoutError::Timeout) if self.waited >= MAX_WAIT => Err(InputProblem::Slow),
            Err(RecvTimeoutError::Timeout) => Err(InputProblem::Silent),
        }
    }
}

impl Read for Pipe {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.taken == self.chunk.len() {
            self.chunk = self.next_chunk()?;
            self.taken = 0;
        }
        let left = &self.chunk[self.taken..];
        let len = left.len().min(buffer.len());
        buffer[..len].copy_from_slice(&left[..len]);
        self.taken += len;
        Ok(len)
    }
}
