//! Reading a file whole, up to the limit of its kind.

use super::{
    kind::InputKind,
    open::{Opened, open},
    problem::InputProblem,
};
use std::{
    io::{self, Read},
    path::Path,
};

/// The bytes of a file.
///
/// # Errors
/// [`InputProblem`] for a file that cannot be read, has more bytes than its kind may, or is of another
/// [`Format`](super::Format).
pub fn read(path: &Path, kind: InputKind) -> Result<Vec<u8>, InputProblem> {
    let opened = open(path)?;
    if let Opened::File(file) = &opened
        && file.metadata().map_err(InputProblem::Unreadable)?.len() > kind.max_bytes()
    {
        return Err(InputProblem::TooLarge { kind });
    }
    to_end(opened, kind)
}

/// All bytes of a reader, such as standard input.
///
/// # Errors
/// As [`read`].
pub fn to_end(reader: impl Read, kind: InputKind) -> Result<Vec<u8>, InputProblem> {
    let mut bytes = Vec::new();
    let limit = kind.max_bytes();
    // One byte more tells a file of just the limit from a larger one.
    reader
        .take(limit + 1)
        .read_to_end(&mut bytes)
        .map_err(|error: io::Error| InputProblem::from(error))?;
    admit(&bytes, kind)?;
    Ok(bytes)
}

/// Checks the size and the format of a file's bytes against its kind.
///
/// # Errors
/// [`InputProblem`] for more bytes than the kind may have, for an empty file where the kind must not be empty, and for
/// those of another [`Format`](super::Format).
pub fn admit(bytes: &[u8], kind: InputKind) -> Result<(), InputProblem> {
    if bytes.len() as u64 > kind.max_bytes() {
        return Err(InputProblem::TooLarge { kind });
    }
    kind.check_content(bytes)?;
    kind.check(kind.format(bytes))
}

/// The text of a file in UTF-8, without a byte order mark.
///
/// # Errors
/// As [`read`], and [`InputProblem::NotUtf8`].
pub fn read_text(path: &Path, kind: InputKind) -> Result<String, InputProblem> {
    let bytes = read(path, kind)?;
    text(&bytes).map(str::to_owned)
}

/// Bytes as text, without a byte order mark.
///
/// # Errors
/// [`InputProblem::Utf16`] and [`InputProblem::NotUtf8`].
pub fn text(bytes: &[u8]) -> Result<&str, InputProblem> {
    // With a mark, or two ASCII characters of two bytes each.
    let zeros = |first: usize| [first, first + 2].map(|at| bytes.get(at) == Some(&0));
    let is_wide = (zeros(0) == [true; 2]) != (zeros(1) == [true; 2]);
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") || is_wide {
        return Err(InputProblem::Utf16);
    }
    let text = std::str::from_utf8(bytes).map_err(|error| InputProblem::NotUtf8 {
        offset: error.valid_up_to(),
    })?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}
