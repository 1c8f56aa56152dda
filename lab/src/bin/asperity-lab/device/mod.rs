//! `asperity-lab device`: devices on USB, real and virtual.

mod calibrate;
mod faults;
mod inventory;
mod list;
mod probe;
mod serve;

use asperity_console::Console;
use asperity_io::diagnostic::Failures;
use clap::Subcommand;

/// List, test, calibrate and emulate devices
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab device list
  asperity-lab device probe falcon:?firmware=falcon.bin
  asperity-lab device faults falcon: --peak-n 1
  asperity-lab device serve falcon
  asperity-lab device calibrate -o touch.toml")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    List(list::Arguments),
    Probe(probe::Arguments),
    Faults(faults::Arguments),
    Serve(serve::Arguments),
    Calibrate(calibrate::Arguments),
}

/// Gives whether everything is well.
pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<bool, Failures> {
    match &arguments.command {
        Command::List(arguments) => list::run(arguments, console).map(|()| true),
        Command::Probe(arguments) => probe::run(arguments, console),
        Command::Faults(arguments) => faults::run(arguments, console),
        Command::Serve(arguments) => serve::run(arguments, console).map(|()| true),
        Command::Calibrate(arguments) => calibrate::run(arguments, console).map(|()| true),
    }
}

/// Prints a value as JSON.
fn json(console: Console, value: &serde_json::Value) -> Result<(), Failures> {
    console.json(value).map_err(asperity_io::diagnostic::one)
}

/// A failure of a device, with its remedy.
fn failure(error: &impl std::fmt::Display, remedy: String) -> Failures {
    crate::error::Plain::failure(error, remedy)
}
