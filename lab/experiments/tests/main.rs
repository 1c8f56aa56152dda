//! The integration tests of this crate, one binary, so that they are linked once. A new file needs
//! its line here; `.ci/check-tests` fails without it.

mod drawing_tools;
mod passivity;
mod recordings;
mod tool_and_sensor;
