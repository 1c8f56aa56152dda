//! A model of one's own as a source: the intermediate model as JSON, written and read.
//!
//! A source of one's own needs no Rust: it writes such a file, and `asperity import model`
//! compiles it. `docs/model.md` documents the format.

mod check;
mod emit;
mod error;
mod layout;
mod read;
mod schema;
mod source;
#[cfg(test)]
mod tests;

pub use emit::to_json;
pub use error::{ModelFileError, ModelFileProblem};
pub use read::{from_json, read};
pub use schema::{FORMAT, VERSION};
pub use source::ModelFile;
