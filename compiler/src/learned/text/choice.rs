//! The text encoder that a user names.

use std::{path::PathBuf, str::FromStr};

/// Which text encoder a user names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TextEncoderChoice {
    /// `minilm`: the embedded one.
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
