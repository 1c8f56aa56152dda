//! The body of a request, read only by those who want it and only up to their limit.

use super::{answer::Status, deadline::Timed, head::slow};
use crate::error::ApiError;
use asperity_io::shown::size;
use std::io::{self, ErrorKind, Read, Write};

/// Bytes for which room is made before they have come.
const AHEAD: u64 = 1 << 20;

/// A body that may not have come yet.
pub(crate) struct Body<'a, 's> {
    from: Source<'a, 's>,
    /// Bytes as the head states them.
    length: u64,
    read: bool,
}

enum Source<'a, 's> {
    Connection {
        /// With the deadline of the request.
        stream: &'a mut Timed<'s>,
        /// Bytes that came with the head.
        buffer: &'a mut Vec<u8>,
        expects_continue: bool,
    },
    Memory(Vec<u8>),
}

impl From<Vec<u8>> for Body<'_, '_> {
    /// A body of one who asks within the program.
    fn from(bytes: Vec<u8>) -> Self {
        Self {
            length: bytes.len() as u64,
            from: Source::Memory(bytes),
            read: false,
        }
    }
}

impl<'a, 's> Body<'a, 's> {
    pub(crate) fn new(
        stream: &'a mut Timed<'s>,
        buffer: &'a mut Vec<u8>,
        length: u64,
        expects_continue: bool,
    ) -> Self {
        Self {
            from: Source::Connection {
                stream,
                buffer,
                expects_continue,
            },
            length,
            read: false,
        }
    }

    /// Returns true if none of it is left on the connection.
    pub(crate) fn is_over(&self) -> bool {
        self.read || self.length == 0
    }

    /// The bytes.
    ///
    /// # Errors
    /// For more than `most` of them, for a connection that ends before they do, and at the deadline.
    pub(crate) fn read(&mut self, most: u64) -> Result<Vec<u8>, ApiError> {
        let length = self.length;
        if length > most {
            return Err(ApiError::new(
                Status::TooLarge,
                format!("{} bytes are too many: {} at most", length, size(most)),
                "give a smaller file or a shorter prompt",
            ));
        }
        let bytes = match &mut self.from {
            Source::Memory(bytes) => std::mem::take(bytes),
            Source::Connection {
                stream,
                buffer,
                expects_continue,
            } => received(stream, buffer, length, *expects_continue).map_err(|e| ended(&e))?,
        };
        self.read = true;
        Ok(bytes)
    }
}

/// A body of `length` bytes, of which the first are in `buffer`.
fn received(
    stream: &mut Timed<'_>,
    buffer: &mut Vec<u8>,
    length: u64,
    expects_continue: bool,
) -> io::Result<Vec<u8>> {
    if expects_continue {
        stream.write_all(b"HTTP/1.1 100 Continue\r\n\r\n")?;
    }
    let mut bytes = Vec::with_capacity(length.min(AHEAD) as usize);
    let came = (length as usize).min(buffer.len());
    bytes.extend(buffer.drain(..came));
    let rest = length - came as u64;
    stream.take(rest).read_to_end(&mut bytes)?;
    if (bytes.len() as u64) < length {
        return Err(ErrorKind::UnexpectedEof.into());
    }
    Ok(bytes)
}

fn ended(error: &io::Error) -> ApiError {
    match error.kind() {
        ErrorKind::TimedOut => slow(),
        _ => ApiError::new(
            Status::BadRequest,
            "the request ended before its body did",
            "send it again",
        ),
    }
}
