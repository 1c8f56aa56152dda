//! The text projection of Asperity's learned model, a package of its own because registries limit the size of one.
//!
//! `asperity-model` has the whole model.

#![no_std]

/// The file `text_projection.onnx`: `embedding` [B, 480] to `z` [B, 64], `similarity` [B, M] and `familiarity` [B, 1].
pub static TEXT_PROJECTION: &[u8] = include_bytes!("../text_projection.onnx");
