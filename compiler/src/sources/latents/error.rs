//! Why a texture cannot be mixed or edited.

use crate::{
    edit_memory::HistoryError,
    emit::{lower::LowerError, textures::TexturesError},
    learned::ModelError,
    pipeline::PipelineError,
    sources::prompt::PromptError,
};
use asperity_formats::{EncodeError, FormatError};
use asperity_io::diagnostic::Diagnostic;
use thiserror::Error;

/// Why a texture cannot be mixed or edited.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EditError {
    /// The file cannot be used.
    #[error(transparent)]
    Source(#[from] TexturesError),
    /// The asset was damaged.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// It remembers no latent.
    #[error("{0:?} has no latent")]
    NoLatent(String),
    /// Its latent belongs to another model.
    #[error("{name:?} was decoded with model {found:08x}, but this is model {expected:08x}")]
    OtherModel {
        /// The texture.
        name: String,
        /// CRC-32 of its model.
        found: u32,
        /// CRC-32 of the model at hand.
        expected: u32,
    },
    /// Its history is not what this version writes.
    #[error(transparent)]
    History(#[from] HistoryError),
    /// There is no edit to take back.
    #[error("{0:?} has no edit to undo")]
    NothingToUndo(String),
    /// The edit moves nothing.
    #[error("no edit is given")]
    NothingAsked,
    /// Nothing in the words of an edit is understood.
    #[error(
        "the edit {0:?} names neither a quality to change, such as rough, nor a material to be more like"
    )]
    NotUnderstood(String),
    /// The texture has no such part.
    #[error("{name:?} has no {part} to encode")]
    NoPart {
        /// The texture.
        name: String,
        /// `taps` or `slide`.
        part: &'static str,
    },
    /// The learned model failed.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A prompt could not be read.
    #[error(transparent)]
    Prompt(#[from] PromptError),
    /// The decoded texture did not pass the pipeline.
    #[error(transparent)]
    Pipeline(#[from] PipelineError),
    /// The memory does not fit the asset.
    #[error(transparent)]
    Encode(#[from] EncodeError),
}

impl Diagnostic for EditError {
    fn remedy(&self) -> String {
        match self {
            Self::Source(error) => error.remedy(),
            Self::Format(_) | Self::History(_) => "build the file again from its source".into(),
            Self::NoLatent(_) => {
                "give a texture compiled from a prompt, or encode this one with `asperity encode`"
                    .into()
            }
            Self::OtherModel { .. } => {
                "give the folder of its model with --model, or compile its prompt again".into()
            }
            Self::NothingToUndo(_) => "leave --undo out".into(),
            Self::NothingAsked => {
                "give a slider, such as --rougher 20, words with --prompt, or --undo".into()
            }
            Self::NotUnderstood(_) => {
                "describe a change, as in \"less gritty, more waxy\" or \"more like leather\""
                    .into()
            }
            Self::NoPart { .. } => {
                "encode the part that it has: --part taps or --part slide".into()
            }
            Self::Model(error) => error.remedy(),
            Self::Prompt(error) => error.remedy(),
            Self::Pipeline(error) => error.remedy(),
            Self::Encode(error) => LowerError::from(*error).remedy(),
        }
    }

    fn is_usage(&self) -> bool {
        match self {
            Self::NothingAsked | Self::NotUnderstood(_) => true,
            Self::Source(error) => error.is_usage(),
            Self::Prompt(error) => error.is_usage(),
            Self::Pipeline(error) => error.is_usage(),
            _ => false,
        }
    }
}
