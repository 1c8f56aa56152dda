//! `asperity-lab`: measures Asperity without a device on the desk.
#![forbid(unsafe_code)]

mod error;
mod feel;
mod stability;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Labs for Asperity textures: what a simulated user feels on a simulated device, and where
/// methods fail.
#[derive(Debug, Parser)]
#[command(name = "asperity-lab", version)]
#[command(after_help = "Examples:
  asperity-lab feel
  asperity-lab feel brick.asp --plot feel.png --wav feel.wav
  asperity-lab stability")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Feel(feel::Arguments),
    Stability(stability::Arguments),
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    asperity::output::clean_up_on_interrupt();
    let result = match &arguments.command {
        Command::Feel(arguments) => feel::run(arguments).map(|()| true),
        Command::Stability(arguments) => stability::run(arguments),
    };
    match result {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{}", asperity::diagnostic::report(error.as_ref()));
            ExitCode::FAILURE
        }
    }
}
