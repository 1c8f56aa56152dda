//! `recording.toml`: what the files of a recording hold.

mod propose;
mod quantity;
mod read;
mod schema;

pub use propose::propose;
pub use quantity::{GRAVITY_M_S2, Quantity, Unit};
pub use read::{FILE_NAME, MAX_BYTES, read};
pub use schema::{Axis, Channel, Column, Description, SensorFile, Tool};
