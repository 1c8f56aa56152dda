//! Writes outputs in full or not at all.
//!
//! A file is written beside its target and renamed over it. What is not committed is
//! removed, on an error and on an interrupt. [`Outputs`] opens all that a command writes and
//! refuses what would destroy an input or another output; `-` is standard output.

mod atomic;
mod error;
mod file_names;
mod folder;
mod identity;
mod links;
mod outputs;
mod stream;
#[cfg(test)]
mod tests;
mod unfinished;
mod whole_folder;

pub use atomic::AtomicFile;
pub use error::{OpenError, OutputError};
pub use file_names::FileNames;
pub use folder::{NewFolder, write_folder, write_folder_beside};
pub use outputs::{OutputId, Outputs};
pub use stream::{display, is_standard_output};
pub use unfinished::clean_up_and_exit;
pub use whole_folder::WholeFolder;

use std::path::Path;

/// Writes `bytes` to `target`, all or nothing.
///
/// # Errors
/// [`OutputError`]; the target is then as it was.
pub fn write_atomic(target: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    let mut file = AtomicFile::create(target)?;
    file.fill(bytes)?;
    file.commit()
}
