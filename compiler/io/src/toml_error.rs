//! Where a TOML file is wrong, in one line.

use crate::shown::shortened;
use std::{fmt, ops::Range};

/// Characters of the line that are shown on each side of the place.
const SHOWN: usize = 30;

/// A place in a TOML file, and what is wrong there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TomlError {
    /// Line, 1-based.
    pub line: usize,
    /// Column in characters, 1-based.
    pub column: usize,
    /// Message of the parser, in one line.
    pub message: String,
    /// The line around the place, at most 60 characters of it.
    pub near: String,
}

impl TomlError {
    /// The place of an error in the text that was parsed.
    #[must_use]
    pub fn new(text: &str, error: &toml::de::Error) -> Self {
        let Range { start, .. } = error.span().unwrap_or_default();
        let before = shortened(text, start);
        let after = &text[before.len()..];
        let begun = before.rsplit('\n').next().unwrap_or_default();
        let rest = after.lines().next().unwrap_or_default();
        let column = begun.chars().count();
        let near = begun.chars().skip(column.saturating_sub(SHOWN));
        Self {
            line: 1 + before.matches('\n').count(),
            column: 1 + column,
            message: error.message().trim().replace('\n', "; "),
            near: near.chain(rest.chars().take(SHOWN)).collect(),
        }
    }
}

impl TomlError {
    /// Place and reason without the line itself, for a file whose text is not to be shown.
    #[must_use]
    pub fn without_text(&self) -> String {
        let (line, column, message) = (self.line, self.column, &self.message);
        format!("line {line}, column {column}: {message}")
    }
}

impl fmt::Display for TomlError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.without_text())?;
        match self.near.trim() {
            "" => Ok(()),
            near => write!(f, ", near `{near}`"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wrong(text: &str) -> TomlError {
        let error = toml::from_str::<toml::Table>(text).unwrap_err();
        TomlError::new(text, &error)
    }

    #[test]
    fn the_place_is_named_and_a_long_line_is_not_repeated() {
        let error = wrong("a = 1\nä = what\n");
        assert_eq!((error.line, error.near.as_str()), (2, "ä = what"));
        let long = wrong(&format!("a = \"{}\" b\n", "x".repeat(1_000_000)));
        assert_eq!(long.line, 1);
        assert!(long.to_string().len() < 300, "{}", long.to_string().len());
        assert_eq!(wrong("a = [1,\n2").line, 2);
    }
}
