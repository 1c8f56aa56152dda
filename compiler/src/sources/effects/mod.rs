//! Effects of other tools as textures: `.haptic`, AHAP and HJIF.
//!
//! Such a file knows no speed, no force and no acceleration. Its continuous effects become the models
//! of one stroke, at a speed and a force that the user states, and its transients become taps. The
//! level follows from what the user takes a full scale for.

#[cfg(test)]
mod frozen;
mod source;
mod stroke;
#[cfg(test)]
pub(crate) mod tests;

pub use source::{Effects, Kind, Options};
