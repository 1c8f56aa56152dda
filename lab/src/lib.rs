//! The measurements of the `asperity-lab` command, as a library.
//!
//! | module | holds |
//! |---|---|
//! | [`servo_session`] | a servo loop of [`asperity_host`] on a texture or a scene, on a real device or the simulated one |
//! | [`jitter`] | latency and jitter of that loop: tables, JSON, pictures |
//! | [`feel`] | a simulated hand on a texture, with its summary, CSV, sheet and sound |
//! | [`capture`] | a recording of a real surface: sensors on ports and files, coverage, the folder |
//! | [`calibration`] | a sweep, the acceleration that follows, a profile of both |
//! | [`compensation`] | a device's compensation filter in a texture's models and taps |
//!
//! Clocks are read in [`capture`] and [`servo_session`] alone. The experiments that need no device, stability, speed
//! against accuracy and the accuracy of imports, are a crate of their own, [`asperity_experiments`].
#![forbid(unsafe_code)]

pub mod calibration;
pub mod capture;
pub mod compensation;
pub mod feel;
pub mod jitter;
pub mod servo_session;
