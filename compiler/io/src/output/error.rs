//! Why an output cannot be written.

use crate::{diagnostic::Diagnostic, system};
use std::{io, path::PathBuf};
use thiserror::Error;

/// Why an output could not be written.
#[derive(Debug, Error)]
#[error("{path}: {doing}", path = path.display())]
pub struct OutputError {
    /// The output.
    pub path: PathBuf,
    /// The operation that failed.
    pub doing: &'static str,
    /// Why.
    pub source: io::Error,
}

impl Diagnostic for OutputError {
    fn remedy(&self) -> String {
        if let Some(remedy) = system::remedy(&self.source) {
            return remedy.into();
        }
        match self.source.kind() {
            io::ErrorKind::NotFound => "create the folder first, or give another path".into(),
            io::ErrorKind::PermissionDenied => {
                "give a path that you may write to, or change its permissions".into()
            }
            io::ErrorKind::IsADirectory => "give a path for a file, not a folder".into(),
            io::ErrorKind::NotADirectory => "give a folder, not a file".into(),
            io::ErrorKind::DirectoryNotEmpty => {
                "give a new folder, or remove what is in this one".into()
            }
            io::ErrorKind::AlreadyExists => "give another path, or remove it first".into(),
            _ => "check the path and the disk".into(),
        }
    }
}

/// Why the outputs of a command cannot be opened together.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OpenError {
    /// The output is also an input or another output.
    #[error("{output}: the output is also {other}", output = output.display())]
    Same {
        /// The output.
        output: PathBuf,
        /// The other role of the path: `an input`, `another output` or `standard output`.
        other: &'static str,
    },
    /// Two new files whose names differ in case alone.
    #[error(
        "{output}: it differs from {other} only in upper and lower case, which some file systems take for the same",
        output = output.display(),
        other = other.display()
    )]
    Case {
        /// The output.
        output: PathBuf,
        /// The other output.
        other: PathBuf,
    },
    /// Two files were to go to standard output.
    #[error("two outputs go to standard output")]
    TwoToStandardOutput,
    /// An output cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

impl Diagnostic for OpenError {
    fn remedy(&self) -> String {
        match self {
            Self::Same { .. } | Self::Case { .. } => "give each output its own path".into(),
            Self::TwoToStandardOutput => "give `-` for one of them and a path for the other".into(),
            Self::Output(error) => error.remedy(),
        }
    }

    fn is_usage(&self) -> bool {
        !matches!(self, Self::Output(_))
    }
}
