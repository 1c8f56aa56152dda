//! The body of a request, read only by those who want it and only up to their limit.

use super::{answer::Status, deadline::Timed, head::slow};
use crate::error::ApiError;
use asperity_io::shown::size;
use std::io::{ErrorKind, Read, Write};

/// Bytes for which room is made before they have come.
const AHEAD: u64 = 1 << 20;

/// A body that may not have come yet.
pub(crate) struct Body<'a, 's> {
    /// The connection, with the deadline of the request.
    stream: &'a mut Timed<'s>,
    /// What came with the head.
    buffer: &'a mut Vec<u8>,
    /// Bytes as the head states them.
    length: u64,
    expects_continue: bool,
    read: bool,
}

impl<'a, 's> Body<'a, 's> {
    pub(crate) fn new(
        stream: &'a mut Timed<'s>,
        buffer: &'a mut Vec<u8>,
        length: u64,
        expects_continue: bool,
    ) -> Self {
        Self {
            stream,
            buffer,
            length,
            expects_continue,
            read: false,
        }
    }

    /// Whether nothing of it is left on the connection.
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
        if self.expects_continue {
            let go_on = b"HTTP/1.1 100 Continue\r\n\r\n";
            self.stream.write_all(go_on).map_err(|e| ended(&e))?;
        }
        let mut bytes = Vec::with_capacity(length.min(AHEAD) as usize);
        let came = (length as usize).min(self.buffer.len());
        bytes.extend(self.buffer.drain(..came));
        let rest = length - came as u64;
        let more = Read::by_ref(self.stream).take(rest).read_to_end(&mut bytes);
        more.map_err(|e| ended(&e))?;
        if (bytes.len() as u64) < length {
            return Err(ended(&ErrorKind::UnexpectedEof.into()));
        }
        self.read = true;
        Ok(bytes)
    }
}

fn ended(error: &std::io::Error) -> ApiError {
    match error.kind() {
        ErrorKind::TimedOut => slow(),
        _ => ApiError::new(
            Status::BadRequest,
            "the request ended before its body did",
            "send it again",
        ),
    }
}
