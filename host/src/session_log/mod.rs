//! Sessions in files: every sample, every force, and the conditions that reproduce them.
//!
//! `formats/RECORDING.md` specifies the bytes. A servo thread hands an [`Entry`] a tick to a
//! [`Recorder`], which never waits; [`FromServo`] turns what a servo loop sends to another thread
//! into entries. The file is written in blocks with a checksum each, so that one that was cut is
//! readable up to its last whole block. [`SessionLog`] reads one, [`csv`] exports it, and
//! [`render_again`] renders it anew and compares every bit of force.

mod block;
mod conditions;
pub mod csv;
mod entry;
mod error;
mod file;
mod from_servo;
mod pace;
mod record;
mod recorder;
mod render_again;

pub use conditions::{Conditions, TextureInfo};
pub use entry::Entry;
pub use error::SessionLogError;
pub use file::{Encoder, Ending, MAX_TICKS, SessionLog, Summary};
pub use from_servo::FromServo;
pub use pace::pace;
pub use recorder::{Recorder, Writing, start};
pub use render_again::{Comparison, Difference, RenderAgainError, render_again, render_again_with};
