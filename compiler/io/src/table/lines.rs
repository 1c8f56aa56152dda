//! Lines that end, all in LF: a file without line ends would be read into memory whole.

use std::io::{self, Read};

/// Longest line of a table, bytes.
const MAX_LINE: usize = 64 * 1024;

/// A reader that gives LF for CR LF and for CR, and fails where a line is longer than any table has.
#[derive(Debug)]
pub(super) struct Lines<R> {
    inner: R,
    /// Bytes since the last line end.
    length: usize,
    after_cr: bool,
}

impl<R> Lines<R> {
    pub(super) const fn new(inner: R) -> Self {
        Self {
            inner,
            length: 0,
            after_cr: false,
        }
    }
}

impl<R: Read> Read for Lines<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let room = buffer.len().min(MAX_LINE);
        loop {
            let count = self.inner.read(&mut buffer[..room])?;
            let mut kept = 0;
            for at in 0..count {
                let byte = buffer[at];
                if byte != b'\n' || !self.after_cr {
                    buffer[kept] = if byte == b'\r' { b'\n' } else { byte };
                    self.length = if buffer[kept] == b'\n' {
                        0
                    } else {
                        self.length + 1
                    };
                    kept += 1;
                }
                self.after_cr = byte == b'\r';
                if self.length > MAX_LINE {
                    return Err(io::Error::other("a line is longer than 64 KiB"));
                }
            }
            if kept > 0 || count == 0 {
                return Ok(kept);
            }
        }
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
}
