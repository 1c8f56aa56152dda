//! Asperity on a desk: what a servo loop on a computer with an operating system needs.
//!
//! [`device`] is what the loop talks to, one trait for every device. [`servo`] is the loop, on a
//! thread of its own. [`latency`] says how punctual it was.

pub mod device;
pub mod latency;
pub mod servo;
