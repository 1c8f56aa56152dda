//! Input file of `build`: the manifest of a library, or a scene.

use super::manifest;
use asperity_io::{
    diagnostic::{Failures, one},
    input::{self, InputError, InputKind, Reach},
};
use std::path::{Path, PathBuf};

/// A manifest or a scene that was read and not yet checked.
#[derive(Debug, Clone)]
pub struct BuildFile {
    /// The file.
    pub file: PathBuf,
    /// Its text.
    pub text: String,
    /// The files that it may name.
    pub reach: Reach,
    /// True if it is a scene.
    pub is_scene: bool,
}

impl BuildFile {
    /// Reads a file. A confined one may name files in its own folder alone.
    ///
    /// # Errors
    /// [`InputError`] for a file that cannot be read.
    pub fn read(file: &Path, confined: bool) -> Result<Self, Failures> {
        let extension = file.extension().unwrap_or_default();
        let has_rows = ["csv", "jsonl", "ndjson"]
            .iter()
            .any(|e| extension.eq_ignore_ascii_case(e));
        let kind = if has_rows {
            InputKind::Manifest
        } else {
            InputKind::Scene
        };
        let wrong = |problem| {
            one(InputError {
                file: file.to_owned(),
                problem,
            })
        };
        let text = input::read_text(file, kind).map_err(wrong)?;
        let reach = if confined {
            Reach::beside(file).map_err(|error| wrong(error.into()))?
        } else {
            Reach::Anywhere
        };
        Ok(Self {
            file: file.to_owned(),
            is_scene: !has_rows && manifest::is_scene(&text),
            text,
            reach,
        })
    }
}
