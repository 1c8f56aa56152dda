//! Mixing and editing in the latent space of the learned model.
//!
//! An asset remembers the [`Latents`] it was decoded from and its [`History`]. A [`Studio`] decodes
//! them again after they were blended, composed, or moved along the [`Sliders`]; from there on a
//! texture goes the way of every other. `docs/libraries.md` shows the commands.

mod edited;
mod encode;
mod error;
mod explain;
mod history;
mod latents;
mod loudness;
mod memory;
mod report;
mod scale;
mod sliders;
mod solve;
mod studio;
mod worded;

pub use encode::{Encoded, Part, encode};
pub use error::EditError;
pub use explain::{Explanation, WordEffect, explain};
pub use history::{History, Ingredient, Origin, Step};
pub use latents::Latents;
pub use loudness::equal_loudness;
pub(crate) use memory::remember;
pub use memory::{Memory, remembered};
pub use report::attributes_line;
pub use scale::{AXES, Axis, Scale};
pub use sliders::Sliders;
pub use studio::Studio;
pub use worded::{Edit, Worded};
