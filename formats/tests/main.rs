//! The integration tests of this crate, one binary, so that they are linked once. A new file needs
//! its line here; `.ci/check-tests` fails without it.

mod common;
mod compatibility;
mod damage;
mod field_ranges;
mod hostile;
mod index_arithmetic;
mod library;
mod memory;
mod readers;
mod round_trip;
mod scene;
mod walk_through;
