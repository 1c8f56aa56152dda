//! `asperity edit`.

use super::output::Mixing;
use crate::{cli::Edit as Arguments, commands::input::Input};
use asperity::sources::latents::{Edit, LatentEditor, Sliders, nothing_asked};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};

/// The steps of one option, or the others of its opposite.
fn either(up: Option<f64>, down: Option<f64>) -> f64 {
    up.or(down.map(|steps| -steps)).unwrap_or(0.0)
}

pub(crate) fn run(args: &Arguments, console: Console) -> Result<(), Failures> {
    let sliders = Sliders {
        rougher: either(args.rougher, args.smoother),
        sharper: either(args.sharper, args.duller),
        harder: either(args.harder, args.softer),
        slipperier: either(args.slipperier, args.stickier),
    };
    let edit = match &args.prompt {
        Some(words) => Edit::Words(words.clone()),
        None => Edit::Steps(sliders),
    };
    let edit = (!args.undo).then_some(edit);
    // Before the model is loaded.
    if edit.as_ref().is_some_and(Edit::is_still) {
        return Err(one(nothing_asked()));
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
