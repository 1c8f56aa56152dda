//! Latents as a source: mixing and editing in the latent space of the learned model.
//!
//! An asset [remembers](crate::edit_memory) the [`Latents`] it was decoded from and its [`History`]. A
//! [`LatentEditor`] decodes them again after they were blended, composed, or moved along the [`Sliders`];
//! from there on a texture goes the way of every other. `docs/libraries.md` shows the commands.

mod edited;
mod encode;
mod error;
mod explain;
mod latent_editor;
mod loudness;
mod report;
mod scale;
mod solve;
mod source;
mod worded;

pub use crate::edit_memory::{
    AXES, Axis, History, HistoryError, Ingredient, Latents, Memory, Origin, Sliders, Step,
    remembered,
};
pub use encode::{Encoded, Part, encode};
pub use error::EditError;
pub use explain::{Explanation, WordEffect, explain};
pub use latent_editor::LatentEditor;
pub use loudness::equal_loudness;
pub use report::attributes_line;
pub use scale::Scale;
pub use source::{FromLatents, decode};
pub use worded::{Edit, Worded};
