//! `asperity compose`.

use super::output::Mixing;
use crate::{cli::Compose, commands::input::Input};
use asperity::sources::latents::LatentEditor;
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};

pub(crate) fn run(args: &Compose, console: Console) -> Result<(), Failures> {
    let friction = args.friction.as_ref().unwrap_or(&args.slide);
    let [tap, slide, friction] = [&args.tap, &args.slide, friction].map(|file| Input::of(file));
    let mixing = Mixing::open(&args.mixed, &[&tap, &slide, &friction], console)?;
    let (tap, slide, friction) = (tap.read()?, slide.read()?, friction.read()?);
    let (tap, slide, friction) = (tap.asset()?, slide.asset()?, friction.asset()?);
    let prompt_compiler = mixing.prompt_compiler()?;
    let editor = LatentEditor::new(&prompt_compiler);
    let mix = editor.compose(&tap, &slide, Some(&friction), &mixing.options());
    mixing.finish(&editor, mix.map_err(one)?)
}
