//! The mathematics of the models: filters, their line spectral frequencies, their spectra.
//!
//! | module | holds |
//! |---|---|
//! | [`lsf`] | line spectral frequencies, in which models are stored and mixed |
//! | [`reflection`] | reflection coefficients, and stability by them |
//! | [`levinson`] | the AR model of a power spectrum |
//! | [`spectrum`] | power spectra, and the distance between two of them |
//! | [`level`] | RMS of a model's vibration |
//! | [`resample`], [`kaiser`] | band-limited resampling, and its window |
//! | [`impact`] | the transient of a tap |
//! | [`quantile`] | order statistics |

pub mod impact;
pub mod kaiser;
pub mod level;
pub mod levinson;
pub mod lsf;
pub mod quantile;
pub mod reflection;
pub mod resample;
pub mod spectrum;
