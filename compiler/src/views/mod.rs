//! What a person looks at: an asset's contents, its sheet, a picture of the surface, a
//! rendered trajectory.

pub mod inspect;
pub mod plot;
pub mod preview;
pub mod render;
