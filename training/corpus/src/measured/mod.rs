//! The generator measured: its [`banks`] of taps, and what others measured held against it, [`modes`]
//! of struck objects and height [`profiles`].
//!
//! `training/corpora/measured/README.md` says where they come from, `docs/taps.md` what the
//! comparison says. `cargo run -p asperity-corpus --example taps` prints it.

pub mod banks;
pub mod modes;
pub mod profiles;
