//! A kind of source, as manifests name it.

use super::ManifestSource;
use crate::passes::reduce::Fidelity;
use asperity_io::diagnostic::Failure;
use std::{path::Path, sync::Arc};

/// A kind of source: the key of a manifest that names it, and what becomes of its value.
#[derive(Debug, Clone, Copy)]
pub struct SourceKind {
    /// The key.
    pub key: &'static str,
    /// Type of its value.
    pub operand: Operand,
    /// The source of a value.
    pub open: fn(&SourceEntry<'_>) -> Result<Arc<dyn ManifestSource>, Failure>,
    /// Keys of options that only such sources have.
    pub options: &'static [&'static str],
    /// Keys of a texture that do not go with it: `texture`, `seed`, `edit` and other options.
    pub refuses: &'static [&'static str],
    /// Default fidelity.
    pub fidelity: Fidelity,
    /// True if a preview is drawn by default.
    pub preview: bool,
}

/// Type of a key's value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operand {
    /// A text.
    Text,
    /// The path of a file that is there.
    File,
    /// The path of a folder that is there.
    Folder,
    /// The path of a file or a folder that is there.
    Path,
}

/// Entry of a source in a manifest.
#[derive(Debug, Clone, Copy)]
pub struct SourceEntry<'a> {
    /// The value of its key.
    pub text: &'a str,
    /// The value as a path that can be opened.
    pub path: &'a Path,
    /// The texture of a library.
    pub texture: Option<&'a str>,
    /// Those of its own options that are stated, as texts.
    pub options: &'a [(&'static str, String)],
    /// 0 for what a prompt means, others for variations of it.
    pub seed: u64,
}
