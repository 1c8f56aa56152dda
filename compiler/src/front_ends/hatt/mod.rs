//! The HaTT front end: materials of the Penn Haptic Texture Toolkit.
//!
//! The whole ARMA model is kept, with every vertex and every triangle in source order. What
//! HaTT does not hold is synthesised or set to a default, and the provenance says so.

mod error;
mod filter;
mod import;
mod import_error;
mod material;
#[cfg(test)]
mod tests;
mod texture;
mod xml;

pub use crate::front_ends::imported::{Imported, Report};
pub use error::{HattError, Problem};
pub use filter::Filter;
pub use import::{bytes, files, import, import_all, import_at};
pub use import_error::{BUDGET_DB, ImportError};
pub use material::{Material, SourceModel, parse};
pub use texture::to_model;
