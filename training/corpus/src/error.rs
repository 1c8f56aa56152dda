//! Why a corpus cannot be used.

use asperity_io::diagnostic::Diagnostic;
use std::path::PathBuf;
use thiserror::Error;

/// Largest number of faults printed; the others are counted.
const SHOWN: usize = 20;

/// Why a corpus cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CorpusError {
    /// A file or folder cannot be read.
    #[error("{}: {source}", path.display())]
    Unreadable {
        /// The path.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// A folder without any material.
    #[error("{}: no material file in it", path.display())]
    Empty {
        /// The folder.
        path: PathBuf,
    },
    /// A file that is not TOML or has other fields.
    #[error("{file}: {message}")]
    Syntax {
        /// The file.
        file: String,
        /// Line, field and fault.
        message: String,
    },
    /// Entries break the rules of the corpus.
    #[error("{}", summary(faults))]
    Faults {
        /// The faults, a line each: file, material, field, fault.
        faults: Vec<String>,
    },
    /// A folder of HaTT models that cannot be used.
    #[error(transparent)]
    Hatt(#[from] crate::hatt::HattCorpusError),
}

fn summary(faults: &[String]) -> String {
    let mut lines: Vec<String> = faults.iter().take(SHOWN).cloned().collect();
    if faults.len() > SHOWN {
        lines.push(format!("and {} more", faults.len() - SHOWN));
    }
    lines.join("\n")
}

impl Diagnostic for CorpusError {
    fn remedy(&self) -> String {
        match self {
            Self::Unreadable { .. } => "give a folder that can be read".into(),
            Self::Empty { .. } => "give a folder of TOML files, one a family".into(),
            Self::Syntax { .. } | Self::Faults { .. } => {
                "correct the entry; training/corpora/README.md states the rules".into()
            }
            Self::Hatt(error) => error.remedy(),
        }
    }
}
