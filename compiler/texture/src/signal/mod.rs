//! The mathematics of the models: filters, their line spectral frequencies, their spectra.

pub mod impact;
pub mod kaiser;
pub mod level;
pub mod levinson;
pub mod lsf;
pub mod quantile;
pub mod reflection;
pub mod resample;
pub mod spectrum;
