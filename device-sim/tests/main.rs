//! The integration tests of this crate, one binary, so that they are linked once. A new file needs
//! its line here; `.ci/check-tests` fails without it.

mod command;
mod device;
mod drawing_tools;
#[path = "../../runtime/host/tests/fakes/mod.rs"]
mod fakes;
mod faults;
mod pareto;
mod passivity;
mod record;
mod record_command;
mod recordings;
mod servo;
mod servo_record;
mod tool_and_sensor;
