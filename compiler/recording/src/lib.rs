//! From the sensor files of a tool on a surface to the parts of a texture: checked channels, steady segments, models,
//! friction and impacts.
//!
//! A recording is a folder of sensor files and a `recording.toml` that describes them.
//!
//! ```
//! use asperity_recording::{check, reader};
//!
//! # let folder = tempfile::tempdir()?;
//! # let mut table = String::from("t,a,fz,v\n");
//! # for n in 0..4000 {
//! #     let (t, pressed) = (f64::from(n) / 1000.0, n > 1000);
//! #     let noise = f64::from(n * 7919 % 1009) / 1009.0 - 0.5;
//! #     let (load, speed) = if pressed { (1.0, 50.0) } else { (0.0, 0.0) };
//! #     let (a, fz, v) = (load * noise + 0.01 * noise, load + 0.002 * noise, speed + noise);
//! #     table += &format!("{t:.3},{a:.5},{fz:.5},{v:.5}\n");
//! # }
//! # std::fs::write(folder.path().join("oak.csv"), table)?;
//! // `oak.csv` has the columns t, a, fz and v, four seconds of them.
//! let description = r#"
//!     name = "oak"
//!     [[file]]
//!     path = "oak.csv"
//!     clock = "t"
//!     channel = [
//!         { column = "a", quantity = "acceleration", axis = "along", unit = "m/s^2" },
//!         { column = "fz", quantity = "force", axis = "z", unit = "N" },
//!         { column = "v", quantity = "speed", unit = "mm/s" },
//!     ]
//! "#;
//! std::fs::write(folder.path().join("recording.toml"), description)?;
//!
//! let recording = reader::load(folder.path())?;
//! let (checked, timeline) = check::check(&recording)?;
//! assert_eq!(recording.channels.len(), 3);
//! assert!(checked.contact_s > 2.0 && checked.contact_s < checked.duration_s);
//! assert_eq!(timeline.speed_mm_s.len(), timeline.load_n.len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What to read first
//!
//! [`description`] for what a folder must hold, [`check()`](check::check) for what the rest is built on, then the
//! steps in their order. `docs/recording.md` in the repository explains how to record.
//!
//! A recording goes one way, and every step is a module:
//!
//! | step | module | gives |
//! |---|---|---|
//! | describe | [`description`] | files, channels, units, rates; a proposal where there is none |
//! | read | [`reader`] | channels in SI units, with what was wrong with their numbers |
//! | align | [`timeline`] | all channels on one clock at 1 kHz |
//! | check | [`check`] | a verdict for each channel, and what to do about it |
//! | resonance | [`resonance`] | that of tool and sensor, by taps in free air, and the acceleration without it |
//! | segments | [`segments`] | stretches of steady speed and force, and of changing ones |
//! | grid | [`grid`] | AR models over speed and force, and beyond what was visited |
//! | friction | [`friction`] | μ with its spread, and how it depends on speed and load |
//! | taps | [`impact`] | impacts, their speeds, a mean transient for each speed |
//!
//! What must stay absent: whole textures, assets, the learned model, pictures.
#![forbid(unsafe_code)]

pub mod channel;
pub mod check;
pub mod description;
mod file;
pub mod friction;
pub mod grid;
pub mod impact;
mod least_squares;
pub mod reader;
mod remedy;
pub mod resonance;
pub mod segments;
pub mod signal;

#[cfg(test)]
mod test_recordings;
pub mod timeline;
