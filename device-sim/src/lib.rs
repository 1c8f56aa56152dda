//! A simulated Touch, a virtual hand and faults, in virtual time: a servo loop can be tried, broken and replayed
//! without a device.
//!
//! A [`Session`](session::Session) closes the loop that a person closes on a desk. A
//! [`Hand`](hand::Hand) pulls the stylus of a [`Device`](device::Device). A
//! [`Servo`](servo::Servo), which is a renderer, possibly behind a
//! [`FaultInjector`](fault::FaultInjector), answers every measured position with a force.
//!
//! ```
//! use asperity_runtime::{Output, Sample};
//! use asperity_sim::{
//!     device::DeviceConfig,
//!     hand::{Grip, GripPreset, Script},
//!     servo::silence,
//!     session::Session,
//! };
//!
//! // A bare wall of 1 N/mm in the place of a renderer.
//! let wall = |sample: &Sample| Output {
//!     force_n: [0.0, 0.0, 1000.0 * (-sample.position_m[2]).max(0.0)],
//!     ..silence()
//! };
//! let touch = DeviceConfig::touch()?;
//! let script = Script::exploration(7, 1, touch.half_extents_m()); // seed 7, one round
//! let mut session = Session::new(&touch, Grip::preset(GripPreset::Light)?, script, wall);
//! let records = session.run(5000);
//! assert!(records.iter().any(|record| record.device_n[2] > 0.5)); // the hand has tapped the wall
//! # Ok::<(), asperity_sim::config::ConfigError>(())
//! ```
//!
//! Nothing in that loop reads a clock: time passes when the caller says so, and the same seed gives the
//! same bytes. Only [`SimDevice`](host_device::SimDevice) may follow the monotonic clock, so that the servo loop of
//! [`asperity_host`] runs on it as on a real device.
//!
//! # What to read first
//!
//! [`session`], which is the loop on one page; [`device`] and [`hand`] for what it moves;
//! [`servo::RenderedTexture`] to put the runtime with a texture into it.
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
//! | [`dragged_tip`] | apart from the loop: a ball dragged over a relief, against which the models of strokes are checked |
//!
//! The simulator deliberately leaves out the kinematics of the arm (its axes are independent and
//! Cartesian), gravity (which counts as compensated), the stylus's orientation, motor heat (the
//! reports compare the force with the continuous limit) and structural resonances.
#![forbid(unsafe_code)]

pub mod axis;
pub mod config;
pub mod device;
pub mod dragged_tip;
pub mod fault;
pub mod hand;
pub mod host_device;
pub mod random;
pub mod servo;
pub mod session;
