//! What a person looks at: an asset's contents, a picture, a rendered trajectory.

pub mod inspect;
pub mod preview;
pub mod render;
