//! Why nothing can be recorded.

use asperity_io::diagnostic::Diagnostic;
use std::io;

/// Why a sensor gives nothing, or gives no more.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SensorError {
    /// The name of a sensor is none.
    #[error("`{name}`: {why}")]
    Name {
        /// As it was given.
        name: String,
        /// The problem.
        why: String,
    },
    /// It cannot be opened.
    #[error("{name}: cannot open it: {cause}")]
    Open {
        /// The port or file.
        name: String,
        /// Why.
        cause: io::Error,
    },
    /// It cannot be read any more.
    #[error("{name}: cannot read it: {cause}")]
    Read {
        /// The port or file.
        name: String,
        /// Why.
        cause: io::Error,
    },
    /// Nothing came for some time.
    #[error("{name}: {what} for {seconds} s")]
    Stalled {
        /// The port or file.
        name: String,
        /// The event that did not happen.
        what: &'static str,
        /// The wait, s.
        seconds: u64,
    },
    /// It was unplugged, or whoever wrote has gone.
    #[error("{0}: the data ended; was the sensor unplugged?")]
    Ended(String),
    /// The data is not the line protocol.
    #[error("{name}: {count} consecutive lines are not samples, such as `{example}`")]
    Garbage {
        /// The port.
        name: String,
        /// Consecutive bad lines.
        count: u32,
        /// A bad line, shortened and escaped.
        example: String,
    },
    /// A line does not end.
    #[error("{name}: a line has more than {most} bytes")]
    LongLine {
        /// The port.
        name: String,
        /// Most bytes.
        most: usize,
    },
    /// Its header is wrong, missing or another one than before.
    #[error("{name}: its header {why}")]
    Header {
        /// The port or file.
        name: String,
        /// The problem.
        why: String,
    },
    /// Its own clock or count went back.
    #[error("{name}: the sensor restarted: its clock went back from {before} to {now}")]
    Restarted {
        /// The port.
        name: String,
        /// The last value.
        before: f64,
        /// The one after.
        now: f64,
    },
    /// A followed file was shortened, replaced or changed.
    #[error("{name}: {what} while it was read")]
    Changed {
        /// The file.
        name: String,
        /// The change.
        what: &'static str,
    },
}

impl Diagnostic for SensorError {
    fn is_usage(&self) -> bool {
        matches!(self, Self::Name { .. })
    }

    fn remedy(&self) -> String {
        match self {
            Self::Name { .. } => {
                "write serial:PORT?baud=115200, wav:FILE?g=16 or sim:, as --help says".into()
            }
            Self::Open { cause, .. } if cause.kind() == io::ErrorKind::PermissionDenied => {
                "join the group of the port, often `dialout`, and log in again".into()
            }
            Self::Open { .. } => {
                "plug it in, or give another port; `ls /dev/serial/by-id` lists them".into()
            }
            Self::Read { .. } | Self::Ended(_) => "check the cable, and record again".into(),
            Self::Stalled { .. } => {
                "check that the board, or the program that writes the file, is running".into()
            }
            Self::Garbage { .. } | Self::LongLine { .. } => {
                "check ?baud=, and that the board sends lines of numbers as docs/recording.md says"
                    .into()
            }
            Self::Header { .. } => {
                "let the board send `#t_us,ax_g,ay_g,az_g` every second, or give ?columns=; check ?baud="
                    .into()
            }
            Self::Restarted { .. } => "check the power supply of the board, and record again".into(),
            Self::Changed { .. } => {
                "let the other program write one file from beginning to end".into()
            }
        }
    }
}
