//! Experiments on the simulator: each is seeded, runs in virtual time and gives the same bytes on every machine.
//!
//! | module | asks |
//! |---|---|
//! | [`stability`] | where methods fail: a table of our method and others |
//! | [`pareto`] | what other ways to render cost and lose; they live in [`asperity_kernels`] |
//! | [`measured`] | how far a prompt is from the measured material that it names |
//! | [`import_accuracy`] | how well a known texture comes back from a recording by simulated sensors |
#![forbid(unsafe_code)]

pub mod import_accuracy;
pub mod measured;
pub mod pareto;
mod signal;
pub mod stability;
