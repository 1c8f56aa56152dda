//! `recording.toml`: what the files of a recording hold.

mod column_name;
mod propose;
mod quantity;
mod read;
mod schema;

pub(crate) use column_name::{Meaning, meaning};
pub(crate) use propose::TIME_UNITS;
pub use propose::propose;
pub use quantity::{GRAVITY_M_S2, Quantity, Unit};
pub(crate) use read::RATES_HZ;
pub use read::{FILE_NAME, MAX_BYTES, read};
pub use schema::{Axis, Channel, Column, Description, SensorFile, Tool};
