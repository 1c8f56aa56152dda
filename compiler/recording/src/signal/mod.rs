//! The mathematics of sampled signals that the steps share.

pub mod correlate;
pub mod filter;
#[cfg(test)]
pub(crate) mod noise;
pub mod resample;
pub mod spectrum;

pub use asperity_texture::signal::{kaiser, quantile};
