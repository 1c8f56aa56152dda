//! Surfaces as a source: maps of heights or normals become what a stylus feels on it.
//!
//! [`asperity_surface`] reads the map and computes what strokes over it meet; here that becomes a
//! [`TextureModel`](asperity_texture::model::TextureModel). What no map says, hardness, taps and friction, comes from words,
//! or else from the learned model. `docs/surfaces.md` describes method and limits.

mod grid;
mod options;
mod picture;
mod report;
mod sheet;
mod source;

pub use asperity_surface::{
    contact::Tip,
    map::{Convention, Size, all},
};
pub use grid::Survey;
pub use options::{KEYS, Options};
pub use source::{KIND, Surface, Surveyed};
