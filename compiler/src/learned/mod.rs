//! The learned model: its folder, its description, its networks.
//!
//! `prompt → text vector → z → AR grid, taps → μ` of the paper, frozen. Training is
//! another package; here a model is only read and run.

mod certainty;
pub mod complete;
pub mod description;
pub mod edges;
pub mod friction;
pub mod level;
mod model;
pub mod texture;

pub use certainty::certainty;
pub use model::{Decoded, Files, Latent, LearnedModel, ModelError, Present, Projected};
