//! The integration tests of this crate, one binary, so that they are linked once. A new file needs
//! its line here; `.ci/check-tests` fails without it.

mod faults;
mod files;
mod impact_speed;
mod kinds;
mod taps;
