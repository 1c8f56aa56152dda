//! From a trained model to a model folder.

mod card;
mod description;
mod folder;
mod gain;
mod graph;
mod halves;
mod networks;
mod verify;

use crate::{captions::Captions, metrics::Metrics, trained::Trained, weights};
use asperity_corpus::Corpus;
use asperity_io::{diagnostic::Diagnostic, output::OutputError};
use asperity_nn::{OnnxError, RunError};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a trained model cannot be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// A graph that cannot be written.
    #[error("{file}")]
    Graph {
        /// The file.
        file: &'static str,
        /// Why.
        source: OnnxError,
    },
    /// A written graph that does not run.
    #[error("{file}")]
    Run {
        /// The file.
        file: &'static str,
        /// Why.
        source: RunError,
    },
    /// A written graph that answers otherwise than the network it was made of.
    #[error(
        "{file}: output `{output}` differs from the trained network by {difference:e} \
         of its scale, {limit:e} at most is right"
    )]
    Disagreement {
        /// The file.
        file: &'static str,
        /// The output.
        output: &'static str,
        /// Largest difference, relative to the largest value or 1.
        difference: f64,
        /// Largest permitted difference.
        limit: f64,
    },
    /// A description or weights that cannot be put into bytes.
    #[error("{file}: {message}")]
    Encode {
        /// The file.
        file: &'static str,
        /// Why.
        message: String,
    },
    /// The folder holds something else.
    #[error("{}: is there, and is no model folder", path.display())]
    Occupied {
        /// The folder.
        path: PathBuf,
    },
    /// The folder cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

impl Diagnostic for ExportError {
    fn remedy(&self) -> String {
        match self {
            Self::Graph { .. } | Self::Run { .. } | Self::Disagreement { .. } => {
                "report it: nothing was written".into()
            }
            Self::Encode { .. } => "lower optimiser.learning_rate: a number is not finite".into(),
            Self::Occupied { .. } => "give the path of a new folder, or of an older model".into(),
            Self::Output(error) => error.remedy(),
        }
    }
}

/// The files of a model folder, in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelFiles(Vec<(&'static str, Vec<u8>)>);

impl ModelFiles {
    /// Names and contents.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &[u8])> {
        self.0.iter().map(|(name, bytes)| (*name, bytes.as_slice()))
    }

    /// Checks before a training that [`write`](Self::write) can make `target` a model folder.
    ///
    /// # Errors
    /// [`ExportError::Occupied`]; [`ExportError::Output`] where its parent cannot be reached.
    pub fn check(target: &Path) -> Result<(), ExportError> {
        folder::check(target).map(drop)
    }

    /// Makes them the folder `target`: written beside it, then renamed. A model that was
    /// there is replaced.
    ///
    /// # Errors
    /// [`ExportError::Occupied`] for a folder that holds no model,
    /// [`ExportError::Output`]; the target is then as it was.
    pub fn write(&self, target: &Path) -> Result<(), ExportError> {
        folder::write(target, &self.0)
    }
}

/// Everything a model folder holds, each network checked against the trained one.
///
/// # Errors
/// [`ExportError`].
pub fn export(
    trained: &Trained,
    corpus: &Corpus,
    captions: &Captions,
    metrics: &Metrics,
) -> Result<ModelFiles, ExportError> {
    let networks = networks::write(trained)?;
    verify::check(trained, corpus, captions, &networks)?;
    let description = description::describe(trained, corpus, metrics);
    let mut json = serde_json::to_vec(&description).map_err(|e| ExportError::Encode {
        file: "model.json",
        message: e.to_string(),
    })?;
    json.push(b'\n');
    let config = trained.config.to_toml().map_err(|e| ExportError::Encode {
        file: "config.toml",
        message: e.to_string(),
    })?;
    let weights = weights::model(trained).map_err(|message| ExportError::Encode {
        file: "weights.safetensors",
        message,
    })?;
    let card = card::write(trained, corpus, &description, metrics, &config);
    let mut files: Vec<_> = networks.into_iter().collect();
    files.push(("weights.safetensors", weights));
    files.push(("config.toml", config.into_bytes()));
    files.push(("MODEL_CARD.md", card.into_bytes()));
    files.push(("model.json", json));
    Ok(ModelFiles(files))
}
