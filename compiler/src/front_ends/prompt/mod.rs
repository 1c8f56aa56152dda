//! The prompt front end: words become a text vector, a latent, a texture.
//!
//! A frozen text encoder reads the prompt, the learned model places it among the materials that
//! it was trained on and decodes the latent, and the [pipeline](crate::pipeline) does the rest.

mod author;
mod authored;
mod error;
mod name;
mod report;
mod understood;
mod variation;

pub use author::{Author, Prompted};
pub use authored::{Authored, LOW_CERTAINTY, Nearest, Options};
pub use error::PromptError;
pub use understood::{Understood, check};
