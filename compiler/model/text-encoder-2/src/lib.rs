//! The second third of the bytes of `text_encoder.onnx`, which `asperity-model` puts together.
//!
//! Registries limit the size of a package, and the file is larger. It derives from all-MiniLM-L6-v2:
//! see `LICENSES/`.

#![no_std]

/// Part 2 of 3, a constant so that a binary holds the whole file and no part of it beside.
pub const PART: &[u8] = include_bytes!("../text_encoder.onnx.2");
