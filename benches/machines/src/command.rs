//! Commands that build and run the session for other machines.

use std::{
    path::{Path, PathBuf},
    process::Command,
};

/// Result of any step; the error's text says what to do about it.
pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Where everything is built.
#[must_use]
pub fn target_dir() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from)
}

/// Runs a command to its end and returns what it printed.
///
/// # Errors
/// A command that cannot be started or that fails, with what it said.
pub fn stdout(command: &mut Command) -> Result<String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command
        .output()
        .map_err(|error| format!("{name} cannot be started ({error}); install it"))?;
    if output.status.success() {
        Ok(String::from_utf8(output.stdout)?)
    } else {
        let [said, errors] =
            [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
        Err(format!("{command:?}: {}\n{said}{errors}", output.status).into())
    }
}
