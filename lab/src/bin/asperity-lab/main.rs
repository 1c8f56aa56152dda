//! `asperity-lab`: measures Asperity without a device on the desk.
#![forbid(unsafe_code)]

mod bench;
mod device;
mod error;
mod feel;
mod jitter;
mod loop_options;
mod measured;
mod pareto;
mod record;
mod servo;
mod stability;
mod study;

use std::process::ExitCode;

use asperity_console::{
    Console,
    manual::{Completions, Manual},
};
use asperity_experiments::pareto::cost;
use asperity_io::diagnostic::{Failures, one};
use clap::{Parser, Subcommand};
use error::Plain;

/// Measure Asperity textures: simulated users and devices, servo-loop latency, stability, accuracy
/// of imports, and real devices.
#[derive(Debug, Parser)]
#[command(name = "asperity-lab", version)]
#[command(after_help = "Examples:
  asperity-lab feel
  asperity-lab feel brick.asp --plot feel.png --wav feel.wav
  asperity-lab servo brick.asp --device sim: --watch
  asperity-lab jitter --seconds 10 --cyclictest
  asperity-lab stability
  asperity-lab pareto -o charts
  asperity-lab measured --hatt hatt/models
  asperity-lab device list
  asperity-lab bench --seconds 5,60
  asperity-lab record oak --device sim:?hand=record --accel sim:
  asperity-lab study study.toml --device sim: -o data")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Print neither progress nor a report of what was written; requested results, --json and
    /// warnings are still printed
    #[arg(long, short, global = true)]
    quiet: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    Feel(feel::Arguments),
    Servo(servo::Arguments),
    Jitter(jitter::Arguments),
    Stability(stability::Arguments),
    Pareto(pareto::Arguments),
    Measured(measured::Arguments),
    Device(device::Arguments),
    Bench(bench::Arguments),
    Record(record::Arguments),
    Study(study::Arguments),
    /// Print what a shell needs to complete arguments
    #[command(after_help = "Example:
  asperity-lab completions bash > ~/.local/share/bash-completion/completions/asperity-lab")]
    Completions(Completions),
    /// Write manual pages
    #[command(after_help = "Example:
  asperity-lab manual -o ~/.local/share/man/man1")]
    Manual(Manual),
    /// Run one kernel, for counting
    #[command(name = cost::COMMAND, hide = true)]
    Kernel {
        numbers: Vec<usize>,
    },
}

fn main() -> ExitCode {
    let arguments: Arguments = asperity_console::arguments();
    // A servo loop takes the force to zero first.
    let has_loop = matches!(
        arguments.command,
        Command::Servo(_) | Command::Jitter(_) | Command::Record(_) | Command::Study(_)
    );
    if !has_loop {
        if let Err(error) = asperity_console::clean_up_on_interrupt() {
            return asperity_console::finish(Err(one(error)));
        }
        asperity_console::share_work();
    }
    let console = Console::new(arguments.quiet);
    let result = match &arguments.command {
        Command::Feel(arguments) => feel::run(arguments, console).map(|()| true),
        Command::Servo(arguments) => servo::run(arguments, console).map(|()| true),
        Command::Jitter(arguments) => jitter::run(arguments, console).map(|()| true),
        Command::Stability(arguments) => stability::run(arguments, console),
        Command::Device(arguments) => device::run(arguments, console),
        Command::Pareto(arguments) => pareto::run(arguments, console).map(|()| true),
        Command::Measured(arguments) => measured::run(arguments, console).map(|()| true),
        Command::Bench(arguments) => bench::run(arguments, console).map(|()| true),
        Command::Record(arguments) => record::run(arguments, console).map(|()| true),
        Command::Study(arguments) => study::run(arguments, console).map(|()| true),
        Command::Completions(arguments) => arguments.run::<Arguments>(console).map(|()| true),
        Command::Manual(arguments) => arguments.run::<Arguments>(console).map(|()| true),
        Command::Kernel { numbers } => kernel(numbers).map(|()| true),
    };
    match result {
        Ok(false) => ExitCode::FAILURE,
        other => asperity_console::finish(other.map(drop)),
    }
}

fn kernel(numbers: &[usize]) -> Result<(), Failures> {
    cost::run(numbers).map(drop).ok_or_else(|| {
        Plain::failure(
            format!("{numbers:?} names no kernel"),
            "leave this command to `asperity-lab pareto`",
        )
    })
}
