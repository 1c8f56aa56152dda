//! Scheduling policy of a thread.

use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// Scheduling policy of a thread.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Policy {
    /// The default policy.
    Other,
    /// Ahead of every ordinary thread, until it sleeps.
    Fifo {
        /// Priority, 1 to 99; higher runs first.
        priority: u8,
    },
    /// A budget in every period, guaranteed by the kernel.
    Deadline {
        /// Processor time in a period, percent.
        percent: u8,
    },
}

/// Why a text is no policy.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "`{0}` is not a policy: write other, fifo, fifo:1 to fifo:99, deadline, or deadline:5 to deadline:90 (percent of a period)"
)]
pub struct PolicyError(String);

impl FromStr for Policy {
    type Err = PolicyError;

    fn from_str(text: &str) -> Result<Self, PolicyError> {
        let (name, number) = match text.split_once(':') {
            Some((name, number)) => (name, Some(number.parse::<u8>())),
            None => (text, None),
        };
        let number = |otherwise| match &number {
            None => Some(otherwise),
            Some(Ok(number)) => Some(*number),
            Some(Err(_)) => None,
        };
        let policy = match name {
            "other" if !text.contains(':') => Some(Self::Other),
            "fifo" => number(80)
                .filter(|priority| (1..=99).contains(priority))
                .map(|priority| Self::Fifo { priority }),
            "deadline" => number(50)
                .filter(|percent| (5..=90).contains(percent))
                .map(|percent| Self::Deadline { percent }),
            _ => None,
        };
        policy.ok_or_else(|| PolicyError(text.into()))
    }
}

impl fmt::Display for Policy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Other => f.write_str("SCHED_OTHER"),
            Self::Fifo { priority } => write!(f, "SCHED_FIFO {priority}"),
            Self::Deadline { percent } => write!(f, "SCHED_DEADLINE {percent} % of a period"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn policies_are_read_and_what_is_none_is_refused() {
        let parse = |text: &str| text.parse::<Policy>();
        assert_eq!(parse("other"), Ok(Policy::Other));
        assert_eq!(parse("fifo"), Ok(Policy::Fifo { priority: 80 }));
        assert_eq!(parse("fifo:5"), Ok(Policy::Fifo { priority: 5 }));
        assert_eq!(parse("deadline:20"), Ok(Policy::Deadline { percent: 20 }));
        for bad in [
            "",
            "fifo:",
            "fifo:0",
            "fifo:100",
            "deadline:99",
            "rr",
            "other:1",
        ] {
            assert!(parse(bad).is_err(), "{bad}");
        }
    }
}
