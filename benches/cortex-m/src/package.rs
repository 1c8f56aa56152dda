//! Where the package lies, where it builds, and how its steps fail.

pub(crate) use asperity_machines::command::{Result, stdout, target_dir};

use std::path::Path;

/// This package's folder.
pub(crate) fn home() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}
