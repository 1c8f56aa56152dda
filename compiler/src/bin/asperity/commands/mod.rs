//! One file a command.

mod builtin;
mod import;
mod inspect;
mod plot;
mod render;

use crate::{
    cli::{Cli, Command, Import},
    failure::Failures,
};

pub(crate) fn run(cli: Cli) -> Result<(), Failures> {
    match cli.command {
        Command::Import(Import::Hatt(args)) => import::hatt(&args, cli.quiet),
        Command::Builtin(args) => builtin::run(&args),
        Command::Inspect(args) => inspect::run(&args),
        Command::Plot(args) => plot::run(&args),
        Command::Render(args) => render::run(&args),
    }
}
