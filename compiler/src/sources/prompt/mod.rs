//! Prompts as a source: words become a text vector, then a latent, then a texture.
//!
//! A prompt is first [read](reading): what does it name, and what does it say about touch? A frozen text encoder
//! encodes that part. The learned model places the vector among the materials that it was trained on and decodes the
//! latent, and the [grammar](phrase) of the prompt shifts what a vector misses. The [driver](crate::driver) does the
//! rest.
//!
//! [`PromptCompiler`] loads the networks once and answers any number of prompts. [`PromptCompiler::compile`] goes all
//! the way to an asset; a [`Prompt`] is the same as a [source](crate::sources::Source). The steps before that can be
//! looked at one by one:
//!
//! ```
//! use asperity::{
//!     model::attributes,
//!     learned::{inference::Backend, Certainty},
//!     sources::prompt::PromptCompiler,
//! };
//!
//! let prompt_compiler = PromptCompiler::embedded(&Backend::Portable)?;
//! let projection = prompt_compiler.project("please, some very rough gravel")?;
//! assert_eq!(projection.reading.text(), "very rough gravel");
//! assert_eq!(projection.certainty, Certainty::Known);
//!
//! let rough_db = |prompt| prompt_compiler.texture(prompt).map(|texture| attributes::of(&texture).rough_db);
//! assert!(rough_db("very rough gravel")? > rough_db("gravel")?);
//! # Ok::<(), asperity::driver::Failure>(())
//! ```

mod certainty;
mod changed;
mod compiled_prompt;
mod encoding_cache;
mod error;
mod graded;
mod meaning;
mod named_things;
mod prompt_compiler;
mod readable;
mod report;
mod source;
mod stroke;
mod suggestions;

pub use asperity_language::reading::Interpretation;
pub use asperity_language::{phrase, reading, words::grade::woods};
pub use asperity_texture::model::shift::Shift;
pub use changed::{STEP, changed, from_base};
pub use compiled_prompt::{CompiledPrompt, Nearest, Options};
pub use error::PromptError;
pub use meaning::Meaning;
pub(crate) use meaning::contact_law;
pub(crate) use prompt_compiler::title;
pub use prompt_compiler::{Projection, PromptCompiler};
pub use readable::{Understood, check};
pub use source::{KIND, Picture, Prompt};
pub(crate) use stroke::split_stroke;
pub use suggestions::suggestions;
