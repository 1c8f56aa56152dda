//! The integration tests of this crate, one binary, so that they are linked once. A new file needs
//! its line here; `.ci/check-tests` fails without it.

mod cases;
mod command;
mod device;
#[path = "../../host/tests/fakes/mod.rs"]
mod fakes;
mod pareto;
mod record;
mod record_command;
mod servo;
mod servo_record;
#[cfg(unix)]
mod servo_studio;
