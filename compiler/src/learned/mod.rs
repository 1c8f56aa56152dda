//! The learned model: its folder, its description, its networks.
//!
//! `prompt → text vector → z → AR grid, taps → μ` of the paper, frozen. Training is
//! another package; here a model is only read and run.

mod certainty;
mod check;
pub mod complete;
pub mod contact;
pub mod description;
pub mod direction;
pub mod edges;
pub mod embedded;
pub(crate) mod files;
pub mod friction;
pub mod inference;
mod model;
pub mod modulus;
mod network;
pub mod text;
pub mod texture;

pub use certainty::Certainty;
pub use files::Files;
pub use model::{Decoded, DecodedGrid, Latent, LearnedModel, Present, Projected};
