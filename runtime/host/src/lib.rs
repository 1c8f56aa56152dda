//! Asperity on a desk: what a servo loop on a computer with an operating system needs.
//!
//! [`device`] is what the loop talks to, one trait for every device. [`servo`] is the loop, on a
//! thread of its own. [`latency`] says how punctual it was. [`session_log`] keeps sessions in files that
//! can be rendered again. [`profile`] says how a device answers a force.
//! [`fault_plan`] says when injected faults begin.

pub mod device;
pub mod fault_plan;
pub mod latency;
pub mod profile;
mod regular_file;
pub mod servo;
pub mod session_log;
