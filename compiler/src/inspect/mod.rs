//! Everything in an asset, as JSON for programs and as text for people.

mod json;
mod text;

pub use json::{Document, LibraryDocument};
pub use text::text;
