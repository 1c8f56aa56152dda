//! `asperity compose`.

use super::{input::Input, output::Mixing};
use crate::cli::Compose;
use asperity::{edit::LatentEditor, sources::latents::FromLatents};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};
use serde_json::json;

pub(crate) fn run(args: &Compose, console: Console) -> Result<(), Failures> {
    let friction = args.friction.as_ref().unwrap_or(&args.slide);
    let [tap, slide, friction] = [&args.tap, &args.slide, friction].map(|file| Input::of(file));
    let mixing = Mixing::open(&args.mixed, &[&tap, &slide, &friction], console)?;
    let (tap, slide, friction) = (tap.read()?, slide.read()?, friction.read()?);
    let slide = slide.asset()?;
    let prompt_compiler = mixing.prompt_compiler()?;
    let editor = LatentEditor::new(&prompt_compiler);
    let request = mixing.request(&editor, &slide);
    let tap = editor.remembered(&tap.asset()?).map_err(one)?;
    let slide = editor.remembered(&slide).map_err(one)?;
    let friction = editor.remembered(&friction.asset()?).map_err(one)?;
    let provenance = prompt_compiler.model().provenance("compose");
    let mut source = FromLatents::composed(&tap, &slide, &friction, provenance);
    source.name = mixing.name(&format!("{} tapped, {} slid", tap.name, slide.name));
    let compiled = mixing.compile(&editor, &source, &request)?;
    let line = format!(
        "taps of {:?}, slides of {:?}, friction of {:?}",
        tap.name, slide.name, friction.name
    );
    let more = json!({
        "compose": { "tap": tap.name, "slide": slide.name, "friction": friction.name },
    });
    mixing.finish(&editor, &compiled, more, &[("parts", line)])
}
