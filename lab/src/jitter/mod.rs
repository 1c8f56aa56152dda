//! Latency and jitter of a servo loop: tables, JSON, pictures.
//!
//! [`asperity_host::latency`] measures; this module renders the results for people and programs.

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
