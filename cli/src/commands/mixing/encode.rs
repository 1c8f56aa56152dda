//! `asperity encode`.

use super::output::Mixing;
use crate::{cli::Encode, commands::input::Input};
use asperity::sources::latents::LatentEditor;
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};

pub(crate) fn run(args: &Encode, console: Console) -> Result<(), Failures> {
    let input = Input::of(&args.file);
    let mixing = Mixing::open(&args.mixed, &[&input], console)?;
    let input = input.read()?;
    let asset = input.asset()?;
    let prompt_compiler = mixing.prompt_compiler()?;
    let editor = LatentEditor::new(&prompt_compiler);
    let mix = editor
        .encoded(&asset, args.part, &mixing.options())
        .map_err(one)?;
    mixing.finish(&editor, mix)
}
