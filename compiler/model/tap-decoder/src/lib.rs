//! The tap decoder of Asperity's learned model, a package of its own because registries limit the size of one.
//!
//! `asperity-model` has the whole model.

#![no_std]

/// The file `tap_decoder.onnx`: `z` [B, 64] to `taps_m_s2` [B, 13, 100], m/s².
pub static TAP_DECODER: &[u8] = include_bytes!("../tap_decoder.onnx");
