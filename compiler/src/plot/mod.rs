//! A picture of a whole texture on one page, deterministic to the byte.
//!
//! `asperity-plot` has the look that it shares with every Asperity picture.

mod roots;
mod sheet;

pub use sheet::{AssetBytes, HEIGHT_PX, WIDTH_PX, sheet};
