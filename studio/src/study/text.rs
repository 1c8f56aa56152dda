//! The files of a study, which faults point into.

use asperity_io::{diagnostic::Fault, toml_error::TomlError};
use std::{
    fs,
    path::{Path, PathBuf},
};
use toml::Spanned;

/// Bytes of a study's file, and of one with a form's items.
const FILE_BYTES: u64 = 1 << 20;

/// A file with its text, which a fault points into.
#[derive(Debug, Clone)]
pub(crate) struct Text {
    pub(crate) path: PathBuf,
    pub(crate) text: String,
}

impl Text {
    /// Reads a file of UTF-8, as large as one that a person writes.
    pub(crate) fn read(path: &Path) -> Result<Self, Fault> {
        let failed = |error: std::io::Error| {
            Fault::new(
                format!("cannot be read: {error}"),
                "check its path and its permissions",
            )
            .at(path)
        };
        let size = fs::metadata(path).map_err(failed)?.len();
        if size > FILE_BYTES {
            let what = format!("{size} bytes are too many for a study");
            return Err(Fault::new(what, "give the TOML file of a study").at(path));
        }
        let bytes = fs::read(path).map_err(failed)?;
        let text = String::from_utf8(bytes)
            .map_err(|_| Fault::new("not UTF-8", "save it as UTF-8").at(path))?;
        let path = path.to_owned();
        Ok(Self { path, text })
    }

    /// Reads it as TOML.
    pub(crate) fn parse<T: serde::de::DeserializeOwned>(&self) -> Result<T, Fault> {
        toml::from_str(&self.text).map_err(|error| {
            let error = TomlError::new(&self.text, &error);
            let remedy = "correct this line; docs/studies.md has every field";
            Fault::new(&error.message, remedy)
                .at(&self.path)
                .line(error.line as u64)
        })
    }

    /// A fault of what stands at a place.
    pub(crate) fn fault<T>(
        &self,
        at: &Spanned<T>,
        field: String,
        what: String,
        remedy: &str,
    ) -> Fault {
        let start = at.span().start.min(self.text.len());
        let line = 1 + self.text[..start].matches('\n').count() as u64;
        Fault::new(what, remedy)
            .at(&self.path)
            .line(line)
            .field(field)
    }
}
