//! The mathematics of sampled signals that the steps share.

pub mod correlate;
pub mod filter;
pub mod kaiser;
#[cfg(test)]
pub(crate) mod noise;
pub mod quantile;
pub mod resample;
pub mod spectrum;
