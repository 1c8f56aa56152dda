//! A manifest: what textures a library has, as TOML, CSV or JSON lines.
//!
//! All three give the same rows. Every row is checked by itself, then all of them together, and
//! every fault is reported with file, line and key.

mod cells;
mod check;
mod csv_file;
mod entry;
mod error;
mod graph;
mod json_file;
mod read;
mod row;
mod toml_file;
mod values;

pub use entry::{Entry, Options, Origin, Place};
pub use error::{ManifestError, ManifestProblem};
pub use read::{Manifest, Setup, is_scene};

pub(crate) use error::CONFINED_REMEDY;
pub(in crate::library) use graph::order;
