//! The commands, each in a file of its own.

mod build;
mod builtin;
mod compile;
mod doctor;
mod import_hatt;
mod import_model;
mod inference;
mod inspect;
mod outputs;
mod plot;
mod render;

use crate::{
    cli::{Cli, Command, Import},
    failure::Failures,
};

pub(crate) fn run(cli: Cli) -> Result<(), Failures> {
    match cli.command {
        Command::Import(Import::Hatt(args)) => import_hatt::run(&args, cli.quiet),
        Command::Import(Import::Model(args)) => import_model::run(&args),
        Command::Build(args) => build::run(&args, cli.quiet),
        Command::Compile(args) => compile::run(&args, cli.quiet),
        Command::Doctor(args) => doctor::run(&args),
        Command::Builtin(args) => builtin::run(&args),
        Command::Inspect(args) => inspect::run(&args),
        Command::Plot(args) => plot::run(&args),
        Command::Render(args) => render::run(&args),
    }
}
