//! From options to encoders, models and back ends, and what identifies this program.

use crate::cli::Inference;
use asperity::{
    learned::{LearnedModel, inference::Backend},
    library::Setup,
};
use asperity_io::diagnostic::Failures;
use std::path::Path;

impl Inference {
    /// The networks that the options name.
    pub(crate) fn setup(&self) -> Setup {
        Setup {
            text_encoder: self.text_encoder.clone(),
            model: self.model.clone(),
            backend: self.backend,
        }
    }
}

/// This program to the byte, because two builds of one version may give other textures. A program
/// that cannot be read counts by its version alone.
pub(crate) fn program() -> String {
    let bytes = std::env::current_exe().and_then(std::fs::read);
    let crc32 = bytes.map_or(0, |bytes| crc32fast::hash(&bytes));
    format!("{} {crc32:08x}", env!("CARGO_PKG_VERSION"))
}

/// The model that completes what an import lacks, on the portable back end.
pub(crate) fn completer(folder: Option<&Path>) -> Result<LearnedModel, Failures> {
    let setup = Setup {
        model: folder.map(Path::to_owned),
        ..Setup::default()
    };
    setup.model(&Backend::Portable)
}
