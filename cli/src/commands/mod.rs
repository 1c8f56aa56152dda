//! The commands, each in a file of its own.

mod build;
mod build_scene;
mod builtin;
mod compile;
mod diffusion;
mod doctor;
mod export;
mod import;
mod import_hatt;
mod inference;
mod input;
mod inspect;
mod library;
mod listen;
mod many_textures;
mod mixing;
mod one_texture;
mod plot;
mod preview;
mod record_check;
mod render;
mod studio;
mod study;
mod timings;

use crate::cli::{Cli, Command, Import, Study};
use asperity::sources::effects::EffectsKind;
use asperity_console::{Console, clean_up_on_interrupt};
use asperity_io::diagnostic::{Failures, one};

/// Prepares for an interrupt: the studio's server ends by it with status 0, every other command removes what is unfinished.
pub(crate) fn prepare(cli: &Cli) -> Result<(), Failures> {
    match cli.command {
        Command::Studio(ref args) if args.export.is_none() => Ok(()),
        Command::Study(Study::Run(_)) => Ok(()),
        _ => clean_up_on_interrupt().map_err(one),
    }
}

pub(crate) fn run(cli: Cli) -> Result<(), Failures> {
    let console = Console::new(cli.quiet);
    match cli.command {
        Command::Import(Import::Hatt(args)) => import_hatt::run(&args, console),
        Command::Import(Import::Model(args)) => import::model(&args, console),
        Command::Import(Import::Surface(args)) => import::surface(&args, console),
        Command::Import(Import::Recording(args)) => import::recording(&args, console),
        Command::Import(Import::Haptic(args)) => {
            import::effects(&args, EffectsKind::Haptic, console)
        }
        Command::Import(Import::Ahap(args)) => import::effects(&args, EffectsKind::Ahap, console),
        Command::Import(Import::Hjif(args)) => import::effects(&args, EffectsKind::Hjif, console),
        Command::Export(args) => export::run(&args, console),
        Command::RecordCheck(args) => record_check::run(&args, console),
        Command::Build(args) => build::run(&args, console),
        Command::Merge(args) => library::merge::run(&args, console),
        Command::List(args) => library::list::run(&args, console),
        Command::Extract(args) => library::extract::run(&args, console),
        Command::Rename(args) => library::rename::run(&args, console),
        Command::Split(args) => library::split::run(&args, console),
        Command::Diff(args) => library::diff::run(&args, console),
        Command::Blend(args) => mixing::blend::run(&args, console),
        Command::Compose(args) => mixing::compose::run(&args, console),
        Command::Edit(args) => mixing::edit::run(&args, console),
        Command::Encode(args) => mixing::encode::run(&args, console),
        Command::Compile(args) => compile::run(&args, console),
        Command::Doctor(args) => doctor::run(&args, console),
        Command::Builtin(args) => builtin::run(&args, console),
        Command::Inspect(args) => inspect::run(&args, console),
        Command::Plot(args) => plot::run(&args, console),
        Command::Preview(args) => preview::run(&args, console),
        Command::Listen(args) => listen::run(&args, console),
        Command::Render(args) => render::run(&args, console),
        Command::Studio(args) => studio::run(&args, console),
        Command::Study(Study::Check(args)) => study::check(&args, console),
        Command::Study(Study::Run(args)) => study::run(&args, console),
        Command::Study(Study::Simulate(args)) => study::simulate(&args, console),
        Command::Completions(args) => args.run::<Cli>(console),
        Command::Manual(args) => args.run::<Cli>(console),
    }
}
