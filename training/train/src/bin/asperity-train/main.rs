//! The command `asperity-train`: from a corpus to a model folder, and what it is worth.

mod cli;
mod commands;
mod console;
mod evaluate;
mod setup;

use asperity_io::diagnostic::report;
use clap::Parser as _;
use std::process::ExitCode;

fn main() -> ExitCode {
    match commands::run(cli::Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{}", report(failure.as_ref()));
            if console::is_interrupted() {
                ExitCode::from(130)
            } else if failure.is_usage() {
                ExitCode::from(2)
            } else {
                ExitCode::FAILURE
            }
        }
    }
}
