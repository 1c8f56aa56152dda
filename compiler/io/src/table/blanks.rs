//! Columns that runs of blanks separate, as if one tab did.

use std::io::{self, Read};

/// A reader that gives a tab for each run of blanks, and none for those before a line.
#[derive(Debug)]
pub(super) struct Blanks<R> {
    inner: R,
    active: bool,
    /// True if the previous byte was a blank or a line end.
    after_gap: bool,
}

impl<R> Blanks<R> {
    /// A reader that leaves everything as it is unless it is `active`.
    pub(super) const fn new(inner: R, active: bool) -> Self {
        Self {
            inner,
            active,
            after_gap: true,
        }
    }
}

impl<R: Read> Read for Blanks<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            let count = self.inner.read(buffer)?;
            if !self.active || count == 0 {
                return Ok(count);
            }
            let mut kept = 0;
            for at in 0..count {
                let byte = match buffer[at] {
                    b' ' | b'\t' => b'\t',
                    other => other,
                };
                let is_gap = byte == b'\t';
                if !(is_gap && self.after_gap) {
                    buffer[kept] = byte;
                    kept += 1;
                }
                self.after_gap = is_gap || matches!(byte, b'\n' | b'\r');
            }
            if kept > 0 {
                return Ok(kept);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_blanks_are_one_tab_wherever_a_read_ends() {
        let text = "  a   b \t c  \n\n   1  2 3\r\n 4";
        let expected = "a\tb\tc\t\n\n1\t2\t3\r\n4";
        for size in 1..text.len() {
            let mut read = String::new();
            let mut blanks = Blanks::new(text.as_bytes(), true);
            let mut buffer = vec![0; size];
            loop {
                let count = blanks.read(&mut buffer).expect("bytes");
                if count == 0 {
                    break;
                }
                read += std::str::from_utf8(&buffer[..count]).expect("text");
            }
            assert_eq!(read, expected, "{size}");
        }
        let mut same = String::new();
        Blanks::new(text.as_bytes(), false)
            .read_to_string(&mut same)
            .expect("bytes");
        assert_eq!(same, text);
    }
}
