//! `asperity edit`.

use super::{input::Input, output::Mixing};
use crate::cli::Edit as Arguments;
use asperity::edit::{Edit, EditError, LatentEditor, Sliders};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};

pub(crate) fn run(args: &Arguments, console: Console) -> Result<(), Failures> {
    let sliders = Sliders {
        rougher: args.rougher.unwrap_or(0.0),
        sharper: args.sharper.unwrap_or(0.0),
        harder: args.harder.unwrap_or(0.0),
        slipperier: args.slipperier.unwrap_or(0.0),
    };
    let edit = match &args.prompt {
        Some(words) => Edit::Words(words.clone()),
        None => Edit::Steps(sliders),
    };
    let edit = (!args.undo).then_some(edit);
    // Before the model is loaded.
    if edit.as_ref().is_some_and(Edit::is_still) {
        return Err(one(EditError::NothingAsked));
    }
    let input = Input::of(&args.file);
    let mixing = Mixing::open(&args.mixed, &[&input], console)?;
    let input = input.read()?;
    let asset = input.asset()?;
    let prompt_compiler = mixing.prompt_compiler()?;
    let editor = LatentEditor::new(&prompt_compiler);
    let mix = editor.change(&asset, edit.as_ref(), &mixing.options());
    mixing.finish(&editor, mix.map_err(one)?)
}
