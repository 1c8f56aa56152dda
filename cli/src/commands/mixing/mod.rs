//! The commands that mix and edit in the latent, each in a file of its own.

pub(super) mod blend;
pub(super) mod compose;
pub(super) mod edit;
pub(super) mod encode;
mod output;
