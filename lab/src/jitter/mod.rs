//! How punctual a servo loop is: tables, JSON, pictures.
//!
//! [`asperity_host::latency`] measures; what a person or a program reads is made here.

mod chart;
mod csv;
mod json;
mod table;

pub use chart::draw;
pub use csv::percentiles;
pub use json::{encode, encode_shifts};
pub use table::{report, shifts};
