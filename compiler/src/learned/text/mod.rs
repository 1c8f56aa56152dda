//! Text to vectors: frozen sentence encoders with their tokenisers.
//!
//! [`minilm`] is embedded, with a [table of words](WordTable) beside it. [`clip`] runs a user's export of CLIP's text tower.

pub mod clip;
mod encoder;
pub mod minilm;
mod states;
mod words;

pub use asperity_language::Vocabulary;
pub use encoder::{Encoded, TextEncoder};
pub use states::WordStates;
pub use words::{WithWords, WordTable};

use std::{path::PathBuf, str::FromStr};

// The text encoder that a user names.

/// Which text encoder a user names.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum TextEncoderChoice {
    /// `minilm`: the embedded one.
    #[default]
    MiniLm,
    /// `clip:DIR`: an export of CLIP's text tower in a folder.
    Clip(PathBuf),
}

impl FromStr for TextEncoderChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once(':') {
            None if text == "minilm" => Ok(Self::MiniLm),
            Some(("clip", folder)) if !folder.is_empty() => Ok(Self::Clip(folder.into())),
            _ => Err("`minilm` or `clip:DIR`".into()),
        }
    }
}
