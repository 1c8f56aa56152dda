//! From the heights of a surface to the vibration of a tip that is stroked over it.
//!
//! | module | holds |
//! |---|---|
//! | [`contact`] | the tip, and how its contact averages heights |
//! | [`stylus`] | how tool and hand follow |
//! | [`vibration`] | sampled power spectra, and the AR model of one |
//! | [`direction`] | the ratios by which strokes along an axis follow from those across it |
//!
//! The corpus's generator and the import of surfaces share it.
#![forbid(unsafe_code)]

pub mod contact;
pub mod direction;
pub mod stylus;
pub mod vibration;
