//! The model-file front end: the intermediate model as JSON, written and read.
//!
//! A front end of one's own needs no Rust: it writes such a file, and `asperity import model`
//! takes it through the [pipeline](crate::pipeline). `docs/model.md` documents the format.

mod check;
mod emit;
mod error;
mod import;
mod layout;
mod read;
mod schema;
#[cfg(test)]
mod tests;

pub use emit::to_json;
pub use error::{ModelFileError, ModelFileProblem};
pub use import::import;
pub use read::{from_json, read};
pub use schema::{FORMAT, VERSION};
