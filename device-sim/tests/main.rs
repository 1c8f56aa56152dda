//! The integration tests of this crate, one binary, so that they are linked once. A new file needs
//! its line here; `.ci/check-tests` fails without it.

mod dragged_tip;
#[path = "../../host/tests/fakes/mod.rs"]
mod fakes;
mod faults;
