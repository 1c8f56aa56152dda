//! Training of the learned texture model: a bimodal variational autoencoder over AR
//! models and tapping transients, with a projection of text into its latent (Qian et
//! al., "Language-Guided Multimodal Texture Authoring via Generative Models").
//!
//! [`fit`] trains on a corpus, [`fit_on`] on some of its materials; both give a
//! [`Trained`] that encodes, decodes and projects.

mod adam;
mod attribute_regression;
mod attributes;
mod batch;
mod captions;
mod certainty;
mod checkpoint;
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
pub use certainty::{calibration_error, certainty_curve};
pub use config::Config;
pub use error::FitError;
pub use export::{ExportError, ModelFiles, export};
pub use fit::{Checkpoints, fit, fit_on, fit_with_checkpoints, on_threads};
pub use material::MaterialLatent;
pub use metrics::{Metrics, Retrieval, measure};
pub use normaliser::Normaliser;
pub use progress::{EpochLoss, Progress, Silent};
pub use trained::{Gaussian, Seen, Trained};
pub use vectors::Remembered;
pub use words_held_out::{TOLERANCE, WordsHeldOut};
