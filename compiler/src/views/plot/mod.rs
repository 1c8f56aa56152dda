//! A picture of a whole texture on one page, deterministic to the byte.
//!
//! It is drawn with `asperity-plot`, like every Asperity picture.
//!
//! ```
//! use asperity::{sources::builtin, views::plot};
//!
//! let png = plot::sheet(&builtin::texture(), None).expect("the embedded font and an encoder");
//! assert!(png.starts_with(b"\x89PNG"));
//! ```

mod of_asset;
mod roots;
mod sheet;

pub use of_asset::of_asset;
pub use sheet::{AssetBytes, HEIGHT_PX, WIDTH_PX, sheet, sheet_with_picture};
