//! Pictures of textures, drawn without system fonts and deterministic to the byte.
//!
//! [`theme`] is the look that every Asperity picture shares.

pub mod theme;
