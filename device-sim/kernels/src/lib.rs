//! Mixing, conversion and synthesis in every way that the labs compare with the tick.
//!
//! `no_std` with an allocator, so that one kernel is measured on the host and counted on a
//! microcontroller. Nothing of it runs in a servo loop.
//!
//! | module | holds |
//! |---|---|
//! | [`design`] | the factors of a kernel, the default, and what is compared with it |
//! | [`texture`] | what a kernel is made of and what it is asked |
//! | [`mod@kernel`] | a kernel of any design |
//! | [`number`] | what it computes with |
//! | [`workload`] | the same work for every design, to count |
#![no_std]
#![forbid(unsafe_code)]

extern crate alloc;
#[cfg(test)]
extern crate std;

mod convert;
pub mod design;
pub mod kernel;
mod line;
pub mod number;
mod parameters;
pub mod texture;
pub mod workload;

pub use kernel::{Rendering, kernel};
