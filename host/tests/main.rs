//! The integration tests of this crate, one binary, so that they are linked once. A new file needs
//! its line here; `.ci/check-tests` fails without it.

mod dhd;
mod distribution;
mod fakes;
mod interval_log;
mod latency;
mod openhaptics;
mod replayed;
mod servo;
mod servo_model;
mod session_log;
mod support;
mod unplugged;
