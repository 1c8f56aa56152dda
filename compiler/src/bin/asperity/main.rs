//! The command `asperity`.

mod cli;
mod commands;

use asperity::console;
use std::process::ExitCode;

fn main() -> ExitCode {
    asperity::output::clean_up_on_interrupt();
    console::finish(commands::run(console::arguments()))
}
