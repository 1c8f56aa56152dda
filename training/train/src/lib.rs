//! Training of the learned texture model: a bimodal variational autoencoder over AR
//! models and tapping transients, with a projection of text into its latent (Qian et
//! al., "Language-Guided Multimodal Texture Authoring via Generative Models").
//!
//! [`fit_on`] trains on materials of a corpus, [`measure`] says how well, and [`export`] gives the
//! files of a model folder. [`evaluate`](mod@evaluate) reports on such a folder.

mod adam;
mod attribute_regression;
mod attributes;
mod batch;
mod captions;
mod certainty;
mod coding;
pub mod config;
mod discriminant;
mod eigen;
mod error;
pub mod evaluate;
mod export;
mod fit;
mod kernel_ridge;
mod lda_retrieval;
mod loss;
mod material;
mod metrics;
mod network;
mod normaliser;
mod parameters;
mod progress;
mod ridge;
mod rng;
mod statistics;
#[cfg(test)]
mod synthetic;
#[cfg(test)]
mod tests;
mod text_stage;
mod trained;
mod vae;
mod vectors;
mod weights;
mod words_held_out;

pub use captions::Captions;
pub use config::Config;
pub use error::FitError;
pub use export::{ExportError, ModelFiles, export};
pub use fit::{fit_on, on_threads};
pub use metrics::{Metrics, measure};
pub use progress::{EpochLoss, Progress};
pub use trained::Trained;
pub use vectors::Remembered;
