//! Pictures of textures, drawn without system fonts and deterministic to the byte.
//!
//! [`sheet`] shows a whole texture on one page; [`theme`] is the look that every
//! Asperity picture shares.

mod roots;
mod sheet;
pub mod theme;

pub use sheet::{AssetBytes, HEIGHT_PX, WIDTH_PX, sheet};
