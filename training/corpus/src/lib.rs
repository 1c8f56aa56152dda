//! Training corpora in one form: the synthetic reference corpus ([`mod@reference`]) and a
//! user's folder of HaTT models ([`hatt`]).
//!
//! A corpus is a list of [`Material`]s with captions, attributes, friction and
//! augmented [`Instance`]s on one unified speed–force grid of [`BINS`] bins.
#![forbid(unsafe_code)]

mod augment;
mod error;
pub mod generator;
mod grid;
pub mod hatt;
pub mod leaks;
mod material;
pub mod measured;
pub mod reference;
pub mod sentences;

pub use error::CorpusError;
pub use generator::constants::ConstantSet;
pub use grid::{Bin, UnifiedGrid};
pub use material::{Caption, Corpus, Focus, Instance, Material, Rating};

/// Bins of the unified speed–force grid (paper: 18 clusters of all samples).
pub const BINS: usize = 18;
/// AR order of every bin.
pub const ORDER: usize = 21;
/// Channels of a bin: [`ORDER`] LSFs and the excitation.
pub const CHANNELS: usize = ORDER + 1;
/// Traces of a tap bank.
pub const TAPS: usize = 13;
/// Samples of a trace.
pub const TAP_SAMPLES: usize = 100;
/// Rate of the AR models, Hz.
pub const SAMPLE_RATE_HZ: f64 = 1000.0;
/// Rate of the tap traces, Hz.
pub const TAP_RATE_HZ: f64 = 10_000.0;
