//! The mathematics of sampled signals that the steps share.

pub mod correlate;
pub mod filter;
pub mod kaiser;
pub mod quantile;
pub mod resample;
pub mod spectrum;
