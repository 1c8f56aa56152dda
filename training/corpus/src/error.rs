//! Why a corpus cannot be used.

use crate::{BINS, SAMPLE_RATE_HZ};
use asperity_io::diagnostic::{Diagnostic, Fault};
use std::path::PathBuf;
use thiserror::Error;

/// Largest number of faults printed; the others are counted.
const SHOWN: usize = 20;
/// Largest number of names printed; the others are counted.
const SHOWN_NAMES: usize = 10;

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
    Hatt(#[from] HattCorpusError),
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

/// Why a folder of HaTT models cannot be used as a corpus.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum HattCorpusError {
    /// The folder or a file of it was refused.
    #[error(transparent)]
    Source(#[from] Fault),
    /// Materials without captions of ours.
    #[error("no captions for {}", listed(unknown))]
    NoCaptions {
        /// Files with the names they state.
        unknown: Vec<(PathBuf, String)>,
    },
    /// Models at another rate than the corpus: a change of rate is a conversion.
    #[error("{}: SampleRate = {found}, must be {SAMPLE_RATE_HZ} Hz", file.display())]
    SampleRate {
        /// The file.
        file: PathBuf,
        /// The rate, Hz.
        found: f64,
    },
    /// A model whose spectrum has no all-pole form in double precision.
    #[error("{}: model {model} has no ordered LSFs at order {}", file.display(), crate::ORDER)]
    Unconvertible {
        /// The file.
        file: PathBuf,
        /// Number of the model, 1-based as in the file.
        model: usize,
    },
    /// A material whose models all lie on the border or are silent.
    #[error("{}: no sounding model inside the grid", file.display())]
    Silent {
        /// The file.
        file: PathBuf,
    },
    /// Fewer places on the speed–force plane than bins.
    #[error("{}: {found} places of sounding models, at least {BINS} wanted", folder.display())]
    TooFewSamples {
        /// The folder.
        folder: PathBuf,
        /// Places found.
        found: usize,
    },
}

fn listed(unknown: &[(PathBuf, String)]) -> String {
    let mut names: Vec<String> = unknown
        .iter()
        .take(SHOWN_NAMES)
        .map(|(file, name)| format!("material {name:?} of {}", file.display()))
        .collect();
    if unknown.len() > SHOWN_NAMES {
        names.push(format!("{} more", unknown.len() - SHOWN_NAMES));
    }
    names.join(", ")
}

impl Diagnostic for HattCorpusError {
    fn remedy(&self) -> String {
        match self {
            Self::Source(error) => error.remedy(),
            Self::NoCaptions { .. } => {
                "take the file out, or add captions to training/corpora/hatt/captions.toml".into()
            }
            Self::SampleRate { .. } | Self::Unconvertible { .. } | Self::Silent { .. } => {
                "fetch the file again from HaTT, or take it out of the folder".into()
            }
            Self::TooFewSamples { .. } => "give a folder of more materials".into(),
        }
    }
}
