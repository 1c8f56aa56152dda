//! The key of a texture: everything that decides its bytes.

use asperity_io::input::{self, InputError, InputKind, InputProblem};
use sha2::{Digest as _, Sha256};
use std::{
    fmt,
    io::{BufRead as _, BufReader, Read as _},
    path::Path,
};

/// A SHA-256, as a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Key([u8; 32]);

impl Key {
    /// The digest of bytes.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        Self(Sha256::digest(bytes).into())
    }

    /// Its bytes.
    #[must_use]
    pub fn bytes(&self) -> &[u8; 32] {
        &self.0
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

fn named(file: &Path) -> String {
    let name = file.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// Takes the parts of a key. Each is written with its length, so that no two lists of parts give
/// the same bytes.
#[derive(Clone)]
pub struct Parts(Sha256);

impl Parts {
    /// Parts of one kind of key.
    #[must_use]
    pub fn new(kind: &str) -> Self {
        Self(Sha256::new()).text(kind)
    }

    /// The next part.
    #[must_use]
    pub fn part(mut self, bytes: &[u8]) -> Self {
        self.0.update((bytes.len() as u64).to_le_bytes());
        self.0.update(bytes);
        self
    }

    /// The next part, a text.
    #[must_use]
    pub fn text(self, text: &str) -> Self {
        self.part(text.as_bytes())
    }

    /// The next part, a number, to the bit.
    #[must_use]
    pub fn number(self, number: f64) -> Self {
        self.part(&number.to_bits().to_le_bytes())
    }

    /// The next parts, the name and the content of a file of a kind.
    ///
    /// # Errors
    /// [`InputError`] for a file that cannot be read.
    pub fn file(self, file: &Path, kind: InputKind) -> Result<Self, InputError> {
        let bytes = input::read(file, kind).map_err(|problem| InputError {
            file: file.to_owned(),
            problem,
        })?;
        Ok(self.text(&named(file)).part(Key::of(&bytes).bytes()))
    }

    /// The same of a file of any kind, which may be long.
    ///
    /// # Errors
    /// As [`file`](Self::file).
    pub fn stream(self, file: &Path) -> Result<Self, InputError> {
        let kind = InputKind::Log;
        let mut content = Sha256::new();
        let read = input::open(file).and_then(|opened| {
            let mut limited = BufReader::new(opened.take(kind.max_bytes() + 1));
            let mut read = 0;
            loop {
                let bytes = limited.fill_buf()?;
                let count = bytes.len();
                content.update(bytes);
                limited.consume(count);
                read += count as u64;
                if count == 0 {
                    return Ok(());
                }
                if read > kind.max_bytes() {
                    return Err(InputProblem::TooLarge { kind });
                }
            }
        });
        read.map_err(|problem| InputError {
            file: file.to_owned(),
            problem,
        })?;
        Ok(self.text(&named(file)).part(&content.finalize()))
    }

    /// The key of all parts.
    #[must_use]
    pub fn key(self) -> Key {
        Key(self.0.finalize().into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_do_not_run_into_each_other() {
        let key = |a: &str, b: &str| Parts::new("test").text(a).text(b).key();
        assert_ne!(key("ab", "c"), key("a", "bc"));
        assert_ne!(Parts::new("x").key(), Parts::new("y").key());
        assert_eq!(key("a", "b"), key("a", "b"));
        let nothing = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        assert_eq!(Key::of(b"").to_string(), nothing);
    }
}
