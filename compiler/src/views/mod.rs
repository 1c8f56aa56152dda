//! What a person looks at or hears: an asset's contents, its sheet, a picture of the surface,
//! strokes and taps, a rendered trajectory.

pub mod diffusion;
pub mod inspect;
pub mod listen;
pub mod plot;
pub mod preview;
pub mod render;
