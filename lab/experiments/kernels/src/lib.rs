//! Mixing, conversion and synthesis in every way that the experiments compare with the tick.
//!
//! The crate is `no_std` with an allocator: the same kernel is measured on the host and counted
//! on a microcontroller. None of it runs in a servo loop.
//!
//! | module | holds |
//! |---|---|
//! | [`design`] | the factors of a kernel, the default, and what is compared with it |
//! | [`texture`] | the models that a kernel is made of, and the queries it answers |
//! | [`mod@kernel`] | a kernel of any design |
//! | [`number`] | the numbers it computes with |
//! | [`workload`] | the same work for every design, for counting |
#![no_std]
#![forbid(unsafe_code)]

extern crate alloc;
#[cfg(test)]
extern crate std;

mod coefficients;
mod convert;
pub mod design;
pub mod kernel;
pub mod number;
mod parameters;
mod synthesis;
pub mod texture;
pub mod workload;

pub use kernel::{Rendering, kernel};
