//! Remedies for faults that are found at several places.

use asperity_io::diagnostic::Fault;
use std::{io, path::Path};

pub(crate) const FORMAT: &str = "give CSV with a header line, WAV, or NumPy .npy files";
pub(crate) const KEYS: &str = "docs/recording.md lists every key with its values";
pub(crate) const MISSING: &str = "record what is missing, or name its channel in recording.toml";
pub(crate) const TOO_LITTLE: &str =
    "stroke for a minute at many speeds and forces; docs/recording.md says how";

/// For `map_err`: a file that the system cannot read.
pub(crate) fn unreadable(path: &Path) -> impl Fn(io::Error) -> Fault + '_ {
    move |error| {
        let remedy = "check the name under `file` in recording.toml";
        Fault::new(format!("cannot be read ({error})"), remedy).at(path)
    }
}
