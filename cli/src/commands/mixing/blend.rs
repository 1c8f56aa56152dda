//! `asperity blend`.

use super::output::Mixing;
use crate::{cli::Blend, commands::input::Input};
use asperity::sources::latents::LatentEditor;
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};

pub(crate) fn run(args: &Blend, console: Console) -> Result<(), Failures> {
    let (first, second) = (Input::of(&args.a), Input::of(&args.b));
    let mixing = Mixing::open(&args.mixed, &[&first, &second], console)?;
    let (a, b) = (first.read()?, second.read()?);
    let (a, b) = (a.asset()?, b.asset()?);
    let prompt_compiler = mixing.prompt_compiler()?;
    let editor = LatentEditor::new(&prompt_compiler);
    let mix = editor
        .blend(&a, &b, args.t, &mixing.options())
        .map_err(one)?;
    mixing.finish(&editor, mix)
}
