//! The command `asperity`.

mod cli;
mod commands;
mod console;
mod failure;

use clap::Parser as _;
use std::process::ExitCode;

fn main() -> ExitCode {
    asperity::output::clean_up_on_interrupt();
    match commands::run(cli::Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failures) => {
            for failure in &failures {
                eprintln!("{}", asperity::diagnostic::report(failure.as_ref()));
            }
            if failures.iter().any(|failure| failure.is_usage()) {
                ExitCode::from(2)
            } else {
                ExitCode::FAILURE
            }
        }
    }
}
