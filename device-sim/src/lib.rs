//! A simulated Touch, a virtual hand and faults, in virtual time.
//!
//! A [`Session`](session::Session) closes the loop that a person closes on a desk:
//! a [`Hand`](hand::Hand) pulls the stylus of a [`Device`](device::Device), a
//! [`Servo`](servo::Servo) (a renderer, possibly behind a
//! [`FaultInjector`](fault::FaultInjector)) answers every measured position with a
//! force. Nothing here reads a clock: time passes when the caller says so, and the
//! same seed gives the same bytes.
//!
//! | module | holds |
//! |---|---|
//! | [`axis`] | one axis: mass, friction, a hand's spring, implicit integration |
//! | [`device`] | the device: quantisation, delay, limits, workspace; its TOML |
//! | [`hand`] | grip, motions, seeded script |
//! | [`servo`] | what stands between a position and a force |
//! | [`fault`] | NaN, dropped, stale, stuck and late samples, stackable |
//! | [`session`] | the loop, and the record of every tick |
//! | [`feel`] | what a session amounts to: summary, CSV, sheet, sound |
//! | [`labs`] | alternatives to the tick, for charts alone |
//! | [`stability`] | where methods fail: a table of ours against others |
//!
//! Not modelled, on purpose: the kinematics of the arm (axes are independent and
//! Cartesian), gravity (taken as compensated), the stylus's orientation, motor
//! heat (force is reported against the continuous limit), structural resonances.
#![forbid(unsafe_code)]

pub mod axis;
pub mod config;
pub mod device;
pub mod fault;
pub mod feel;
pub mod hand;
pub mod labs;
pub mod servo;
pub mod session;
pub mod stability;
