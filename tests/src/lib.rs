//! Parts that the tests share: an f64 oracle of the tick, textures, trajectories, spectra, the search for
//! the HaTT materials, and the figures that pages quote.
//!
//! The oracle is written from the documents (the equations in the runtime's doc comments and
//! `formats/SPEC.md`). It uses other methods than the runtime and none of its code, so a mistake
//! goes unnoticed only if it was made twice.

pub mod damage;
pub mod draw;
pub mod figures;
pub mod force_limits;
pub mod fuzz_ticks;
pub mod hatt;
pub mod load_then_tick;
pub mod oracle;
pub mod size;
pub mod spectrum;
pub mod stability;
pub mod texture;
pub mod trajectory;
