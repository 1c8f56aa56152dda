//! Everything in an asset, as JSON for programs and as text for people.

mod json;
mod scene;
mod text;

pub use json::{Document, LibraryDocument};
pub use scene::SurfaceDocument;
pub use text::text;
