//! `recording.toml`: what the files of a recording hold.
//!
//! A folder without one gets a proposal, from what the headers of its files say:
//!
//! ```
//! use asperity_recording::description;
//!
//! let folder = tempfile::tempdir()?;
//! let table = "time (s),acc_x (m/s^2)\n0.000,0.1\n0.001,0.2\n0.002,0.1\n";
//! std::fs::write(folder.path().join("tool.csv"), table)?;
//! let proposal = description::propose(folder.path())?.expect("a file of a known kind");
//! assert!(proposal.text.contains("path = \"tool.csv\"") && proposal.files == 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod column_name;
mod propose;
mod quantity;
mod read;
mod schema;

pub(crate) use column_name::{Meaning, in_group, is_unit, meaning};
pub use propose::{Proposal, propose};
pub use quantity::{GRAVITY_M_S2, Quantity, Unit};
pub use read::{FILE_NAME, MAX_BYTES, is_absent, no_description, read};
pub use schema::{Axis, Channel, Column, Description, SensorFile, Tool};
pub(crate) use schema::{RATES_HZ, TIME_UNITS};
