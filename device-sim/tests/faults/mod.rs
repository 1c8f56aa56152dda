//! Faults around every kind of device: the force stays within its limits, goes to zero, comes back,
//! and each fault is reported once.

mod servo;
mod session;
mod simulated;
mod table;
