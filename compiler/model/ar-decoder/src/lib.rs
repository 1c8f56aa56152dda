//! The AR decoder of Asperity's learned model, a package of its own because registries limit the size of one.
//!
//! `asperity-model` has the whole model.

#![no_std]

/// The file `ar_decoder.onnx`: `z` [B, 64] to `lsf_rad` [B, 18, 21], rad, and `level_db` [B, 18], dB re 1 m/s².
pub static AR_DECODER: &[u8] = include_bytes!("../ar_decoder.onnx");
