//! The commands, each in a file of its own.

mod build;
mod builtin;
mod compile;
mod doctor;
mod import_hatt;
mod import_model;
mod import_recording;
mod inference;
mod inspect;
mod outputs;
mod plot;
mod record_check;
mod render;
mod timings;

use crate::cli::{Cli, Command, Import};
use asperity::{console::Console, diagnostic::Failures};

pub(crate) fn run(cli: Cli) -> Result<(), Failures> {
    let console = Console::new(cli.quiet);
    match cli.command {
        Command::Import(Import::Hatt(args)) => import_hatt::run(&args, console),
        Command::Import(Import::Model(args)) => import_model::run(&args, console),
        Command::Import(Import::Recording(args)) => import_recording::run(&args, console),
        Command::RecordCheck(args) => record_check::run(&args, console),
        Command::Build(args) => build::run(&args, console),
        Command::Compile(args) => compile::run(&args, console),
        Command::Doctor(args) => doctor::run(&args, console),
        Command::Builtin(args) => builtin::run(&args, console),
        Command::Inspect(args) => inspect::run(&args, console),
        Command::Plot(args) => plot::run(&args),
        Command::Render(args) => render::run(&args, console),
    }
}
