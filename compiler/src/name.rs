//! Names that a texture can have.

use asperity_formats::limits::MAX_NAME_BYTES;
use asperity_io::{diagnostic::Fault, shown::shortened};
use std::path::Path;

/// Returns true if an asset can hold a name.
pub(crate) fn fits(name: &str) -> bool {
    (1..=MAX_NAME_BYTES).contains(&name.len()) && !name.chars().any(char::is_control)
}

/// The name of a file without its ending, as an asset can hold it.
pub(crate) fn of_file(file: &Path) -> String {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    let plain: String = stem
        .chars()
        .map(|c| if c.is_control() { '_' } else { c })
        .collect();
    shortened(&plain, MAX_NAME_BYTES).to_owned()
}

/// Returns the fault of a name that does not fit.
pub(crate) fn invalid(name: &str) -> Fault {
    let what =
        format!("{name:?} is not a valid name: a name has 1 to 64 bytes and no control characters");
    Fault::new(what, "choose another name")
}

/// Refuses a name that no texture can have.
///
/// # Errors
/// A usage error.
pub fn check_name(name: &str) -> Result<(), Fault> {
    if fits(name) {
        Ok(())
    } else {
        Err(invalid(name).usage())
    }
}
