//! The command `asperity`.

mod cli;
mod commands;

use asperity_console::{arguments, clean_up_on_interrupt, finish, share_work};
use asperity_io::diagnostic::one;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = arguments();
    finish(clean_up_on_interrupt().map_err(one).and_then(|()| {
        share_work();
        commands::run(arguments)
    }))
}
