//! How punctual a servo loop is: tables, JSON, pictures.
//!
//! [`asperity_host::latency`] measures; what a person or a program reads is made here.

mod chart;
mod csv;
mod foreign;
mod json;
mod overlay;
mod table;

pub use chart::draw;
pub use csv::percentiles;
pub use foreign::{Foreign, ForeignError, Unit, read_foreign};
pub use json::{encode, encode_runs, encode_shifts};
pub use overlay::draw as draw_overlay;
pub use table::{report, shifts, side_by_side};
