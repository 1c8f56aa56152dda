//! Why a file could not be read.

use super::{
    format::Format,
    kind::InputKind,
    pipe_timeout::{MAX_SILENCE, MAX_WAIT},
};
use crate::{diagnostic::Diagnostic, system};
use std::{io, path::PathBuf};
use thiserror::Error;

/// Why a file could not be read.
#[derive(Debug, Error)]
#[error("{}: {problem}", file.display())]
pub struct InputError {
    /// The file.
    pub file: PathBuf,
    /// The fault.
    pub problem: InputProblem,
}

/// A fault of an input file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum InputProblem {
    /// The system cannot read it.
    #[error("cannot read it: {0}")]
    Unreadable(io::Error),
    /// It is a folder.
    #[error("cannot read it: a folder, not a file")]
    Folder,
    /// It is a device or a socket, which may have no end.
    #[error("cannot read it: a device or a socket, which may have no end")]
    Device,
    /// It is larger than its kind may be.
    #[error("larger than {limit} bytes, the limit for {kind}", limit = kind.max_bytes())]
    TooLarge {
        /// The kind that was expected.
        kind: InputKind,
    },
    /// A pipe gave no byte for [`MAX_SILENCE`].
    #[error("cannot read it: the pipe gave nothing for {} s", MAX_SILENCE.as_secs_f32())]
    Silent,
    /// Waits for the bytes of a pipe took [`MAX_WAIT`] in all.
    #[error("cannot read it: waiting for the pipe took {} s in all", MAX_WAIT.as_secs())]
    Slow,
    /// It is what Git LFS leaves in the place of a file.
    #[error("a Git LFS pointer, not the file itself")]
    LfsPointer,
    /// It is of another format.
    #[error("{}, not {wanted}", format.name())]
    OtherFormat {
        /// The format that was detected.
        format: Format,
        /// The format that was expected, with an article.
        wanted: Box<str>,
    },
    /// There is nothing in it but space or zeros.
    #[error("the file is empty")]
    Empty,
    /// It is UTF-16, of which UTF-8 is expected.
    #[error("a text in UTF-16, not in UTF-8")]
    Utf16,
    /// It is not UTF-8.
    #[error("byte {offset} is not UTF-8")]
    NotUtf8 {
        /// First offending byte.
        offset: usize,
    },
}

impl InputProblem {
    /// Returns the remedy: a step for the user, in one sentence.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Unreadable(error) => system::remedy(error)
                .unwrap_or("check the path and its permissions")
                .into(),
            Self::Folder | Self::Device => "give the path of a file, or of a pipe".into(),
            Self::TooLarge { kind } => {
                format!("{}; docs/limits.md lists the limits", kind.remedy())
            }
            Self::Silent | Self::Slow => {
                "check what writes into the pipe, or write to a file first and give that".into()
            }
            Self::LfsPointer => Format::LfsPointer.remedy().into(),
            Self::OtherFormat { format, .. } => format.remedy().into(),
            Self::Empty => "copy or export the file again".into(),
            Self::Utf16 | Self::NotUtf8 { .. } => "save the file as text in UTF-8".into(),
        }
    }
}

impl InputKind {
    /// Refuses bytes that hold nothing, where every file of this kind holds something.
    pub(super) fn check_content(self, bytes: &[u8]) -> Result<(), InputProblem> {
        let holds = matches!(self, Self::Asset | Self::Hatt | Self::Model | Self::Effects);
        let is_nothing = |byte: &u8| *byte == 0 || byte.is_ascii_whitespace();
        if holds && bytes.iter().all(is_nothing) {
            return Err(InputProblem::Empty);
        }
        Ok(())
    }

    /// Refuses a format that a file of this kind cannot have.
    pub(super) fn check(self, found: Option<Format>) -> Result<(), InputProblem> {
        match found {
            Some(Format::LfsPointer) => Err(InputProblem::LfsPointer),
            Some(format) if !self.takes(format) => Err(InputProblem::OtherFormat {
                format,
                wanted: self.to_string().into(),
            }),
            _ => Ok(()),
        }
    }
}

impl Diagnostic for InputError {
    fn remedy(&self) -> String {
        self.problem.remedy()
    }
}

/// Readers that know only of [`io::Error`] hand a problem through.
impl From<InputProblem> for io::Error {
    fn from(problem: InputProblem) -> Self {
        match problem {
            InputProblem::Unreadable(error) => error,
            other => Self::other(other),
        }
    }
}

impl From<io::Error> for InputProblem {
    fn from(error: io::Error) -> Self {
        match error.downcast::<Self>() {
            Ok(problem) => problem,
            Err(error) => Self::Unreadable(error),
        }
    }
}
