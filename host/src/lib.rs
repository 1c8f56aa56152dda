//! Servo loop support for a computer with an operating system: devices behind one trait, a thread
//! of its own, recordings, and a measure of its punctuality.
//!
//! Once a period the loop reads a device, renders a texture with [`asperity_runtime`] and writes
//! the force. It is generic over device, renderer, clock and observer, so that it also runs without
//! a device and in virtual time:
//!
//! ```
//! use asperity_formats::Asset;
//! use asperity_host::{
//!     device::NullDevice,
//!     servo::{End, ServoLoop, Settings, SingleTexture, Virtual},
//! };
//! use asperity_runtime::{Config, HostTexture, Renderer, State};
//! use std::sync::atomic::AtomicBool;
//!
//! # let bytes = include_bytes!(concat!(
//! #     env!("CARGO_MANIFEST_DIR"),
//! #     "/../runtime/tests/data/builtin-v1.asp"
//! # ));
//! let config = Config::default();
//! let renderer = Renderer::new(&config)?;
//! let mut texture = Box::new(HostTexture::new());
//! texture.load(&Asset::parse(bytes)?, config.servo_rate_hz)?;
//!
//! // A stylus that rests 1 mm deep in the surface, for a hundred periods at 1 kHz.
//! let mut device = NullDevice::at(-0.001);
//! let render = SingleTexture { renderer: &renderer, texture: &texture, state: State::new(1) };
//! let settings = Settings { periods: Some(100), ..Settings::at(1000) };
//! let stop = AtomicBool::new(false);
//! let report = ServoLoop::new(&mut device, render, Virtual::new(), (), settings).run(&stop);
//! assert_eq!((report.end, report.missed), (End::Over, 0));
//! assert!(report.ended_without_force); // the last force that it wrote is zero
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What to read first
//!
//! [`servo`] is the loop, and [`servo::Servo`] runs it on a thread with the privileges that the system grants.
//! [`device::Device`] is the trait that every device implements; [`device::open()`] opens one by its name.
//! `docs/servo.md` and `docs/faults.md` in the repository describe the behaviour of the loop, `docs/devices.md` the
//! devices.
//!
//! | module | holds |
//! |---|---|
//! | [`device`] | devices behind one trait |
//! | [`servo`] | the loop, on a thread of its own |
//! | [`latency`] | timing of the loop |
//! | [`session_log`] | sessions in files that can be rendered again |
//! | [`profile`] | response of a device to a force |
//! | [`fault_plan`] | schedule of injected faults |

pub mod device;
pub mod fault_plan;
pub mod latency;
pub mod profile;
mod regular_file;
pub mod servo;
pub mod session_log;
