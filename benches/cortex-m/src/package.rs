//! Where the package lies, where it builds, and how its steps fail.

use std::path::{Path, PathBuf};

/// What any step can fail with; the text says what to do about it.
pub(crate) type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// This package's folder.
pub(crate) fn home() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Where everything is built.
pub(crate) fn target_dir() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| home().join("../../target"), PathBuf::from)
}
