//! A prompt as a source: words become a text vector, a latent, a texture.
//!
//! The prompt is [read](reading): what it names, and what it says of touch. A frozen text encoder
//! encodes that, the learned model places it among the materials that it was trained on and decodes the
//! latent, the [grammar](phrase) of the prompt moves what a vector misses, and the
//! [driver](crate::driver) does the rest.

mod certainty;
mod compiled_prompt;
mod encoding_cache;
mod error;
mod explained;
mod graded;
mod lexicon;
mod meaning;
mod named_things;
pub mod phrase;
mod prompt_compiler;
pub mod reading;
mod report;
mod source;
mod understood;

pub use crate::words::grade::woods;
pub use asperity_texture::model::shift::Shift;
pub use compiled_prompt::{CompiledPrompt, Nearest, Options};
pub use error::PromptError;
pub use explained::Taken;
pub use meaning::Meaning;
pub use prompt_compiler::{Projection, PromptCompiler};
pub use source::{KIND, Picture, Prompt};
pub use understood::{Understood, check};
