//! Lines that end, all in LF, and rows that end: the parser keeps a row in memory, however long it is, and an open
//! quotation mark makes one of all the rest.

use std::{
    cell::Cell,
    io::{self, Read},
    rc::Rc,
};
use thiserror::Error;

/// Most bytes of a row.
pub(super) const MAX_ROW: usize = 64 * 1024;
/// Bytes that the parser reads at once.
pub(super) const BUFFER: usize = 8 * 1024;

/// A row without an end.
#[derive(Debug, Error)]
#[error("a row takes more than {MAX_ROW} bytes")]
pub(super) struct TooLong;

/// A reader that gives LF for CR LF and for CR, and fails where a row is longer than any table has.
#[derive(Debug)]
pub(super) struct Lines<R> {
    inner: R,
    /// Bytes since the row before was complete: the row's, and what the parser reads ahead.
    row: Rc<Cell<usize>>,
    after_cr: bool,
}

impl<R> Lines<R> {
    /// A reader whose caller sets `row` to 0 where a row begins.
    pub(super) const fn new(inner: R, row: Rc<Cell<usize>>) -> Self {
        Self {
            inner,
            row,
            after_cr: false,
        }
    }
}

impl<R: Read> Read for Lines<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            if self.row.get() > MAX_ROW + BUFFER {
                return Err(io::Error::other(TooLong));
            }
            let count = self.inner.read(buffer)?;
            self.row.set(self.row.get() + count);
            let mut kept = 0;
            for at in 0..count {
                let byte = buffer[at];
                if byte != b'\n' || !self.after_cr {
                    buffer[kept] = if byte == b'\r' { b'\n' } else { byte };
                    kept += 1;
                }
                self.after_cr = byte == b'\r';
            }
            if kept > 0 || count == 0 {
                return Ok(kept);
            }
        }
    }
}
