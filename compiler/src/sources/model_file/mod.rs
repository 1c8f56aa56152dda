//! A model of your own as a source: the intermediate model as JSON, written and read.
//!
//! A source of your own needs no Rust: it writes such a file, and `asperity import model`
//! compiles it. `docs/model.md` documents the format.
//!
//! ```
//! use asperity::sources::{builtin, model_file::{from_json, to_json}};
//!
//! let texture = builtin::texture();
//! let read = from_json(&to_json(&texture)).expect("a file that this crate wrote");
//! assert_eq!(read.grid, texture.grid); // to the bit
//!
//! // A refusal names the JSON path of the field at fault.
//! assert_eq!(from_json(b"{}").unwrap_err().field, "format");
//! ```

mod check;
mod contact;
mod emit;
mod layout;
mod read;
mod scale;
mod schema;
mod source;
#[cfg(test)]
mod tests;

pub use emit::to_json;
pub use read::{from_json, read};
pub use schema::{FORMAT, VERSION};
pub use source::ModelFile;
