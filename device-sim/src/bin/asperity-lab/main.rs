//! `asperity-lab`: measures Asperity without a device on the desk.
#![forbid(unsafe_code)]

mod error;
mod feel;
mod pareto;

use std::io::{self, Write as _};
use std::process::ExitCode;

use asperity_sim::labs::cost;
use clap::{Parser, Subcommand};
use error::{Failure, Plain};

/// Labs for Asperity textures: what a simulated user feels on a simulated device.
#[derive(Debug, Parser)]
#[command(name = "asperity-lab", version)]
#[command(after_help = "Examples:
  asperity-lab feel
  asperity-lab feel brick.asp --plot feel.png --wav feel.wav
  asperity-lab pareto --out charts")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Feel(feel::Arguments),
    Pareto(pareto::Arguments),
    /// Run one kernel, for counting
    #[command(name = cost::COMMAND, hide = true)]
    Kernel {
        numbers: Vec<usize>,
    },
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    asperity::output::clean_up_on_interrupt();
    let result = match &arguments.command {
        Command::Feel(arguments) => feel::run(arguments),
        Command::Pareto(arguments) => pareto::run(arguments),
        Command::Kernel { numbers } => kernel(numbers),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}", asperity::diagnostic::report(error.as_ref()));
            ExitCode::FAILURE
        }
    }
}

fn kernel(numbers: &[usize]) -> Result<(), Failure> {
    cost::run(numbers).map(drop).ok_or_else(|| {
        Plain::boxed(
            format!("{numbers:?} names no kernel"),
            "leave this command to `asperity-lab pareto`",
        )
    })
}

/// Prints results; a reader that has gone away is no failure.
fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
    {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Plain::boxed(
            format!("stdout: {error}"),
            "check where the output goes",
        )),
        _ => Ok(()),
    }
}
