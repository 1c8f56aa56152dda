//! A simulated Touch, a virtual hand and faults, in virtual time.
//!
//! A [`Session`](session::Session) closes the loop that a person closes on a desk. A
//! [`Hand`](hand::Hand) pulls the stylus of a [`Device`](device::Device). A
//! [`Servo`](servo::Servo), which is a renderer, possibly behind a
//! [`FaultInjector`](fault::FaultInjector), answers every measured position with a force.
//! Nothing there reads a clock: time passes when the caller says so, and the same seed gives the
//! same bytes. Clocks are read in [`capture`] and [`desk`] alone; the latter runs a texture or a scene in a servo loop
//! of [`asperity_host`], on a real device or on the simulated one.
//!
//! | module | holds |
//! |---|---|
//! | [`axis`] | one axis: mass, friction, a hand's pull, implicit integration |
//! | [`mod@bench`] | known textures, recorded by simulated sensors and held against what comes back |
//! | [`calibration`] | a sweep, the acceleration that follows, a profile of both |
//! | [`capture`] | a recording of a real surface: sensors on ports and files, coverage, the folder |
//! | [`device`] | the device: quantisation, delay, limits, workspace, and its TOML file |
//! | [`hand`] | grip, motions, seeded script |
//! | [`servo`] | whatever answers a position with a force |
//! | [`fault`] | NaN, dropped, stale, stuck and late samples |
//! | [`session`] | the loop, and the record of every tick |
//! | [`feel`] | a session on a texture, with its summary, CSV, sheet and sound |
//! | [`desk`] | a servo loop on a texture or a scene; the simulated device behind the host's trait |
//! | [`jitter`] | how punctual that loop is: tables, JSON, pictures |
//! | [`voice`] | a device's compensation filter in a texture's models and taps |
//! | [`labs`] | alternatives to the tick, which only the charts need |
//! | [`stability`] | where methods fail: a table of our method and others |
//!
//! The simulator deliberately leaves out the kinematics of the arm (its axes are independent and
//! Cartesian), gravity (which counts as compensated), the stylus's orientation, motor heat (the
//! reports compare the force with the continuous limit) and structural resonances.
#![forbid(unsafe_code)]

pub mod axis;
pub mod bench;
pub mod calibration;
pub mod capture;
pub mod config;
pub mod desk;
pub mod device;
pub mod fault;
pub mod feel;
pub mod hand;
pub mod jitter;
pub mod labs;
mod random;
pub mod servo;
pub mod session;
mod signal;
pub mod stability;
pub mod voice;
