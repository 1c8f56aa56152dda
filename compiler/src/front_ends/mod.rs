//! What makes a texture: words, recordings, effects, a model of one's own, a formula.

pub mod builtin;
pub mod effects;
pub mod embedded;
pub mod hatt;
pub mod imported;
pub mod inference;
pub mod learned;
pub mod model_file;
pub mod prompt;
pub mod recording;
pub mod text;
