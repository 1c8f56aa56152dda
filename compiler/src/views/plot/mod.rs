//! A picture of a whole texture on one page, deterministic to the byte.
//!
//! It is drawn with `asperity-plot`, like every Asperity picture.

mod roots;
mod sheet;

pub use sheet::{AssetBytes, HEIGHT_PX, WIDTH_PX, sheet, sheet_with_picture};
