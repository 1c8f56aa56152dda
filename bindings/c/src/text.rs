//! A text in memory of C's.

use core::{
    ffi::c_char,
    fmt::{self, Write},
    mem::MaybeUninit,
};

/// A text being written into memory of C's. It always ends with a null.
pub(crate) struct Text<'a> {
    memory: &'a mut [MaybeUninit<c_char>],
    len: usize,
    /// True if the text was truncated.
    cut: bool,
}

impl<'a> Text<'a> {
    /// An empty text; without room for its null there is none.
    pub(crate) fn new(memory: &'a mut [MaybeUninit<c_char>]) -> Self {
        let mut text = Self {
            memory,
            len: 0,
            cut: false,
        };
        text.end();
        text
    }

    /// Returns true if the text was truncated.
    pub(crate) const fn is_cut(&self) -> bool {
        self.cut
    }

    fn end(&mut self) {
        if let Some(last) = self.memory.get_mut(self.len) {
            last.write(0);
        }
    }
}

impl Write for Text<'_> {
    /// Never fails. Cuts between characters what does not fit.
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for character in text.chars() {
            let mut four = [0; 4];
            let bytes = character.encode_utf8(&mut four).as_bytes();
            if self.cut || self.len + bytes.len() >= self.memory.len() {
                self.cut = true;
                break;
            }
            for byte in bytes {
                self.memory[self.len].write(*byte as c_char);
                self.len += 1;
            }
        }
        self.end();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_text_is_cut_between_characters() {
        let mut memory = [MaybeUninit::uninit(); 250];
        let mut text = Text::new(&mut memory);
        for _ in 0..200 {
            text.write_str("µ²").unwrap();
        }
        assert_eq!((text.len, text.cut), (248, true));
    }
}
