//! Latents as a source: textures mixed and edited in the latent space of the learned model.
//!
//! An asset [remembers](crate::edit_memory) the [`Latents`] it was decoded from and its [`History`]. A
//! [`LatentEditor`] decodes them again after they were blended, composed, or moved along the [`Sliders`];
//! from there on a texture goes the way of every other. `docs/libraries.md` shows the commands.
//!
//! ```
//! use asperity::{
//!     driver,
//!     sources::{latents::{Edit, LatentEditor, Sliders}, prompt::{Options, PromptCompiler}, Tools},
//!     learned::inference::Backend,
//! };
//! use asperity_formats::Asset;
//!
//! let prompt_compiler = PromptCompiler::embedded(&Backend::Portable)?;
//! let cork = prompt_compiler.compile("cork", &Options::default().without_preview())?;
//! let asset = Asset::parse(&cork.lowered.bytes).expect("a verified asset");
//!
//! let editor = LatentEditor::new(&prompt_compiler);
//! let request = editor.request(&asset); // the options that it was compiled with
//! let mut source = editor.remembered(&asset)?;
//! let sliders = Sliders { rougher: 20.0, ..Sliders::default() };
//! source.edit(&editor, &Edit::Steps(sliders), &request)?;
//! let rougher = driver::compile(&source, &request, &Tools::of(&prompt_compiler))?;
//! assert!(rougher.attributes().rough_db > cork.attributes().rough_db);
//! # Ok::<(), asperity::driver::Failure>(())
//! ```

mod attribute_cache;
mod edit;
mod edited;
mod encode;
mod explain;
mod fault;
mod latent_editor;
mod loudness;
mod mix;
mod report;
mod scale;
mod solve;
mod source;

pub use crate::edit_memory::{
    AXES, Axis, History, Ingredient, Latents, Memory, Origin, Sliders, Step, remembered,
};
pub use edit::{Edit, EditResult};
pub use encode::{Encoded, Part, encode};
pub use explain::{Explanation, WordEffect, explain};
pub use fault::nothing_asked;
pub(crate) use fault::{no_latent, not_understood};
pub use latent_editor::LatentEditor;
pub use loudness::equal_loudness;
pub use mix::{Mix, MixOptions, MixPreview, MixReport};
pub use report::attributes_line;
pub use scale::Scale;
pub use source::{FromLatents, decode};
