//! The command `asperity`.

mod cli;
mod commands;

use asperity_console::{arguments, finish, share_work};
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = arguments();
    finish(commands::prepare(&arguments).and_then(|()| {
        share_work();
        commands::run(arguments)
    }))
}
