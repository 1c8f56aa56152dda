//! Why a file is no recording that can be read.

use thiserror::Error;

/// Why a recording cannot be read or written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SessionLogError {
    /// The system refused to read or write.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// The file begins with other bytes.
    #[error("this is no recording: it begins with {found:02x?}, and a recording with `ASPR`")]
    Foreign {
        /// The first bytes.
        found: Vec<u8>,
    },
    /// A newer version.
    #[error("this recording has version {found}, and this program reads version {known}")]
    Version {
        /// Its version.
        found: u16,
        /// Ours.
        known: u16,
    },
    /// The file ends, or is damaged, before the conditions are complete.
    #[error("the conditions of this recording are damaged: {why}")]
    Conditions {
        /// Reason.
        why: String,
    },
    /// A block whose checksum is right, but not its contents.
    #[error("block at byte {at}: {why}")]
    Malformed {
        /// Where the block begins.
        at: u64,
        /// Description of the defect.
        why: &'static str,
    },
    /// The thread that writes has ended before its time.
    #[error("the writing thread ended by itself")]
    Writer,
}

impl SessionLogError {
    /// Returns a remedy for the user.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::Io(_) => "check the path, your rights and the space on the disk",
            Self::Foreign { .. } => "name a file that `servo -o` wrote",
            Self::Version { .. } => {
                "read it with the version of Asperity that wrote it, or a newer one"
            }
            Self::Conditions { .. } | Self::Malformed { .. } => {
                "record the session again; what wrote this file was no Asperity, or the file was changed"
            }
            Self::Writer => "report this as a bug",
        }
    }
}
