//! The session of `benches/session/` as a text of hashes, which every machine writes
//! alike: a line for each arithmetic and case, `float arma20`, and then the hash of all
//! outputs and counters after each phase.
#![cfg_attr(target_arch = "wasm32", no_std)]

#[cfg(not(target_arch = "wasm32"))]
pub mod command;
mod hashes;
mod text;
#[cfg(target_arch = "wasm32")]
mod wasm;

pub use hashes::{HashesError, Numbers, hashes};
pub use text::write_hashes;
