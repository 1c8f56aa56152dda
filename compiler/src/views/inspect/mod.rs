//! Everything in an asset, as JSON for programs and as text for people.
//!
//! The names and the meaning of the JSON fields are a contract.
//!
//! ```
//! use asperity::{sources::builtin, views::inspect::{Document, text}, emit::lower::lower};
//! use asperity_formats::Asset;
//!
//! let bytes = lower(&builtin::texture(), None).expect("a texture that fits an asset").bytes;
//! let asset = Asset::parse(&bytes).expect("a valid asset");
//! let document = Document::of(&asset);
//! let json = serde_json::to_value(&document).expect("plain numbers and strings");
//! assert_eq!(json["bytes"]["total"], bytes.len());
//! assert!(text(&document, &asset).starts_with("Built-in Grit\n"));
//! ```

mod json;
mod scene;
mod text;

pub use json::{Document, LibraryDocument};
pub use scene::SurfaceDocument;
pub use text::text;

use serde::Serialize;

/// A document as `inspect --json` prints it, without the line break.
#[must_use]
pub fn json(document: &impl Serialize) -> String {
    // Plain structures of numbers and strings always serialise.
    serde_json::to_string(document).unwrap_or_default()
}
