//! From sensor files to what a texture is made of.
//!
//! A recording is a folder of sensor files and a `recording.toml` that says what they hold. It goes
//! one way, and every step is a module:
//!
//! | step | module | gives |
//! |---|---|---|
//! | describe | [`description`] | files, channels, units, rates; a proposal where there is none |
//! | read | [`reader`] | channels in SI units, with what was wrong with their numbers |
//! | align | [`timeline`] | all channels on one clock at 1 kHz |
//! | check | [`check`] | a verdict for each channel, and what to do about it |
//! | resonance | [`resonance`] | that of tool and sensor, by taps in free air, and the acceleration without it |
//! | one axis | [`axes`] | three axes as one signal with their spectrum |
//! | segments | [`steady`] | stretches of steady speed and force |
//! | models | [`autoregression`] | AR and ARMA models of a stretch, by several methods |
//! | friction | [`friction`] | μ with its spread, and how it depends on speed and load |
//! | taps | [`impact`] | impacts, their speeds, a mean transient for each speed |
//!
//! What must stay absent: textures, assets, the learned model, pictures.
#![forbid(unsafe_code)]

pub mod autoregression;
pub mod axes;
pub mod channel;
pub mod check;
pub mod description;
mod error;
mod file;
pub mod friction;
pub mod impact;
pub mod reader;
pub mod resonance;
pub mod signal;
pub mod steady;
#[cfg(test)]
mod test_recordings;
pub mod timeline;

pub use error::{Problem, RecordingError};
