//! A simulated Touch, a virtual hand and faults, in virtual time.
//!
//! A [`Session`](session::Session) closes the loop that a person closes on a desk. A
//! [`Hand`](hand::Hand) pulls the stylus of a [`Device`](device::Device). A
//! [`Servo`](servo::Servo), which is a renderer, possibly behind a
//! [`FaultInjector`](fault::FaultInjector), answers every measured position with a force.
//! Nothing there reads a clock: time passes when the caller says so, and the same seed gives the
//! same bytes. Only [`SimDevice`](host_device::SimDevice) may follow the monotonic clock, so that the servo loop of
//! [`asperity_host`] runs on it as on a real device.
//!
//! | module | holds |
//! |---|---|
//! | [`axis`] | one axis: mass, friction, a hand's pull, implicit integration |
//! | [`device`] | the device: quantisation, delay, limits, workspace, and its TOML file |
//! | [`hand`] | grip, motions, seeded script |
//! | [`servo`] | whatever answers a position with a force |
//! | [`fault`] | NaN, dropped, stale, stuck and late samples |
//! | [`session`] | the loop, and the record of every tick |
//! | [`host_device`] | the simulated device and hand behind the host's trait |
//! | [`config`] | how TOML files are read and checked |
//! | [`random`] | uniform numbers |
//!
//! The simulator deliberately leaves out the kinematics of the arm (its axes are independent and
//! Cartesian), gravity (which counts as compensated), the stylus's orientation, motor heat (the
//! reports compare the force with the continuous limit) and structural resonances.
#![forbid(unsafe_code)]

pub mod axis;
pub mod config;
pub mod device;
pub mod fault;
pub mod hand;
pub mod host_device;
pub mod random;
pub mod servo;
pub mod session;
