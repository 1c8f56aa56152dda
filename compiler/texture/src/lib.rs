//! The model of a texture between its source and its bytes, and the mathematics of its parts.
//!
//! | folder | holds |
//! |---|---|
//! | [`model`] | one texture in f64 and SI units; what holds for it ([`mesh`](model::mesh)), what it renders between its vertices ([`mixture`](model::mixture)), how it feels ([`attributes`](model::attributes)) |
//! | [`signal`] | line spectral frequencies, Levinson's recursion, spectra, resampling, impacts, order statistics |
//!
//! `model` imports `signal`, which knows no texture.
#![forbid(unsafe_code)]

pub mod model;
pub mod signal;
