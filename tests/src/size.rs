//! Size of the heavy tests: `ASPERITY_TEST_SIZE`, by default `small`.
//!
//! `small` suits a newcomer's patience. `full` backs the published claims; `.ci/full` runs it in release. Neither
//! follows the profile. A test that has both prints the size it ran at, which `--nocapture` shows.

use std::fmt::Display;

/// The variable that sets the size of all tests.
pub const VARIABLE: &str = "ASPERITY_TEST_SIZE";

/// Size of the heavy tests.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Size {
    /// A sample of every claim, for a build with checks.
    Small,
    /// Every claim as it is published.
    Full,
}

impl Size {
    /// The size that the environment asks for.
    ///
    /// # Panics
    ///
    /// If the variable is neither `small` nor `full`.
    #[must_use]
    pub fn asked() -> Self {
        Self::parse(&variable(VARIABLE).unwrap_or_default())
            .unwrap_or_else(|text| panic!("{VARIABLE}={text}: must be small or full"))
    }

    fn parse(text: &str) -> Result<Self, &str> {
        match text {
            "" | "small" => Ok(Self::Small),
            "full" => Ok(Self::Full),
            other => Err(other),
        }
    }

    /// The value for this size.
    pub fn of<T>(self, small: T, full: T) -> T {
        match self {
            Self::Small => small,
            Self::Full => full,
        }
    }
}

/// A variable of the environment; bytes that are no text become ones that no reader takes.
fn variable(name: &str) -> Option<String> {
    std::env::var_os(name).map(|text| text.to_string_lossy().into_owned())
}

/// The fewest of `count` that hold a share. In a sample it is rounded down: rounded up, a few would have to hold
/// without exception.
#[must_use]
pub fn least(share: f64, count: usize) -> usize {
    let exact = share * count as f64;
    Size::asked().of(exact.floor(), exact.ceil()) as usize
}

/// The value for the size that the environment asks for, printed with what it counts.
pub fn sized<T: Display>(what: &str, small: T, full: T) -> T {
    let size = Size::asked();
    let value = size.of(small, full);
    println!("{what}: {value} ({VARIABLE}={})", size.of("small", "full"));
    value
}

/// [`sized`], or the number in a variable of the test's own.
///
/// # Panics
///
/// If the variable holds no number.
#[must_use]
pub fn sized_or(variable: &str, what: &str, small: usize, full: usize) -> usize {
    let Some(text) = self::variable(variable) else {
        return sized(what, small, full);
    };
    let count = text
        .parse()
        .unwrap_or_else(|_| panic!("{variable}={text}: must be a number"));
    println!("{what}: {count} ({variable})");
    count
}

#[cfg(test)]
mod tests {
    use super::Size;

    #[test]
    fn a_size_that_does_not_exist_is_no_small_one() {
        assert_eq!(Size::parse(""), Ok(Size::Small));
        assert_eq!(Size::parse("small"), Ok(Size::Small));
        assert_eq!(Size::parse("full"), Ok(Size::Full));
        assert_eq!(Size::parse("Full"), Err("Full"));
        assert_eq!(Size::parse("large"), Err("large"));
    }
}
