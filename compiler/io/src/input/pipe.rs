//! A pipe whose waits end.
//!
//! Opening a pipe waits for its writer, and reading waits for bytes; neither can be called off. So a
//! thread does both, and its reader waits for the thread only so long. The thread of a pipe that was
//! given up ends with the process.

use super::{
    pipe_timeout::{MAX_SILENCE, MAX_WAIT},
    problem::InputProblem,
};
use std::{
    fs::File,
    io::{self, Read},
    path::Path,
    sync::mpsc::{Receiver, RecvTimeoutError, sync_channel},
    thread,
    time::{Duration, Instant},
};

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
    consumed: usize,
    waited: Duration,
}

impl Pipe {
    pub(super) fn open(path: &Path) -> Result<Self, InputProblem> {
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
            consumed: 0,
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
        if self.consumed == self.chunk.len() {
            self.chunk = self.next_chunk()?;
            self.consumed = 0;
        }
        let left = &self.chunk[self.consumed..];
        let len = left.len().min(buffer.len());
        buffer[..len].copy_from_slice(&left[..len]);
        self.consumed += len;
        Ok(len)
    }
}
