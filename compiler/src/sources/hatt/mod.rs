//! HaTT as a source: materials of the Penn Haptic Texture Toolkit.
//!
//! The whole ARMA model is kept, with every vertex and every triangle in source order. What
//! HaTT does not hold is synthesised or set to a default, and the provenance says so.

mod error;
mod filter;
mod material;
mod source;
#[cfg(test)]
mod tests;
mod texture;
mod xml;

pub use error::{HattError, Problem};
pub use filter::Filter;
pub use material::{Material, SourceModel, parse};
pub use source::{BUDGET_DB, Hatt, Recomputed, bytes, files, refuse_namesakes};
pub use texture::to_model;
