//! What the tests share: an f64 oracle of the tick, textures to test with,
//! trajectories, spectra, and the search for the HaTT materials.
//!
//! The oracle is written from the documents (the equations of the runtime's doc
//! comments, `formats/SPEC.md`), with other methods than the runtime's and without its
//! code: what both get wrong, they must get wrong twice.

pub mod damage;
pub mod draw;
pub mod force_limits;
pub mod fuzz_ticks;
pub mod hatt;
pub mod load_then_tick;
pub mod oracle;
pub mod spectrum;
pub mod stability;
pub mod texture;
pub mod trajectory;
